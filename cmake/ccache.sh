#!/bin/sh
# ccache.sh CCACHE COMPILER ARGUMENT...: compiles through ccache.
# A precompiled header that is already there is removed before it is made anew: else ccache takes it for one that the
# compiler reads, looks no further, and may answer with one that was made of other headers.
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
    ;;
esac
# Precompiled headers make ccache doubt the preprocessed text unless it is told that time macros do not matter.
CCACHE_SLOPPINESS=pch_defines,time_macros exec "$@"
