#!/bin/sh
# run.sh: runs facetmill with the arguments $ARGUMENTS into the folder $OUTPUT, and appends its summary to
# $GITHUB_STEP_SUMMARY. Pictures and links of a batch begin with the address $LINK; without it, there are none.
set -u
shown=
case $ARGUMENTS in
batch*) [ -z "$LINK" ] || shown="--pictures pictures --link-base '$LINK'" ;;
esac
code=0
eval "facetmill $ARGUMENTS --output-dir '$OUTPUT' --cache --report summary.md $shown" || code=$?
[ ! -e "$OUTPUT/summary.md" ] || cat "$OUTPUT/summary.md" >>"$GITHUB_STEP_SUMMARY"
exit $code
