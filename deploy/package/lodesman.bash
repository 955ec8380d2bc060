# SPDX-License-Identifier: Apache-2.0
# Completion of `lodesman` for bash. It asks the program itself, so that it knows what is there.

# _lodesman_words <word...>: the subcommands, or the options, that `lodesman <word...> --help` lists.
_lodesman_words() {
  lodesman "$@" --help 2>/dev/null | awk '
    /^Subcommands:/ { listed = 1; next }
    /^[A-Z]/ { listed = 0 }
    listed && /^  [a-z]/ { print $1 }
    /^  -/ { n = split($1, names, ","); for (i = 1; i <= n; i++) print names[i] }'
}

_lodesman_scenarios() {
  local file
  for file in /usr/share/lodesman/hal_sim/scenarios/*.toml; do
    basename "$file" .toml
  done
}

_lodesman() {
  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(_lodesman_words)" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_lodesman_words "$command")" -- "$current")
  elif [[ $command == sim || $command == hil ]] && ((COMP_CWORD == 2)); then
    mapfile -t COMPREPLY < <(compgen -W "$(_lodesman_scenarios)" -- "$current"; compgen -f -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -F _lodesman lodesman
