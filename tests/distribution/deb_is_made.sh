#!/usr/bin/env bash
# deb_is_made.sh SOURCE BUILD: cpack makes the packages, and they have what they should.
set -euo pipefail
build=$2
for tool in cpack dpkg-deb dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is missing"; exit 0; }
done
rm -rf "$build/debs"
cd "$build"
cpack -B "$build/debs"
cd "$build/debs"
has() { dpkg-deb --contents "$1"_*.deb | grep " \./$2\$" >/dev/null || { echo "$1 lacks $2"; exit 1; }; }
has subimpact usr/bin/subimpact
has subimpact usr/share/man/man1/subimpact.1.gz
has subimpact usr/share/bash-completion/completions/subimpact
has subimpact usr/share/doc/subimpact/copyright
has libsubimpact-dev usr/include/subimpact/case/simulate.h
has python3-subimpact usr/lib/python3/dist-packages/subimpact/__init__.py
dpkg-deb --field subimpact_*.deb Depends | grep libsundials >/dev/null
