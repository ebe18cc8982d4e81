#!/usr/bin/env bash
# manual_test.sh PROGRAM: groff sets the manual page without a warning, man finds its name, and it has each
# command, each option that --help lists, and each key.
set -euo pipefail
program=$1
for tool in groff lexgrog; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is missing (Debian: groff, man-db)"; exit 0; }
done
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$program" manual >"$place/subimpact.1"
groff -man -ww -Tutf8 "$place/subimpact.1" >"$place/text" 2>"$place/warnings"
[[ ! -s $place/warnings ]] || { cat "$place/warnings"; exit 1; }
lexgrog "$place/subimpact.1" | grep -q '"subimpact - '
# Without marks for bold and line ends of the terminal.
text=$(sed 's/\x1b\[[0-9;]*m//g; s/.\x08//g' "$place/text")
has() { grep -qE -- "$1" <<<"$text" || { echo "the manual lacks $1"; exit 1; }; }
for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'); do
  has "^ +subimpact $command\$"
  for option in $("$program" "$command" --help | grep -oE '^  (-h,)?--[a-z,-]+'); do has "^ +${option}( |\$|\{|\[)"; done
done
for key in beam.length striker.velocity contact.law time.end; do has "^ +$key( |\$)"; done
