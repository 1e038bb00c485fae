#!/bin/sh
# deps.sh [--list] [--all] [--bench] [--site] [--browser] [--fuzz] [--deb] [--imports] [--arm64] [--windows]
# Names the Debian packages that facetmill is built and tested with, and installs those that are missing (Debian 12
# and 13). --list only prints what is missing, one per line. --all adds what the optional checks of CI use: more
# shells and Meson, a second Draco reader, node for the glTF validator and axe-core, and clang for the style; --bench adds
# what the benchmarks use, --site what the manual is made with, --browser the browser that tests open pages in, --fuzz what
# libFuzzer needs, --deb what a Debian package is made with, --imports what the import helpers (FBX, STEP ...) need,
# --arm64 and --windows a cross compiler and an emulator.
# --libraries prints the packages of all libraries, for packaging/linux/sysroot.sh.
set -eu

tools="g++ cmake ninja-build mold pkg-config"
libraries="libcgal-dev libtinygltf-dev nlohmann-json3-dev libdraco-dev libmeshoptimizer-dev libyaml-cpp-dev
    libcli11-dev libfmt-dev libgmp-dev libtbb-dev libeigen3-dev libopenmesh-dev nettle-dev zlib1g-dev libzstd-dev libexpat1-dev
    libseccomp-dev libpng-dev libjpeg-dev libwebp-dev"
# Optional: AVIF images. Static executables go without.
avif="libavif-dev"
test="catch2 python3 python3-jsonschema"
bench="libbenchmark-dev"
fuzz="clang libclang-rt-dev"
deb="dpkg-dev file"
imports="libassimp-dev libocct-data-exchange-dev"
windows="g++-mingw-w64-x86-64-posix binutils-mingw-w64-x86-64 m4 make wine64 wine"
arm64="g++-aarch64-linux-gnu qemu-user-static"
site="mkdocs mkdocs-material python3-yaml"
browser="chromium"
optional="ccache python3-yaml zsh fish draco nodejs npm mandoc meson clang clang-format clang-tidy"

list=no wanted="$tools $libraries $avif $test"
for argument in "$@"; do
    case $argument in
    --list) list=yes ;;
    --libraries) echo "$libraries" && exit ;;
    --all) wanted="$wanted $optional" ;;
    --bench) wanted="$wanted $bench" ;;
    --site) wanted="$wanted $site" ;;
    --browser) wanted="$wanted $browser" ;;
    --fuzz) wanted="$wanted $fuzz" ;;
    --deb) wanted="$wanted $deb" ;;
    --imports) wanted="$wanted $imports" ;;
    --arm64) wanted="$wanted $arm64" ;;
    --windows) wanted="$wanted $windows" ;;
    *) echo "usage: deps.sh [--list] [--all] [--bench] [--site] [--browser] [--fuzz] [--deb] [--imports] [--arm64] [--windows]" >&2; exit 2 ;;
    esac
done

missing=
for package in $wanted; do
    # Node from elsewhere serves as well, and does not live beside Debian's.
    case $package in nodejs | npm) if command -v npm >/dev/null && command -v node >/dev/null; then continue; fi ;; esac
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
done

if [ $list = yes ]; then
    for package in $missing; do echo "$package"; done
    exit 0
fi
[ -n "$missing" ] || exit 0
echo "Installing from Debian:$missing" >&2

sudo=
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { echo "Run as root: apt-get install --no-install-recommends$missing" >&2; exit 1; }
    sudo=sudo
fi
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get update -qq
# shellcheck disable=SC2086  # a list of names
$sudo apt-get install -y -qq --no-install-recommends $missing >&2
