#!/bin/sh
# update_golden.sh [FACETMILL]: writes the golden files of `facetmill stages` anew (tests/golden/stages).
set -eu
cd "$(dirname "$0")/.."
facetmill=${1:-build/release/facetmill}
mkdir -p tests/golden/stages
rm -f tests/golden/stages/*.txt
"$facetmill" stages | while read -r name _; do
    "$facetmill" stages "$name" >"tests/golden/stages/$name.txt"
done
git status --short tests/golden/stages
