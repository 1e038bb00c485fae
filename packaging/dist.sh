#!/bin/sh
# dist.sh [OUT]: builds everything that a release has, in OUT (dist): the static executable with its bill of materials,
# the wheel, the npm packages, the image, and checksums, for x86-64. Without npm, its packages are left out with a message.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
out=${1:-$top/dist}
build=${BUILD:-$top/build}
jobs=${JOBS:-2}
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$top"
packaging/check_version.sh

packaging/linux/libraries.sh "$build/libraries"
cmake --preset portable -B "$build/release" -DFACETMILL_LIBRARIES="$build/libraries" --log-level=NOTICE
cmake --build "$build/release" -j "$jobs" --target facetmill_static

version=$(cat VERSION)
rm -f "$out"/facetmill-* "$out/SHA256SUMS"
program=$out/facetmill-$version-linux-x86_64
strip -o "$program" "$build/release/facetmill_static"
python3 packaging/linux/sbom.py "$program" "$program.spdx.json"
python3 packaging/python/wheel.py "$program" x86_64 "$out"
if command -v npm >/dev/null; then
    node packaging/npm/pack.mjs "$out" "$program" x64
else
    echo "npm is missing: no npm packages" >&2
fi
python3 packaging/image/image.py "$out/facetmill-$version-image.tar" "$program" amd64
(cd "$out" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\n' | LC_ALL=C sort | xargs sha256sum >SHA256SUMS)
cat "$out/SHA256SUMS"
