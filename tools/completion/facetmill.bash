# Completion of facetmill for bash. Stages, formats and options are asked of facetmill itself.
_facetmill() {
    local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} previous=${COMP_WORDS[COMP_CWORD-1]} words
    if [ "$COMP_CWORD" = 1 ]; then
        words="run plan pipe check info diff stages schema formats explain --help --version"
    elif [ "$command" = stages ] || { [ "$command" = pipe ] && [[ $previous =~ ^[!+\[]$ || $previous = pipe ]]; }; then
        words=$(facetmill stages 2>/dev/null | sed 's/ .*//')
    elif [ "$command" = explain ]; then
        words=$(facetmill explain 2>/dev/null | sed "s/ .*//")
    elif [ "$command" = schema ]; then
        words="pipeline report info diff"
    elif [[ $word = -* ]]; then
        words=$(facetmill "$command" --help 2>/dev/null | grep -oE -- '--[a-z-]+' | sort -u)
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _facetmill facetmill
