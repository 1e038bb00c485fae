#!/bin/sh
# publish.sh FOLDER BRANCH NAME: puts the files of FOLDER into the folder NAME of the orphan branch BRANCH. Hidden files
# stay out.
set -eu
folder=$(cd "$1" && pwd) branch=$2 name=$3
tree=$(mktemp -d)
trap 'git worktree remove --force "$tree/tree" 2>/dev/null || true; rm -rf "$tree"' EXIT
if git fetch -q --depth 1 origin "$branch" 2>/dev/null; then
    git worktree add -q --detach "$tree/tree" FETCH_HEAD
else
    git worktree add -q --detach "$tree/tree"
    git -C "$tree/tree" checkout -q --orphan "facetmill-publish-$name"
    git -C "$tree/tree" rm -rqf .
fi
mkdir -p "$tree/tree/$name"
(cd "$folder" && find . -type f ! -path '*/.*' -exec cp --parents {} "$tree/tree/$name" \;)
cd "$tree/tree"
git add -A
git -c user.name=facetmill -c user.email=facetmill@localhost commit -qm "review: Add the pictures of run $name" || exit 0
git push -q origin "HEAD:refs/heads/$branch"
