#!/usr/bin/env bash
# deb_in_a_clean_root.sh SOURCE BUILD: on a Debian with nothing but its base, apt installs the package, and
# the program computes a strike; how long that takes is printed. The base is kept for the next time.
set -euo pipefail
source=$1 build=$2
command -v debootstrap >/dev/null || { echo "skipped: debootstrap is missing"; exit 0; }
[[ $(id -u) -eq 0 ]] || { echo "skipped: root is needed for chroot"; exit 0; }
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[[ -e /usr/share/debootstrap/scripts/$release ]] || { echo "skipped: debootstrap has no script for \"$release\""; exit 0; }
mirror=http://deb.debian.org/debian
base=$build/clean-root.tar root=$build/clean-root
rm -rf "$root"
trap 'rm -rf "$root"' EXIT
if [[ ! -e $base ]]; then
  if ! debootstrap --variant=minbase "$release" "$root" "$mirror" >"$build/debootstrap.log" 2>&1; then
    tail -n 3 "$build/debootstrap.log"
    grep -qE "Failed getting release file|Couldn't download|Unable to|Temporary failure" "$build/debootstrap.log" || exit 1
    echo "skipped: debootstrap cannot reach $mirror"
    exit 0
  fi
  tar -C "$root" -cf "$base.part" . && mv "$base.part" "$base"
else
  mkdir "$root" && tar -C "$root" -xf "$base"
fi
cp "$build"/debs/{subimpact,python3-subimpact}_*.deb "$root/root/"
cp "$source/tests/python/installed.py" "$root/root/"
cp /etc/resolv.conf "$root/etc/resolv.conf"
echo "deb $mirror $release main" >"$root/etc/apt/sources.list"

inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive bash -euo pipefail -c "$1"; }
start=$SECONDS
inside 'cd /root
  apt-get -q update
  apt-get -q install -y --no-install-recommends ./subimpact_*.deb
  subimpact --version
  subimpact new hammer > case.toml
  subimpact run case.toml --out strike > printed
  grep -q "sub-impacts " printed
  cut -d, -f1-3 strike/events.csv | head -n 4'
echo "from apt to a result: $((SECONDS - start)) s"
start=$SECONDS
inside 'cd /root
  apt-get -q install -y --no-install-recommends ./python3-subimpact_*.deb
  python3 installed.py /usr
  subimpact-sweep --help | head -n 1
  apt-get -q remove -y subimpact python3-subimpact
  ! command -v subimpact'
echo "and by Python: $((SECONDS - start)) s"
