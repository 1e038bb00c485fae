#!/bin/sh
# check_version.sh: VERSION is the newest version of the changelog and that of the recipes, and a tag of this commit, if
# there is one, names it.
# Between releases, the changelog begins with "Unreleased".
set -eu
cd "$(dirname "$0")/.."
version=$(cat VERSION)
changes=$(sed -n 's/^## //p' CHANGELOG.md | head -1)
tagged=$(git tag --points-at HEAD 2>/dev/null | grep '^v[0-9]' || true)
if [ "$changes" != "$version" ] && { [ "$changes" != Unreleased ] || [ -n "$tagged" ]; }; then
    echo "VERSION says $version, and CHANGELOG.md begins with $changes" >&2
    exit 1
fi
for file in packaging/ci/action.yml packaging/recipes/PKGBUILD packaging/recipes/facetmill.nix packaging/recipes/facetmill.rb \
    packaging/recipes/meta.yaml packaging/recipes/facetmill.scoop.json packaging/recipes/facetmill.winget.yaml; do
    grep -qF "$version" "$file" || { echo "VERSION says $version, and $file has another" >&2 && exit 1; }
done
for tag in $tagged; do
    case $tag in
    "v$version") ;;
    v[0-9]*) echo "VERSION says $version, and the tag of this commit is $tag" >&2 && exit 1 ;;
    esac
done
