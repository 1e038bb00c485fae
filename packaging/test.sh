#!/bin/sh
# test.sh [DIST]: installs the packages of DIST (dist) as users do and runs them. It needs root for chroot.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
dist=$(cd "${1:-$here/../dist}" && pwd)
version=$(cat "$here/../VERSION")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say() { echo "== $*"; }
refuses() { # refuses WORD COMMAND...: the command fails with WORD among its messages
    word=$1 && shift
    if "$@" 2>"$work/error" || ! grep -q "$word" "$work/error"; then
        cat "$work/error" >&2
        echo "expected to fail with $word: $*" >&2
        exit 1
    fi
}
(cd "$dist" && sha256sum --quiet -c SHA256SUMS)

say "static executable in an empty root"
program=$dist/facetmill-$version-linux-x86_64
[ "$(stat -c %s "$program")" -le 25000000 ] || { echo "the executable is larger than 25 MB" >&2 && exit 1; }
root=$work/root && mkdir -p "$root"
cp "$program" "$root/facetmill"
chroot "$root" /facetmill --version
chroot "$root" /facetmill pipe -q generate torus ! split midpoint ! write a.glb ! write a.draco.glb --draco
"$program" diff "$root/a.glb" "$root/a.draco.glb" --max 0.1% --ignore counts,attributes,document >/dev/null
chmod a-w "$root"
chroot --userspec=65534:65534 "$root" /facetmill info /a.glb >/dev/null
refuses E-WRITE chroot --userspec=65534:65534 "$root" /facetmill pipe -q generate cube ! write b.glb

say "150 + 140 bytes of folders, no HOME, a cache without a folder"
deep=$(printf 'a%.0s' $(seq 150))/$(printf 'b%.0s' $(seq 140))
mkdir -p "$root/$deep" && cp "$root/a.glb" "$root/$deep/"
env -i "$(command -v chroot)" "$root" /facetmill pipe -q --report "/$deep/r.html" load "/$deep/a.glb" ! write "/$deep/b.glb"
refuses 'set FACETMILL_CACHE' env -i "$(command -v chroot)" "$root" /facetmill pipe -q --cache generate cube ! measure

name=$(printf 'n%.0s' $(seq 300))
refuses 'each name in it may have 255 bytes' chroot "$root" /facetmill pipe -q generate cube ! write "$name.glb"

if unshare --mount true 2>/dev/null; then
    say "read-only file system"
    read_only() { # read_only ARGUMENT...: runs the program in a root that nobody can write to
        unshare --mount sh -c 'root=$1 && shift && mount --bind "$root" "$root" && mount -o remount,bind,ro "$root" && chroot "$root" "$@"' \
            sh "$root" /facetmill "$@"
    }
    read_only info /a.glb >/dev/null
    refuses 'E-WRITE.*Read-only file system' read_only pipe -q generate cube ! write b.glb
    refuses 'write elsewhere' read_only run quickstart -q -D input=/a.glb --output-dir out
fi

emulator=$(command -v qemu-aarch64-static || true)
foreign=$dist/facetmill-$version-linux-aarch64
if [ -e "$foreign" ] && [ -n "$emulator" ]; then
    say "arm64 in an empty root, emulated"
    [ "$(stat -c %s "$foreign")" -le 25000000 ] || { echo "the executable is larger than 25 MB" >&2 && exit 1; }
    mkdir "$work/arm64" && cp "$foreign" "$work/arm64/facetmill" && cp "$emulator" "$work/arm64/qemu"
    chroot "$work/arm64" /qemu /facetmill --version
    chroot "$work/arm64" /qemu /facetmill pipe -q generate torus ! split midpoint ! write a.glb ! write a.draco.glb --draco 2>/dev/null
    for file in a.glb a.draco.glb; do cmp "$work/arm64/$file" "$root/$file"; done
fi

if command -v strace >/dev/null; then
    say "no lookup of a library at start; a kernel without the calls that came after 4.18"
    strace -f -o "$work/trace" "$program" --version >/dev/null
    if grep '[.]so' "$work/trace"; then exit 1; fi
    late=landlock_create_ruleset,landlock_add_rule,landlock_restrict_self,openat2,faccessat2,clone3,close_range,pidfd_open,rseq
    strace -f -o /dev/null -e "inject=$late:error=ENOSYS" "$program" pipe -q generate torus ! split midpoint ! write "$work/old.glb" 2>/dev/null
    cmp "$work/old.glb" "$root/a.glb"
fi

say "wheel in a new environment"
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "$(ls "$dist"/facetmill-"$version"-py3-none-*x86_64.whl)" numpy pandas
(cd "$work" && "$work/venv/bin/facetmill" --version && "$work/venv/bin/python" -m unittest discover -q "$here/python/tests")

say "npm packages in a new project"
if command -v npm >/dev/null; then
    mkdir "$work/project" && cp "$here/npm/tests/test.mjs" "$work/project"
    (cd "$work/project" && npm init -y >/dev/null && npm install --silent "$dist/facetmill-$version.tgz" "$dist/facetmill-linux-x64-$version.tgz" &&
        node test.mjs)
    cp "$here/npm/tests/vite.mjs" "$root/a.glb" "$work/project"
    if (cd "$work/project" && npm install --silent vite 2>/dev/null); then
        (cd "$work/project" && node vite.mjs)
    else
        echo "Vite cannot be installed: its plugin is not tested" >&2
    fi
else
    echo "npm is missing: not tested" >&2
fi

say "image"
python3 "$here/image/unpack.py" "$dist/facetmill-$version-image.tar" "$work/image"
cp "$root/a.glb" "$work/image/work/"
chroot --userspec=65534:65534 "$work/image" /usr/bin/facetmill info /work/a.glb >/dev/null
say "all passed"
