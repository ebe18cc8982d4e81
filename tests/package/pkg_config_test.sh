#!/usr/bin/env bash
# pkg_config_test.sh PACKAGE COMPILER SOURCE PROGRAM [OPTION...]: builds a program by hand and runs it.
set -euo pipefail
package=$1 compiler=$2 source=$3 program=$4
shift 4
read -r -a flags <<< "$(pkg-config --cflags "$package")"
read -r -a libraries <<< "$(pkg-config --libs "$package")"
[[ $(pkg-config --modversion "$package") =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]
"$compiler" -std=c++20 "$@" "${flags[@]}" "$source" -o "$program" "${libraries[@]}"
"$program"
