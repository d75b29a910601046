# bash completion for octupole. It asks the command itself, so that it knows what this build knows.

_octupole() {
  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[0]} words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="$("$command" --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p') --help --version"
  elif [[ $current == -* ]]; then
    words=$("$command" "${COMP_WORDS[1]}" --help 2>/dev/null |
      grep --only-matching --extended-regexp '^  (-[a-z],)?--[a-z-]+' | sed 's/^  \(-.,\)\?//')
  fi
  # Where there are no words, by -o default, files. Words of ours have no blanks.
  # shellcheck disable=SC2207
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -F _octupole octupole
