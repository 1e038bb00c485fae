#!/bin/sh
# sysroot.sh ARCHITECTURE FOLDER: unpacks the libraries of another architecture (arm64), from this Debian's packages, into
# FOLDER, for packaging/linux/toolchain.cmake. The packages of the machine stay unchanged. FOLDER has a package database
# of its own, with the versions and the paths of the unpacked files: dpkg-query --admindir=FOLDER/var/lib/dpkg.
set -eu
architecture=${1:?usage: sysroot.sh ARCHITECTURE FOLDER} folder=${2:?usage: sysroot.sh ARCHITECTURE FOLDER}
top=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
apt=$folder/var/apt admin=$folder/var/lib/dpkg
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/preferences.d" "$admin/info" "$admin/updates"
key=[signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]
cat >"$apt/sources.list" <<LIST
deb $key http://deb.debian.org/debian $suite main
deb $key http://deb.debian.org/debian $suite-updates main
deb $key http://deb.debian.org/debian-security $suite-security main
LIST
# An empty list of installed packages, so that apt downloads all that the libraries need.
: >"$apt/status"
cat >"$apt/apt.conf" <<CONF
APT::Architecture "$architecture";
APT::Architectures { "$architecture"; };
Dir::Etc::sourcelist "$apt/sources.list";
Dir::Etc::sourceparts "-";
Dir::Etc::preferencesparts "$apt/preferences.d";
Dir::State "$apt";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
APT::Sandbox::User "root";
CONF
export APT_CONFIG="$apt/apt.conf"
apt-get update -qq
standard=libstdc++-$("${CXX:-g++}" -dumpversion | cut -d. -f1)-dev
# shellcheck disable=SC2046  # a list of names
apt-get install -qq --download-only --no-install-recommends $("$top/tools/deps.sh" --libraries) libc6-dev "$standard" >/dev/null

for package in "$apt"/cache/archives/*.deb; do
    name=$(dpkg-deb -f "$package" Package) version=$(dpkg-deb -f "$package" Version)
    [ "$(cat "$admin/info/$name.version" 2>/dev/null)" != "$version" ] || continue
    echo "unpacking $name $version" >&2
    dpkg-deb -x "$package" "$folder"
    dpkg-deb -c "$package" | sed -n "s#.* \.\(/[^ ]*[^/]\)\( -> .*\)\?\$#$folder\1#p" >"$admin/info/$name.list"
    control=$(mktemp -d)
    dpkg-deb -e "$package" "$control"
    for file in shlibs symbols; do
        if [ -e "$control/$file" ]; then cp "$control/$file" "$admin/info/$name.$file"; fi
    done
    sed 's/^Package: .*/&\nStatus: install ok installed/' "$control/control" >"$admin/info/$name.status"
    rm -r "$control"
    echo "$version" >"$admin/info/$name.version"
done
for status in "$admin"/info/*.status; do cat "$status" && echo; done >"$admin/status"
# Draco's CMake files name libraries by absolute paths.
find "$folder/usr" -name '*-targets*.cmake' -exec sed -i "s#\"/usr/#\"$folder/usr/#g" {} +
# Links to absolute paths would lead to the machine's own libraries.
find "$folder/usr" "$folder/lib" -type l -lname '/*' 2>/dev/null | while read -r link; do
    ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$folder$(readlink "$link")")" "$link"
done
