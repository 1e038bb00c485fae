#!/bin/sh
# reproduce.sh [DIST]: builds the packages of this commit again, in another folder, and compares them with DIST (dist).
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
dist=$(cd "${1:-$top/dist}" && pwd)
other=$(mktemp -d)
trap 'rm -rf "$other"' EXIT
git clone -q --no-hardlinks "$top" "$other/sources"
ARCH=$(find "$dist" -name 'facetmill-*-linux-*' ! -name '*.json' | sed 's/.*-linux-//' | LC_ALL=C sort -r | tr '\n' ' ')
[ -z "$(find "$dist" -name 'facetmill-*-windows-*.exe')" ] || ARCH="$ARCH windows"
ARCH=$ARCH "$other/sources/packaging/dist.sh" "$other/dist" >/dev/null
diff "$dist/SHA256SUMS" "$other/dist/SHA256SUMS"
echo "all $(wc -l <"$dist/SHA256SUMS") files have equal bytes"
