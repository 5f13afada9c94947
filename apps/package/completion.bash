# Completion of ashlar for bash: commands and options are those that its --help lists, values are files.
_ashlar() {
  local cur prev words cword
  _init_completion || return
  if ((cword == 1)); then
    COMPREPLY=($(compgen -W "$("$1" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p') --help --version" -- "$cur"))
  elif [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$("$1" "${words[1]}" --help 2>/dev/null | sed -n '/^Options:/,/^$/p' | grep -Eo -- '--[a-z][a-z-]*')" -- "$cur"))
  elif [[ ${words[1]} == verify || ${words[1]} == study ]]; then
    COMPREPLY=($(compgen -W "$("$1" "${words[1]}" --help 2>/dev/null | sed -n 's/^ *\([a-z][a-z-]*\): .*/\1/p')" -- "$cur"))
  else
    _filedir
  fi
} && complete -F _ashlar ashlar
