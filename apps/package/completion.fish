# Completion of ashlar for fish: commands and options are those that its --help lists, values are files.
function __ashlar_lines
    ashlar $argv --help 2>/dev/null
end
function __ashlar_commands
    __ashlar_lines | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'
end
function __ashlar_options
    set -l words (commandline -opc)
    __ashlar_lines $words[2] | sed -n '/^Options:/,/^$/p' | grep -Eo -- '--[a-z][a-z-]*'
end
function __ashlar_cases
    set -l words (commandline -opc)
    __ashlar_lines $words[2] | sed -n 's/^ *\([a-z][a-z-]*\): .*/\1/p'
end
complete -c ashlar -n __fish_use_subcommand -f -a '(__ashlar_commands) --help --version'
complete -c ashlar -n 'not __fish_use_subcommand' -a '(__ashlar_options)'
complete -c ashlar -n '__fish_seen_subcommand_from verify study' -f -a '(__ashlar_cases)'
