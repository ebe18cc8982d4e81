#!/usr/bin/env bash
# pkg_config_test.sh COMPILER SOURCE PROGRAM [OPTION...]: builds a program by hand and runs it.
set -euo pipefail
compiler=$1 source=$2 program=$3
shift 3
read -r -a flags <<< "$(pkg-config --cflags subimpact)"
read -r -a libraries <<< "$(pkg-config --libs subimpact)"
[[ $(pkg-config --modversion subimpact) =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]
"$compiler" -std=c++20 "$@" "${flags[@]}" "$source" -o "$program" "${libraries[@]}"
"$program"
