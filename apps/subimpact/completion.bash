# Completion of bash for subimpact, as `subimpact completion` prints it. The words come from what the
# program prints of itself: --help, keys and methods.
_subimpact() {
  local word=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD-1]}
  local options='s/^  \(-h,\)\?\(--[a-z-]*\)\(,\(--[a-z-]*\)\)\?.*/\2 \4/p' help words=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    help=$("${COMP_WORDS[0]}" --help)
    words=$(sed -n "/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p; $options" <<<"$help")
  elif help=$("${COMP_WORDS[0]}" "${COMP_WORDS[1]}" --help 2>/dev/null); then
    case $word:$last in
      -*:*) words=$(sed -n "$options" <<<"$help") ;;
      *:--set) words=$("${COMP_WORDS[0]}" keys |
                awk '/^\[/ {table = substr($1, 2, length($1) - 2) "."} /^[a-z]/ {print table $1 "="}') ;;
      *:--method | *:--methods) words=$("${COMP_WORDS[0]}" methods | sed -n '2,/^$/s/^  \([a-z-]*\) .*/\1/p') ;;
      *:--*) words=$(sed -n "s/^  $last TEXT:{\(.*\)}.*/\1/p" <<<"$help" | tr , ' ') ;;
      *) words=$(sed -n '/^Positionals:/,/^$/s/.*{\(.*\)}.*/\1/p' <<<"$help" | tr , ' ') ;;
    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  [[ ${#COMPREPLY[@]} -ne 1 || $COMPREPLY != *= ]] || compopt -o nospace
}
complete -o default -F _subimpact subimpact
