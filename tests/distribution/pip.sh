#!/usr/bin/env bash
# pip.sh SOURCE BUILD: pip installs the source tree in a fresh environment that sees Debian's NumPy and has no
# network, and the package computes a strike from there. The build tree is that of the other packages, so
# that the library is compiled once.
set -euo pipefail
source=$1 build=$2
python=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt")
"$python" -c 'import ensurepip, venv' 2>/dev/null || { echo "skipped: python3-venv is missing"; exit 0; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$python" -m venv --system-site-packages "$place/venv"
start=$SECONDS
# Without a network: where a space of names of its own can be made, pip could reach none.
offline=()
! unshare --net true 2>/dev/null || offline=(unshare --net)
cd "$place"
PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 "${offline[@]}" "$place/venv/bin/pip" install \
  --config-settings "build-dir=$build" "$source"
cp "$source/tests/python/installed.py" .
venv/bin/python installed.py "$place/venv"
echo "from pip to a result: $((SECONDS - start)) s${offline:+, without a network}"
venv/bin/pip uninstall -q -y subimpact
! venv/bin/python -c 'import subimpact' 2>/dev/null
