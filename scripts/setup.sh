# shellcheck shell=bash
# Shell functions shared by the scripts in this directory; to be sourced by them.
#
# On Debian (12 and later) and systems like it, what the build needs and the machine lacks is installed
# with apt. Elsewhere the packages are named and the build goes on with what CMake finds.

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Debian's names. A package that is there for one command is not asked for if the command exists.
readonly -A package_of_command=(
  [cmake]=cmake
  [ninja]=ninja-build
)
readonly packages=(
  build-essential
  libsundials-dev
  libsuitesparse-dev
  libeigen3-dev
  libfmt-dev
  nlohmann-json3-dev
  libtomlplusplus-dev
  libcli11-dev
  libssl-dev
  libjs-dygraphs
  libgtest-dev
  libbenchmark-dev
)
# Of the Python package and its tests. The build goes on without them.
readonly python_packages=(
  python3-dev
  python3-pybind11
  pybind11-dev
  python3-numpy
  python3-scipy
  python3-pandas
  python3-h5py
  python3-matplotlib
  python3-pytest
  python3-nbconvert
  python3-ipykernel
  python3-dask
  python3-distributed
  python3-mpi4py
  mypy
)

say() { printf '%s\n' "$*" >&2; }

has_command() { command -v "$1" >/dev/null 2>&1; }

is_installed() {
  dpkg-query --show --showformat='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed
}

# Runs a command as root, or fails if there is no way to. Asks for a password only at a terminal.
as_root() {
  if [[ $(id -u) -eq 0 ]]; then
    "$@"
  elif [[ -t 0 ]]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

install_with_apt() {
  local -a apt_get=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  as_root "${apt_get[@]}" -q update ||
    say "The package lists could not be refreshed; trying with those that are there."
  as_root "${apt_get[@]}" -q install -y --no-install-recommends "$@"
}

# install_missing_packages [PACKAGE...]: installs what is missing of the build's packages and of these.
# Never fatal: CMake has the last word on what it can use.
install_missing_packages() {
  local -a missing=()
  local name
  for name in "${!package_of_command[@]}"; do
    has_command "$name" || missing+=("${package_of_command[$name]}")
  done
  if ! has_command apt-get || ! has_command dpkg-query; then
    say "This system has no apt, so nothing is installed. Needed are CMake 3.25, Ninja, a"
    say "C++20 compiler and the development files of the libraries; Debian calls them"
    say "  ${package_of_command[*]} ${packages[*]}"
    say "Going on with what CMake finds."
    return
  fi
  for name in "${packages[@]}" "$@"; do
    is_installed "$name" || missing+=("$name")
  done
  install_or_name "${missing[@]}"
}

install_python_packages() {
  has_command apt-get && has_command dpkg-query || return 0
  local -a missing=()
  local name
  for name in "${python_packages[@]}"; do
    is_installed "$name" || missing+=("$name")
  done
  install_or_name "${missing[@]}"
}

# Installs packages, or says how to.
install_or_name() {
  [[ $# -gt 0 ]] || return 0
  say "Installing $*"
  if [[ $(id -u) -ne 0 ]] && ! has_command sudo; then
    say "This needs root and there is no sudo. As root: apt-get install $*"
  elif install_with_apt "$@"; then
    return
  else
    say "They could not be installed. As root: apt-get install $*"
  fi
  say "Going on with what CMake finds."
}

# build PRESET [TARGET...]: installs, configures and builds; everything if no target is named.
build() {
  local preset=$1
  shift
  install_missing_packages
  install_python_packages
  if ! has_command cmake || ! has_command ninja; then
    say "CMake and Ninja are needed to build, and are not there."
    return 1
  fi
  (
    cd "$project_root" || return
    cmake --preset "$preset"
    cmake --build --preset "$preset" ${1:+--target "$@"}
  )
}

# draw_figures ARGUMENT...: validation/figures.py with the Python package of the build.
draw_figures() {
  build release subimpact_python >&2
  PYTHONPATH=$project_root/build/release/python "$(cached Python_EXECUTABLE)" "$project_root/validation/figures.py" "$@"
}

# A variable of CMake's in the build.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$project_root/build/release/CMakeCache.txt"; }

# build_quietly PRESET TARGET: the same with a line per step; what it printed is shown if it fails.
build_quietly() {
  local log
  log=$(mktemp)
  say "1 of 3  Installing what is missing, and configuring"
  if ! { install_missing_packages && cd "$project_root" && cmake --preset "$1"; } >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
  say "2 of 3  Building the program (up to five minutes the first time)"
  if ! cmake --build --preset "$1" --target "$2" 2>&1 | tee "$log" | show_time_left; then
    grep -v '^\[' "$log" >&2
    return 1
  fi
}

# Shows the share that is done, and the time left, of a build by Ninja; on a terminal alone.
show_time_left() {
  local line started=$SECONDS
  while IFS= read -r line; do
    [[ -t 2 && $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    local n=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    printf '\r        %d of %d, some %d s left \033[K' "$n" "$all" \
      $(((SECONDS - started) * (all - n) / n)) >&2
  done
  [[ ! -t 2 ]] || printf '\r\033[K' >&2
}
