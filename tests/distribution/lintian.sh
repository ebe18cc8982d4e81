#!/usr/bin/env bash
# lintian.sh SOURCE BUILD: lintian finds no error in the packages, but for the address of the maintainer.
set -euo pipefail
command -v lintian >/dev/null || { echo "skipped: lintian is missing"; exit 0; }
cd "$2/debs"
# Without DEBEMAIL the maintainer has an address of this machine, which is for local use.
lintian --fail-on error --allow-root \
  --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog ./*.deb
