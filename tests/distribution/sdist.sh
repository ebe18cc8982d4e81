#!/usr/bin/env bash
# sdist.sh SOURCE BUILD: the source distribution holds what a build needs: CMake configures it, and the
# wheel's metadata are its own.
set -euo pipefail
source=$1 build=$2
python=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt")
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$source"
PYTHONPATH=$source/python/packaging "$python" -c "
import cmake_backend
print(cmake_backend.build_sdist('$place'))"
cd "$place"
tar -xzf subimpact-*.tar.gz
rm subimpact-*.tar.gz
cd subimpact-*
grep -q '^Name: subimpact$' PKG-INFO
# Every file that git tracks, and none that a build has made.
if git -C "$source" rev-parse 2>/dev/null; then
  diff <(git -C "$source" ls-files | sort) <(find . -type f -printf '%P\n' | grep -vx PKG-INFO | sort) >../difference || true
  ! grep '^<' ../difference
fi
[[ ! -e build && ! -e .git ]]
cmake -S . -B "$place/build" -G Ninja -DSUBIMPACT_PYTHON=ON -DPython_EXECUTABLE="$python" \
  -DSUBIMPACT_TESTS=OFF -DSUBIMPACT_BENCHMARKS=OFF >/dev/null
