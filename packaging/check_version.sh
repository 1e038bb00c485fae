#!/bin/sh
# check_version.sh: VERSION is the newest version of the changelog, and a tag of this commit, if there is one, names it.
set -eu
cd "$(dirname "$0")/.."
version=$(cat VERSION)
changes=$(sed -n 's/^## \([0-9][0-9.]*\).*/\1/p' CHANGELOG.md | head -1)
if [ "$changes" != "$version" ]; then
    echo "VERSION says $version, and CHANGELOG.md begins with $changes" >&2
    exit 1
fi
for tag in $(git tag --points-at HEAD 2>/dev/null || true); do
    case $tag in
    "v$version") ;;
    v[0-9]*) echo "VERSION says $version, and the tag of this commit is $tag" >&2 && exit 1 ;;
    esac
done
