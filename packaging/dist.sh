#!/bin/sh
# dist.sh [OUT]: builds everything that a release has, in OUT (dist): the static executable with its bill of materials,
# the wheel, the npm packages, the image, and checksums. Two runs in two folders give the same bytes. ARM64=yes adds the
# packages for arm64 (packaging/linux/cross.sh builds its executable). What cannot be made here is named.
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
cmake --preset portable -B "$build/portable" -DFACETMILL_LIBRARIES="$build/libraries" --log-level=NOTICE
cmake --build "$build/portable" -j "$jobs" --target facetmill

version=$(cat VERSION)
program=$out/facetmill-$version-linux-x86_64
strip -o "$program" "$build/portable/facetmill"
python3 packaging/linux/sbom.py "$program" "$program.spdx.json"
python3 packaging/python/wheel.py "$program" x86_64 "$out"
set -- "$program" x64
images="$program amd64"
if [ "${ARM64:-no}" = yes ]; then
    packaging/linux/cross.sh "$build/arm64"
    arm=$out/facetmill-$version-linux-aarch64
    cp "$build/arm64/facetmill" "$arm"
    python3 packaging/linux/sbom.py "$arm" "$arm.spdx.json" qemu-aarch64-static
    python3 packaging/python/wheel.py "$arm" aarch64 "$out"
    set -- "$@" "$arm" arm64
    images="$images $arm arm64"
fi
if command -v npm >/dev/null; then
    node packaging/npm/pack.mjs "$out" "$@"
else
    echo "npm is missing: no npm packages" >&2
fi
# shellcheck disable=SC2086  # pairs of words
python3 packaging/image/image.py "$out/facetmill-$version-image.tar" $images
(cd "$out" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\n' | LC_ALL=C sort | xargs sha256sum >SHA256SUMS)
cat "$out/SHA256SUMS"
