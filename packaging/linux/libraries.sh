#!/bin/sh
# libraries.sh PREFIX [SYSROOT]: builds static libraries from Debian's sources, in PREFIX/lib, in the installed versions.
# With SYSROOT, it builds the versions that sysroot.sh unpacked there, for the architecture of toolchain.cmake.
# Debian packages these five only as shared libraries. All others that facetmill links have a static library in their
# Debian package. PREFIX/sources.txt lists the source package and version of all: the licences of facetmill's libraries
# ask that people can get exactly these sources. A library that PREFIX already has in the wanted version is kept.
set -eu
prefix=${1:?usage: libraries.sh PREFIX [SYSROOT]} sysroot=${2:-}
toolchain=$(cd "$(dirname "$0")" && pwd)/toolchain.cmake
mkdir -p "$prefix/lib" "$prefix/include" "$prefix/build"
prefix=$(cd "$prefix" && pwd)
jobs=${JOBS:-2}
# These flags give the same arithmetic on every processor. facetmill's own objects have them, too.
exact="-ffp-contract=off -fsigned-char"
if [ -n "$sysroot" ]; then
    sysroot=$(cd "$sysroot" && pwd)
    CXX=aarch64-linux-gnu-g++ AR=aarch64-linux-gnu-ar
    export DPKG_ADMINDIR="$sysroot/var/lib/dpkg"
fi

# A private configuration of apt, so that the machine's list of sources stays as it is.
apt=$prefix/build/apt
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
cat >"$apt/sources.list" <<LIST
deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $suite main
LIST
cat >"$apt/apt.conf" <<CONF
Dir::Etc::sourcelist "$apt/sources.list";
Dir::Etc::sourceparts "-";
Dir::State::Lists "$apt/lists";
Dir::Cache "$apt/cache";
APT::Get::Only-Source "true";
APT::Sandbox::User "root";
CONF
export APT_CONFIG="$apt/apt.conf"
apt-get update -qq

fetch() { # fetch SOURCE PACKAGE: unpacks the source of the installed package, and sets `source`; false: built before
    version=$(dpkg-query -W -f '${source:Version}' "$2")
    echo "$1 $version" >>"$prefix/sources.txt.new"
    grep -qx "$1 $version" "$prefix/sources.txt" 2>/dev/null && [ -e "$prefix/build/$1.built" ] && return 1
    echo "building $1 $version" >&2
    rm -rf "$prefix/build/$1" && mkdir -p "$prefix/build/$1"
    (cd "$prefix/build/$1" && apt-get source -qq "$1=$version" >"$prefix/build/$1.log" 2>&1) || {
        tail -3 "$prefix/build/$1.log" >&2
        echo "Debian has no source of $1 $version any more: apt-get install --only-upgrade $2" >&2
        exit 1
    }
    source=$(find "$prefix/build/$1" -mindepth 1 -maxdepth 1 -type d)
}

with_cmake() { # with_cmake PACKAGE [OPTION...]
    package=$1 && shift
    cmake -S "$source" -B "$prefix/build/$package/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
        -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
        "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$source=. $exact" "-DCMAKE_C_FLAGS=-ffile-prefix-map=$source=. $exact" \
        ${sysroot:+"-DCMAKE_TOOLCHAIN_FILE=$toolchain"} ${sysroot:+"-DFACETMILL_SYSROOT=$sysroot"} "$@" >"$prefix/build/$package.log" 2>&1
    cmake --build "$prefix/build/$package/build" -j "$jobs" >>"$prefix/build/$package.log" 2>&1 || {
        tail -30 "$prefix/build/$package.log" >&2
        exit 1
    }
}

rm -f "$prefix/sources.txt.new"
if fetch fmtlib libfmt-dev; then
    with_cmake fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF && cmake --install "$prefix/build/fmtlib/build" >/dev/null
    touch "$prefix/build/fmtlib.built"
fi
if fetch meshoptimizer libmeshoptimizer-dev; then
    with_cmake meshoptimizer && cmake --install "$prefix/build/meshoptimizer/build" >/dev/null
    touch "$prefix/build/meshoptimizer.built"
fi
if fetch onetbb libtbb-dev; then
    # Without the lookups of other libraries at start: a static program has no use for them.
    sed -i '1i #define __TBB_WEAK_SYMBOLS_PRESENT 0' "$source/src/tbb/dynamic_link.cpp"
    with_cmake onetbb -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_EXAMPLES=OFF \
        "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$source=. $exact -U__TBB_USE_ITT_NOTIFY" && cmake --install "$prefix/build/onetbb/build" >/dev/null
    touch "$prefix/build/onetbb.built"
fi
if fetch openmesh libopenmesh-dev; then
    # Debian's patch removes the static libraries: its objects are put into archives instead.
    with_cmake openmesh -DBUILD_APPS=OFF -DOPENMESH_BUILD_UNIT_TESTS=OFF -DOPENMESH_DOCS=OFF -DBUILD_SHARED_LIBS=ON
    for part in Core Tools; do
        rm -f "$prefix/lib/libOpenMesh$part.a"
        find "$prefix/build/openmesh/build/src/OpenMesh/$part" -name '*.o' | LC_ALL=C sort |
            xargs "${AR:-ar}" rcsD "$prefix/lib/libOpenMesh$part.a"
    done
    touch "$prefix/build/openmesh.built"
fi
if fetch tinygltf libtinygltf-dev; then
    # facetmill decodes images with other libraries, so tinygltf needs none.
    # shellcheck disable=SC2086  # a list of options
    "${CXX:-g++}" ${sysroot:+"--sysroot=$sysroot"} -O2 -fPIC -std=c++17 $exact -DTINYGLTF_NO_STB_IMAGE -DTINYGLTF_NO_STB_IMAGE_WRITE \
        -c "$source/tiny_gltf.cc" -o "$prefix/build/tinygltf/tiny_gltf.o"
    rm -f "$prefix/lib/libtinygltf.a" && "${AR:-ar}" rcsD "$prefix/lib/libtinygltf.a" "$prefix/build/tinygltf/tiny_gltf.o"
    touch "$prefix/build/tinygltf.built"
fi

if [ -n "$sysroot" ]; then
    # Debian compiles these two with fused multiply-add for arm64, so their outputs would differ from x86-64.
    if fetch draco libdraco-dev; then
        with_cmake draco && cmake --install "$prefix/build/draco/build" >/dev/null
        touch "$prefix/build/draco.built"
    fi
    if fetch libwebp libwebp-dev; then
        # shellcheck disable=SC2046  # a list of options
        with_cmake libwebp $(printf -- '-DWEBP_BUILD_%s=OFF ' ANIM_UTILS CWEBP DWEBP GIF2WEBP IMG2WEBP VWEBP WEBPINFO WEBPMUX EXTRAS) &&
            cmake --install "$prefix/build/libwebp/build" >/dev/null
        touch "$prefix/build/libwebp.built"
    fi
fi

# The others, as installed; headers count, too, because templates are compiled into the program.
compiler=$("${CXX:-g++}" -dumpversion | cut -d. -f1)
for package in libdraco-dev libyaml-cpp-dev nettle-dev libpng-dev libjpeg-dev libjpeg62-turbo-dev libwebp-dev libzstd-dev \
    libexpat1-dev libmpfr-dev libgmp-dev zlib1g-dev libseccomp-dev libcgal-dev libcli11-dev libeigen3-dev nlohmann-json3-dev \
    "$(dpkg-query -S "$sysroot/usr/include/boost/version.hpp" | cut -d: -f1)" libc6-dev "libstdc++-$compiler-dev"; do
    dpkg-query -W -f '${source:Package} ${source:Version}\n' "$package" 2>/dev/null || true
done >>"$prefix/sources.txt.new"
LC_ALL=C sort -u "$prefix/sources.txt.new" >"$prefix/sources.txt"
rm "$prefix/sources.txt.new"
