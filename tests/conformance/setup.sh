#!/bin/sh
# setup.sh DIRECTORY
# Installs the Khronos glTF validator (npm package gltf-validator) and axe-core, which looks for what keeps people from
# reading a page, into DIRECTORY, a folder of the build tree. Does nothing when they are there. The tests that need them
# say so when they are missing.
set -eu
[ $# = 1 ] || { echo "usage: setup.sh DIRECTORY" >&2; exit 2; }
[ -d "$1/node_modules/gltf-validator" ] && [ -d "$1/node_modules/axe-core" ] && exit 0
command -v npm >/dev/null || { echo "setup.sh: npm is missing: apt-get install nodejs npm" >&2; exit 1; }
mkdir -p "$1"
cd "$1"
for pause in 5 20 60 0; do # a registry may be out of reach for a while
    npm install --no-save --no-audit --no-fund --loglevel=error gltf-validator@2.0.0-dev.3.10 axe-core@4.10.3 && exit 0
    [ "${FACETMILL_REQUIRE_VALIDATOR:-}" = 1 ] || exit 1
    sleep $pause
done
exit 1
