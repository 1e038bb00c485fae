#!/bin/sh
# test.sh [DIST]: installs the packages of DIST (dist) as users do and runs them. It needs root for chroot.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
dist=$(cd "${1:-$here/../dist}" && pwd)
version=$(cat "$here/../VERSION")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say() { echo "== $*"; }
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
! chroot --userspec=65534:65534 "$root" /facetmill pipe -q generate cube ! write b.glb 2>"$work/error"
grep -q 'E-WRITE\|E-OUTPUT' "$work/error" || { cat "$work/error" && exit 1; }

say "wheel in a new environment"
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "$(ls "$dist"/facetmill-"$version"-py3-none-*x86_64.whl)" numpy pandas
(cd "$work" && "$work/venv/bin/facetmill" --version && "$work/venv/bin/python" -m unittest discover -q "$here/python/tests")

say "npm packages in a new project"
if command -v npm >/dev/null; then
    mkdir "$work/project" && cp "$here/npm/tests/test.mjs" "$work/project"
    (cd "$work/project" && npm init -y >/dev/null && npm install --silent "$dist/facetmill-$version.tgz" "$dist/facetmill-linux-x64-$version.tgz" &&
        node test.mjs)
else
    echo "npm is missing: not tested" >&2
fi

say "image"
python3 "$here/image/unpack.py" "$dist/facetmill-$version-image.tar" "$work/image"
cp "$root/a.glb" "$work/image/work/"
chroot --userspec=65534:65534 "$work/image" /usr/bin/facetmill info /work/a.glb >/dev/null
say "all passed"
