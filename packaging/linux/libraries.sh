#!/bin/sh
# libraries.sh PREFIX [SYSROOT | windows]: builds static libraries from Debian's sources, in PREFIX/lib, in the installed
# versions. With SYSROOT, it builds the versions that sysroot.sh unpacked there, for the architecture of toolchain.cmake.
# With windows, it builds all libraries, by Debian's mingw-w64 (packaging/windows/toolchain.cmake).
# Debian packages these five only as shared libraries. All others that facetmill links have a static library in their
# Debian package. PREFIX/sources.txt lists the source package and version of all: the licences of facetmill's libraries
# ask that people can get exactly these sources. A library that PREFIX already has in the wanted version is kept.
set -eu
prefix=${1:?usage: libraries.sh PREFIX [SYSROOT | windows]} sysroot=${2:-} windows=
toolchain=$(cd "$(dirname "$0")" && pwd)/toolchain.cmake
if [ "$sysroot" = windows ]; then
    sysroot='' windows=yes toolchain=$(cd "$(dirname "$0")/../windows" && pwd)/toolchain.cmake
    host=x86_64-w64-mingw32
    CXX=$host-g++-posix AR=$host-ar
fi
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
key=[signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]
cat >"$apt/sources.list" <<LIST
deb-src $key http://deb.debian.org/debian $suite main
deb-src $key http://deb.debian.org/debian $suite-updates main
deb-src $key http://deb.debian.org/debian-security $suite-security main
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
    versions=$(dpkg-query -W -f '${source:Version}' "$2")
    # For Windows, no installed library needs the same headers, so the newest version that can be had is taken.
    [ -z "$windows" ] || versions=$(apt-cache showsrc "$1" | sed -n 's/^Version: //p' | sort -rVu)
    for version in $versions; do
        if [ "$(cat "$prefix/build/$1.built" 2>/dev/null)" = "$version" ]; then
            echo "$1 $version" >>"$prefix/sources.txt.new"
            return 1
        fi
        rm -rf "$prefix/build/new" && mkdir "$prefix/build/new"
        (cd "$prefix/build/new" && apt-get source -qq "$1=$version" >"$prefix/build/$1.log" 2>&1) || continue
        echo "building $1 $version" >&2
        rm -rf "$prefix/build/$1" "$prefix/build/$1.built" && mv "$prefix/build/new" "$prefix/build/$1"
        echo "$1 $version" >>"$prefix/sources.txt.new"
        source=$(find "$prefix/build/$1" -mindepth 1 -maxdepth 1 -type d)
        return 0
    done
    tail -3 "$prefix/build/$1.log" >&2
    echo "Debian has no source of $1 $versions any more: apt-get install --only-upgrade $2" >&2
    exit 1
}

built() { # built SOURCE: an interrupted script goes on after it
    echo "$version" >"$prefix/build/$1.built"
}

with_cmake() { # with_cmake PACKAGE [OPTION...]
    package=$1 && shift
    cmake -S "$source" -B "$prefix/build/$package/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
        -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
        "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$source=. $exact" "-DCMAKE_C_FLAGS=-ffile-prefix-map=$source=. $exact" \
        ${sysroot:+"-DCMAKE_TOOLCHAIN_FILE=$toolchain"} ${sysroot:+"-DFACETMILL_SYSROOT=$sysroot"} \
        ${windows:+"-DCMAKE_TOOLCHAIN_FILE=$toolchain"} ${windows:+"-DFACETMILL_LIBRARIES=$prefix"} "$@" >"$prefix/build/$package.log" 2>&1
    cmake --build "$prefix/build/$package/build" -j "$jobs" >>"$prefix/build/$package.log" 2>&1 || {
        tail -30 "$prefix/build/$package.log" >&2
        exit 1
    }
}

with_configure() { # with_configure PACKAGE [OPTION...]: only for windows
    package=$1 && shift
    mkdir -p "$prefix/build/$package/build"
    # Debian's patches make these files older than their sources, and make would call autoconf for them.
    for file in aclocal.m4 configure stamp-h.in config.h.in config.in Makefile.in; do
        find "$source" -name "$file" -exec touch {} +
    done
    # Assembler and C of the library, without the folder's name.
    (cd "$prefix/build/$package/build" && "$source/configure" --host="$host" --prefix="$prefix" --libdir="$prefix/lib" \
        --enable-static --disable-shared CC="$host-gcc-posix" CXX="$host-g++-posix" CC_FOR_BUILD=gcc \
        CFLAGS="-O2 -ffile-prefix-map=$source=. $exact" CXXFLAGS="-O2 -ffile-prefix-map=$source=. $exact" \
        "CPPFLAGS=-I$prefix/include" "LDFLAGS=-L$prefix/lib" "$@" && make -j "$jobs" && make install) >"$prefix/build/$package.log" 2>&1 || {
        tail -30 "$prefix/build/$package.log" >&2
        exit 1
    }
    built "$package"
}

rm -f "$prefix/sources.txt.new"
if fetch fmtlib libfmt-dev; then
    with_cmake fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF && cmake --install "$prefix/build/fmtlib/build" >/dev/null
    built fmtlib
fi
if fetch meshoptimizer libmeshoptimizer-dev; then
    with_cmake meshoptimizer && cmake --install "$prefix/build/meshoptimizer/build" >/dev/null
    built meshoptimizer
fi
if fetch onetbb libtbb-dev; then
    # Without the lookups of other libraries at start: a static program has no use for them.
    sed -i '1i #define __TBB_WEAK_SYMBOLS_PRESENT 0' "$source/src/tbb/dynamic_link.cpp"
    with_cmake onetbb -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_EXAMPLES=OFF \
        "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$source=. $exact -U__TBB_USE_ITT_NOTIFY${windows:+ -mwaitpkg}" && cmake --install "$prefix/build/onetbb/build" >/dev/null
    built onetbb
fi
if fetch openmesh libopenmesh-dev; then
    # Debian's patch removes the static libraries: its objects are put into archives instead.
    with_cmake openmesh -DBUILD_APPS=OFF -DOPENMESH_BUILD_UNIT_TESTS=OFF -DOPENMESH_DOCS=OFF -DBUILD_SHARED_LIBS=ON
    for part in Core Tools; do
        rm -f "$prefix/lib/libOpenMesh$part.a"
        find "$prefix/build/openmesh/build/src/OpenMesh/$part" -name '*.o*' | LC_ALL=C sort |
            xargs "${AR:-ar}" rcsD "$prefix/lib/libOpenMesh$part.a"
    done
    built openmesh
fi
if [ -z "$windows" ] && fetch tinygltf libtinygltf-dev; then
    # facetmill decodes images with other libraries, so tinygltf needs none.
    # shellcheck disable=SC2086  # a list of options
    "${CXX:-g++}" ${sysroot:+"--sysroot=$sysroot"} -O2 -fPIC -std=c++17 $exact -DTINYGLTF_NO_STB_IMAGE -DTINYGLTF_NO_STB_IMAGE_WRITE \
        -c "$source/tiny_gltf.cc" -o "$prefix/build/tinygltf/tiny_gltf.o"
    rm -f "$prefix/lib/libtinygltf.a" && "${AR:-ar}" rcsD "$prefix/lib/libtinygltf.a" "$prefix/build/tinygltf/tiny_gltf.o"
    built tinygltf
fi

if [ -n "$sysroot$windows" ]; then
    # Debian compiles these two with fused multiply-add for arm64, so their outputs would differ from x86-64.
    if fetch draco libdraco-dev; then
        with_cmake draco && cmake --install "$prefix/build/draco/build" >/dev/null
        built draco
    fi
    if fetch libwebp libwebp-dev; then
        # shellcheck disable=SC2046  # a list of options
        with_cmake libwebp $(printf -- '-DWEBP_BUILD_%s=OFF ' ANIM_UTILS CWEBP DWEBP GIF2WEBP IMG2WEBP VWEBP WEBPINFO WEBPMUX EXTRAS) &&
            cmake --install "$prefix/build/libwebp/build" >/dev/null
        built libwebp
    fi
fi

if [ -n "$windows" ]; then
    # Headers of libraries that need no compiling, without the other headers of this system.
    for name in CGAL boost catch2 CLI eigen3 nlohmann tiny_gltf.h OpenMesh; do ln -sfn "/usr/include/$name" "$prefix/include/$name"; done
    if fetch zlib zlib1g-dev; then
        # Its CMake files also build a DLL, whose resources Debian's archive lacks.
        # shellcheck disable=SC2086  # a list of options
        (cd "$source" && "$host-gcc-posix" -O2 "-ffile-prefix-map=$source=." $exact -c ./*.c && rm -f "$prefix/lib/libz.a" &&
            "$AR" rcsD "$prefix/lib/libz.a" ./*.o && cp zlib.h zconf.h "$prefix/include/")
        built zlib
    fi
    if fetch libpng1.6 libpng-dev; then
        with_cmake libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF && cmake --install "$prefix/build/libpng1.6/build" >/dev/null
        built libpng1.6
    fi
    if fetch libjpeg-turbo libjpeg62-turbo-dev; then
        with_cmake libjpeg-turbo "-DCMAKE_INSTALL_LIBDIR=$prefix/lib" -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF && cmake --install "$prefix/build/libjpeg-turbo/build" >/dev/null
        built libjpeg-turbo
    fi
    if fetch yaml-cpp libyaml-cpp-dev; then
        with_cmake yaml-cpp -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF -DYAML_BUILD_SHARED_LIBS=OFF &&
            cmake --install "$prefix/build/yaml-cpp/build" >/dev/null
        built yaml-cpp
    fi
    if fetch expat libexpat1-dev; then
        source=$source/expat
        # A patch of Debian needs a value of XML_DTD, which CMake defines without one.
        with_cmake expat -DEXPAT_DTD=OFF "-DCMAKE_C_FLAGS=-ffile-prefix-map=$source=. $exact -DXML_DTD=1" -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_TESTS=OFF -DEXPAT_BUILD_EXAMPLES=OFF &&
            cmake --install "$prefix/build/expat/build" >/dev/null
        built expat
    fi
    if fetch libzstd libzstd-dev; then
        source=$source/build/cmake
        with_cmake libzstd -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_SHARED=OFF -DZSTD_BUILD_TESTS=OFF &&
            cmake --install "$prefix/build/libzstd/build" >/dev/null
        built libzstd
    fi
    if fetch nettle nettle-dev; then
        sed -i 's/^SUBDIRS = .*/SUBDIRS =/' "$source/Makefile.in" # without its programs
        with_configure nettle --disable-public-key --disable-documentation --disable-openssl
    fi
    if fetch gmp libgmp-dev; then
        # Debian's archive lacks the manual, whose folder the build enters.
        mkdir -p "$source/doc"
        printf 'all install clean check:\n' >"$source/doc/Makefile.in"
        with_configure gmp --enable-cxx
    fi
    if fetch mpfr4 libmpfr-dev; then with_configure mpfr4 --with-gmp="$prefix" --disable-thread-safe; fi
fi

# The others, as installed; headers count, too, because templates are compiled into the program.
if [ -n "$windows" ]; then
    packages="mingw-w64-x86-64-dev g++-mingw-w64-x86-64-posix"
else
    compiler=$("${CXX:-g++}" -dumpversion | cut -d. -f1)
    packages="libdraco-dev libyaml-cpp-dev nettle-dev libpng-dev libjpeg-dev libjpeg62-turbo-dev libwebp-dev libzstd-dev
        libexpat1-dev libmpfr-dev libgmp-dev zlib1g-dev libseccomp-dev libc6-dev libstdc++-$compiler-dev"
fi
for package in $packages libtinygltf-dev libcgal-dev libcli11-dev libeigen3-dev nlohmann-json3-dev \
    "$(dpkg-query -S "$sysroot/usr/include/boost/version.hpp" | cut -d: -f1)"; do
    dpkg-query -W -f '${source:Package} ${source:Version}\n' "$package" 2>/dev/null || true
done >>"$prefix/sources.txt.new"
LC_ALL=C sort -u "$prefix/sources.txt.new" >"$prefix/sources.txt"
rm "$prefix/sources.txt.new"
