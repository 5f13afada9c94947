#compdef ashlar
# Completion of ashlar for zsh: commands and options are those that its --help lists, values are files.
_ashlar() {
  local program=${words[1]} command=${words[2]}
  if (( CURRENT == 2 )); then
    compadd -- ${(f)"$($program --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')"} --help --version
  elif [[ ${words[CURRENT]} == -* ]]; then
    compadd -- ${(f)"$($program $command --help 2>/dev/null | sed -n '/^Options:/,/^$/p' | grep -Eo -- '--[a-z][a-z-]*')"}
  elif [[ $command == verify || $command == study ]]; then
    compadd -- ${(f)"$($program $command --help 2>/dev/null | sed -n 's/^ *\([a-z][a-z-]*\): .*/\1/p')"}
  else
    _files
  fi
}
_ashlar "$@"
