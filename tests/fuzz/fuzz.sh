#!/bin/sh
# fuzz.sh FUZZ_BYTES TARGET|all SECONDS [OPTION...]: libFuzzer over what reads bytes (tests/support/fuzz_targets.hpp), from
# the files of tests/data/fuzz and of earlier runs, with the words of tests/fuzz/words; all: each in turn, for its share of the time.
# fuzz.sh table: all runs so far, as a table.
# What is found lies in build/fuzz/found, how long which target ran in build/fuzz/runs.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
data=$here/../data/fuzz
runs=build/fuzz/runs

if [ "$1" = table ]; then
    echo "| target | executions | minutes of the processor | edges reached |"
    echo "|---|---|---|---|"
    sort "$runs" | awk '
        { executions[$1] += $2; seconds[$1] += $3; if ($4 > edges[$1]) edges[$1] = $4; e += $2; s += $3; if (!seen[$1]++) order[++n] = $1 }
        END { for (i = 1; i <= n; i++) { t = order[i]; printf "| %s | %d | %.1f | %d |\n", t, executions[t], seconds[t] / 60, edges[t] }
              printf "| all | %d | %.1f | |\n", e, s / 60 }'
    exit 0
fi

program=$(realpath "$1") target=$2 seconds=$3
shift 3
targets=$target
if [ "$target" = all ]; then
    targets=$(ls "$data")
    seconds=$((seconds / $(echo "$targets" | wc -w)))
fi

# Sets spent: seconds of the processor that the fuzzers have taken so far.
look_at_clock() {
    times >build/fuzz/times
    spent=$(awk 'NR == 2 { split($1, u, /[ms]/); split($2, s, /[ms]/)
                           printf "%.2f", 60 * (u[1] + s[1]) + u[2] + s[2] }' build/fuzz/times)
}

# Another target reads the same language.
words_of() {
    case $1 in
    glb) echo gltf ;;
    model) echo 3mf ;;
    packed) echo ply ;;
    *) echo "$1" ;;
    esac
}

status=0
for target in $targets; do
    corpus=$PWD/build/fuzz/corpus/$target found=$PWD/build/fuzz/found/$target
    mkdir -p "$corpus" "$found" build/fuzz/empty
    words=$here/words/$(words_of "$target").dict
    dictionary=
    if [ -e "$words" ]; then dictionary=-dict=$words; fi
    log=$found/log
    look_at_clock
    before=$spent
    # In an empty folder, since a pipeline may ask for all files below it (**).
    # shellcheck disable=SC2086  # none or one word
    (
        cd build/fuzz/empty
        FACETMILL_TARGET=$target exec "$program" "-max_total_time=$seconds" -timeout=25 -rss_limit_mb=2048 -max_len=16384 \
            -print_final_stats=1 "-artifact_prefix=$found/" $dictionary "$@" "$corpus" "$data/$target"
    ) >"$log" 2>&1 || status=1
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -1)
    look_at_clock
    echo "$target ${executions:-0} $(echo "$spent $before" | awk '{ printf "%.2f", $1 - $2 }') ${edges:-0}" >>"$runs"
    echo "$target: ${executions:-0} executions, ${edges:-0} edges reached, $(find "$found" -type f ! -name log | wc -l) found"
done
exit $status
