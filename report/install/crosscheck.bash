# bash completion for crosscheck: commands, their options, and the names listed by `crosscheck list`
_crosscheck() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} options="" kinds="" words="" kind
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "{{#each commands}}{{{name}}} {{/each}}--help --version" -- "$cur")
    return
  fi
  case ${COMP_WORDS[1]} in
    {{#each commands}}
    {{{name}}}) options="-h --help{{#each options}}{{#each names}} {{{this}}}{{/each}}{{/each}}" kinds="{{{kinds}}}" ;;
    {{/each}}
  esac
  case ${COMP_WORDS[1]} in
    list) words="scenes methods engines experiments assignments" ;;
  esac
  case $prev in
    --method | --methods | --against) kinds=methods ;;
  esac
  case $cur in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur") ;;
    *)
      mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
      for kind in $kinds; do
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" list "$kind" 2>/dev/null | cut -d' ' -f1)" -- "$cur")
      done
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$cur") ;;
  esac
}
complete -o filenames -F _crosscheck crosscheck
