#!/usr/bin/env bash
# completion_test.sh PROGRAM: in bash, the completion that the program prints offers each command and each
# option that --help lists, keys after --set, and files where nothing else is known.
set -euo pipefail
program=$1
subimpact() { "$program" "$@"; }
source <(subimpact completion)
[[ $(complete -p subimpact) == *"-o default"*"-F _subimpact subimpact" ]]

# completed WORD...: what the last word may become.
completed() {
  COMP_WORDS=(subimpact "$@")
  COMP_CWORD=$#
  compopt() { :; } # is for a completion that readline has begun
  _subimpact
  printf '%s\n' "${COMPREPLY[@]}"
}
is() { [[ $1 == "$2" ]] || { printf 'got:\n%s\nnot:\n%s\n' "$1" "$2"; exit 1; }; }

commands=$("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
[[ $(wc -w <<<"$commands") -ge 13 ]]
is "$(completed '' | grep -v '^-' | sort)" "$(sort <<<"$commands")"
is "$(completed rep)" report
for command in $commands; do
  options=$("$program" "$command" --help | grep -oE '^  (-h,)?--[a-z,-]+' | tr -d ' ' | tr , '\n' | grep '^--')
  is "$(completed "$command" -- | sort)" "$(sort <<<"$options")"
done
is "$(completed new ba)" ball-drop
is "$(completed run case.toml --set beam.len)" beam.length=
is "$(completed run case.toml --method exp)" exponential
is "$(completed run case.toml --out '')" ""
is "$(completed run cas)" ""
