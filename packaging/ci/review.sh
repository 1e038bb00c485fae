#!/bin/sh
# review.sh BASE [OUT]: compares the mesh files that changed between the commit BASE and the working tree.
#
# OUT (facetmill-review) gets summary.md, and for each changed file a page and a picture of both versions. Variables:
#   FACETMILL   the program                                     (facetmill)
#   PATTERNS    patterns of file names, separated by blanks     (*.glb *.gltf *.obj *.stl *.ply *.off *.3mf *.drc)
#   LIMITS      options of `facetmill diff`: '--max 0.5% --ignore counts'. Without limits, differences do not fail.
#   LINK        the address under which OUT will be found, for links and pictures. Known for GitLab and Jenkins.
#   SUMMARY     a file that the summary is appended to          ($GITHUB_STEP_SUMMARY where it is set)
# Exit code: 0 no file is beyond the limits, 1 some is, 2 the arguments are wrong, 3 and above: a file cannot be compared.
set -eu
[ $# -ge 1 ] || { echo "usage: review.sh BASE [OUT]" >&2; exit 2; }
base=$1 out=${2:-facetmill-review}
mill=${FACETMILL:-facetmill}
patterns=${PATTERNS:-*.glb *.gltf *.obj *.stl *.ply *.off *.3mf *.drc}
command -v "$mill" >/dev/null || { echo "there is no program $mill: install facetmill, or set FACETMILL" >&2; exit 2; }
git rev-parse -q --verify "$base^{commit}" >/dev/null || {
    echo "there is no commit $base: fetch it first (on GitHub: fetch-depth: 0)" >&2
    exit 2
}
link=${LINK:-}
[ -n "$link" ] || [ -z "${CI_JOB_URL:-}" ] || link=$CI_JOB_URL/artifacts/raw/$out
[ -n "$link" ] || [ -z "${BUILD_URL:-}" ] || link=${BUILD_URL%/}/artifact/$out

mkdir -p "$out"
before=$(mktemp -d)
trap 'git worktree remove --force "$before/tree" 2>/dev/null || true; rm -rf "$before"' EXIT
git worktree add -q --detach "$before/tree" "$(git merge-base "$base" HEAD)"

summary=$out/summary.md rows=$before/rows details=$before/details changed=$before/changed
: >"$rows" && : >"$details"
set -f
# shellcheck disable=SC2086  # a list of patterns
git -c core.quotePath=false diff --name-only --no-renames "$(git merge-base "$base" HEAD)" -- $patterns >"$changed"
set +f

address() { # address PATH: as a part of an address
    printf %s "$1" | sed 's/%/%25/g; s/ /%20/g; s/#/%23/g; s/?/%3F/g; s/(/%28/g; s/)/%29/g'
}
row() { # row OUTCOME FILE [NOTE]
    name=$(printf %s "$2" | sed 's/|/\\|/g')
    [ -z "$link" ] || [ ! -e "$out/$2.html" ] || name="[$name]($link/$(address "$2").html)"
    echo "| $1 | $name | ${3:-} |" >>"$rows"
}
picture() { # picture FILE MESH...
    target=$out/$1.png && shift
    "$mill" render -q "$@" -o "$target" --width 480 --height 360 --background white 2>>"$before/log" || rm -f "$target"
}

worst=0 count=0
while IFS= read -r file; do
    count=$((count + 1)) code=0
    mkdir -p "$(dirname "$out/$file")"
    if [ ! -e "$file" ]; then
        row removed "$file"
    elif [ ! -e "$before/tree/$file" ]; then
        "$mill" info "$file" >"$before/text" 2>&1 || code=$?
        if [ $code = 0 ]; then row added "$file"; else row "cannot be read" "$file" "$(head -1 "$before/text" | tr '|' ' ')"; fi
        picture "$file" "$file"
    else
        # shellcheck disable=SC2086  # a list of options
        "$mill" diff "$before/tree/$file" "$file" ${LIMITS:-} --html "$out/$file.html" --markdown "$before/part.md" \
            >"$before/text" 2>&1 || code=$?
        case $code in
        0) row "within the limits" "$file" ;;
        1) row differs "$file" "$(sed -n 's/^\*\*\(.*\)\*\*$/\1/p' "$before/part.md" | head -1)" ;;
        *) row "cannot be compared" "$file" "$(head -1 "$before/text" | sed "s|$before/tree/||g" | tr '|' ' ')" ;;
        esac
        picture "$file" "$before/tree/$file" "$file"
        if [ $code -le 1 ]; then
            printf '<details><summary>%s</summary>\n\n' "$file" >>"$details"
            [ -z "$link" ] || [ ! -e "$out/$file.png" ] || printf '![%s, before and after](%s.png)\n\n' "$file" "$link/$(address "$file")" >>"$details"
            sed "s|$before/tree/||g; s|^## .*||" "$before/part.md" >>"$details"
            printf '\n</details>\n\n' >>"$details"
        fi
        [ $code != 1 ] || [ -n "${LIMITS:-}" ] || code=0
    fi
    [ $code -le $worst ] || worst=$code
done <"$changed"

{
    echo "## Meshes that changed"
    echo
    if [ $count = 0 ]; then
        echo "No mesh file changed."
    else
        printf '| outcome | file | how |\n| --- | --- | --- |\n'
        cat "$rows"
        echo
        cat "$details"
    fi
} >"$summary"
appended=${SUMMARY:-${GITHUB_STEP_SUMMARY:-}}
[ -z "$appended" ] || cat "$summary" >>"$appended"
cat "$rows"
exit $worst
