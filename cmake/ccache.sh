#!/bin/sh
# ccache.sh CCACHE COMPILER ARGUMENT...: compiles through ccache.
# A precompiled header is removed before it is made again, because ccache takes an existing one for an input. Its comments
# count: the compiler recognises headers by their bytes, and would define twice what an older precompiled one has.
set -eu
case " $* " in
*" c++-header "*)
    before=
    for argument; do
        if [ "$before" = -o ]; then
            rm -f "$argument"
            break
        fi
        before=$argument
    done
    export CCACHE_COMMENTS=1
    ;;
esac
# Precompiled headers make ccache doubt the preprocessed text unless it is told that time macros do not matter.
CCACHE_SLOPPINESS=pch_defines,time_macros exec "$@"
