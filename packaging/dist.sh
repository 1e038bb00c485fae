#!/bin/sh
# dist.sh [OUT]: builds everything that a release has, in OUT (dist): static executables with their bills of materials,
# wheels, npm packages, the image, and checksums. Without npm, its packages are left out with a message.
# ARCH lists x86_64, aarch64 and windows. The default is the architecture of this machine. Debian's cross compilers build
# for aarch64 and for Windows on x86_64, and qemu-user-static and Wine run the results. RELEASE is the build folder for this
# machine (build/release). SYSROOT is the folder of sysroot.sh (build/sysroot-arm64).
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
out=${1:-$top/dist}
build=${BUILD:-$top/build}
jobs=${JOBS:-2}
machine=$(uname -m)
mkdir -p "$out" "$build"
out=$(cd "$out" && pwd) build=$(cd "$build" && pwd)
cd "$top"
packaging/check_version.sh
version=$(cat VERSION)
rm -f "$out"/facetmill-* "$out/SHA256SUMS"

debian_name() { case $1 in x86_64) echo amd64 ;; aarch64) echo arm64 ;; esac; }
npm_name() { case $1 in x86_64) echo linux-x64 ;; aarch64) echo linux-arm64 ;; windows) echo win32-x64 ;; esac; }

npm=
image=
for architecture in ${ARCH:-$machine}; do
    name=$(debian_name "$architecture") program=$out/facetmill-$version-linux-$architecture
    if [ "$architecture" = "$machine" ]; then
        folder=${RELEASE:-$build/release} emulator='' strip=strip
        packaging/linux/libraries.sh "$build/libraries"
        cmake --preset portable -B "$folder" -DFACETMILL_LIBRARIES="$build/libraries" --log-level=NOTICE
    elif [ "$architecture" = windows ] && [ "$machine" = x86_64 ]; then
        folder=${WINDOWS:-$build/windows} emulator=wine strip=x86_64-w64-mingw32-strip program=$out/facetmill-$version-windows-x86_64.exe
        tools/deps.sh --windows
        packaging/linux/libraries.sh "$build/libraries-windows" windows
        cmake --preset windows -B "$folder" -DFACETMILL_LIBRARIES="$build/libraries-windows" --log-level=NOTICE
    elif [ "$architecture" != aarch64 ]; then
        echo "$architecture cannot be built on $machine" >&2
        exit 1
    else
        folder=$build/$name sysroot=${SYSROOT:-$build/sysroot-$name} emulator=qemu-$architecture-static strip=$architecture-linux-gnu-strip
        tools/deps.sh "--$name"
        packaging/linux/sysroot.sh "$name" "$sysroot"
        packaging/linux/libraries.sh "$build/libraries-$name" "$sysroot"
        cmake --preset portable -B "$folder" -DFACETMILL_LIBRARIES="$build/libraries-$name" -DFACETMILL_TESTS=OFF \
            -DCMAKE_TOOLCHAIN_FILE="$top/packaging/linux/toolchain.cmake" -DFACETMILL_SYSROOT="$sysroot" \
            --log-level=NOTICE
    fi
    cmake --build "$folder" -j "$jobs" --target facetmill_static
    built=$folder/facetmill_static
    [ "$architecture" != windows ] || built=$built.exe
    "$strip" -o "$program" "$built"
    # shellcheck disable=SC2086  # nothing, or the emulator
    python3 packaging/linux/sbom.py "$program" "$program.spdx.json" $emulator
    python3 packaging/python/wheel.py "$program" "$architecture" "$out"
    npm="$npm $program $(npm_name "$architecture")"
    [ "$architecture" = windows ] || image="$image $program $name"
done

# shellcheck disable=SC2086  # lists of programs and architectures
if command -v npm >/dev/null; then
    node packaging/npm/pack.mjs "$out" $npm
else
    echo "npm is missing: no npm packages" >&2
fi
# shellcheck disable=SC2086
[ -z "$image" ] || python3 packaging/image/image.py "$out/facetmill-$version-image.tar" $image
(cd "$out" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\n' | LC_ALL=C sort | xargs sha256sum >SHA256SUMS)
cat "$out/SHA256SUMS"
