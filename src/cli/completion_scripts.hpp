#pragma once
// The completion functions of each shell. completions.cpp writes the word tables that they use. In the
// tables, <files> means file names.

namespace facetmill::cli {

/// For bash and zsh: prints the possible words, each with a tab and a help text. Files are offered if no
/// words are printed, or with <files>. _facetmill_table prints the rows of a table, _facetmill_is_stage
/// recognises stages.
inline constexpr const char* candidates_sh = R"SH(
# $1: the word that is typed; then the words before it, without facetmill itself.
_facetmill_candidates() {
  local word=$1 command=${2-} stage='' option='' before
  shift
  if [ $# -eq 0 ]; then
    _facetmill_table commands
    return
  fi
  shift
  [ "$command" = pipe ] && stage=none
  for before in "$@"; do
    option=''
    case $before in
      '!' | '+' | '[') stage=due ;;
      ']') stage=over ;;
      -*) option=$before ;;
      *) case $stage in
           none | due) _facetmill_is_stage "$before" && stage=$before ;;
         esac ;;
    esac
  done
  case $stage in
    '') _facetmill_of "command $command" "$word" "$option" ;;
    none) case $word in
            -*) _facetmill_table 'options command pipe' ;;
            *) _facetmill_of 'command pipe' "$word" "$option" ;;
          esac ;;
    due) _facetmill_table stages ;;
    over) ;;
    *) _facetmill_of "stage $stage" "$word" "$option" ;;
  esac
}

# $1: "stage clip" or "command run"; $2: the word that is typed; $3: the option before it, or nothing.
_facetmill_of() {
  case $2 in
    -*) _facetmill_table "options $1"
        case $1 in 'stage '*) _facetmill_table 'options of every stage' ;; esac ;;
    *) _facetmill_table "values $1 $3" ;;
  esac
}
)SH";

inline constexpr const char* bash_end = R"SH(
_facetmill() {
  local line
  COMPREPLY=()
  while IFS= read -r line; do
    line=${line%%$'\t'*}
    case $line in
      '<files>') compopt -o filenames 2>/dev/null
                 while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen -f -- "${COMP_WORDS[COMP_CWORD]}") ;;
      "${COMP_WORDS[COMP_CWORD]}"*) COMPREPLY+=("$line") ;;
    esac
  done < <(_facetmill_candidates "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[@]:1:COMP_CWORD-1}")
}
complete -o default -F _facetmill facetmill
)SH";

inline constexpr const char* zsh_end = R"SH(
_facetmill() {
  local line files=1
  local -a described
  while IFS= read -r line; do
    files=0
    if [[ $line == '<files>' ]]; then
      files=1
      break
    fi
    described+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
  done < <(_facetmill_candidates "${words[CURRENT]}" "${(@)words[2,CURRENT-1]}")
  local found=1
  (( ${#described} )) && _describe -V facetmill described && found=0
  (( files || found )) && _files && found=0
  return found
}
compdef _facetmill facetmill
)SH";

inline constexpr const char* fish_end = R"FISH(
function __facetmill_of
    switch "$argv[2]"
        case '-*'
            __facetmill_table "options $argv[1]"
            string match -q 'stage *' -- "$argv[1]"; and __facetmill_table 'options of every stage'
        case '*'
            __facetmill_table "values $argv[1] $argv[3]"
    end
end

function __facetmill_candidates
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    if test (count $words) -le 1
        __facetmill_table commands
        return
    end
    set -l command $words[2]
    set -l stage ''
    set -l option ''
    test $command = pipe; and set stage none
    for before in $words[3..-1]
        set option ''
        switch $before
            case '!' '+' '['
                set stage due
            case ']'
                set stage over
            case '-*'
                set option $before
            case '*'
                if contains -- "$stage" none due; and contains -- $before $__facetmill_stages
                    set stage $before
                end
        end
    end
    switch "$stage"
        case ''
            __facetmill_of "command $command" "$word" "$option"
        case none
            __facetmill_of 'command pipe' "$word" "$option"
        case due
            __facetmill_table stages
        case over
        case '*'
            __facetmill_of "stage $stage" "$word" "$option"
    end
end

function __facetmill_takes_files
    set -l candidates (__facetmill_candidates)
    test (count $candidates) -eq 0; or contains -- '<files>' $candidates
end
complete -c facetmill -n 'not __facetmill_takes_files' -f
complete -c facetmill -a '(__facetmill_candidates | string match -v "<files>")'
)FISH";

} // namespace facetmill::cli
