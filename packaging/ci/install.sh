#!/bin/sh
# install.sh FOLDER: downloads the program of the release VERSION from RELEASES, checks it, and puts it into FOLDER.
set -eu
folder=${1:?usage: VERSION=0.4.0 RELEASES=https://... install.sh FOLDER}
case $(uname -s)-$(uname -m) in
Linux-x86_64 | Linux-aarch64) name=facetmill-$VERSION-linux-$(uname -m) ;;
*) echo "facetmill $VERSION has no program for $(uname -s) on $(uname -m): Linux on x86_64 and aarch64 are served" >&2 && exit 1 ;;
esac
mkdir -p "$folder"
for file in "$name" SHA256SUMS; do
    curl -fsSL --retry 3 -o "$folder/$file" "$RELEASES/v$VERSION/$file"
done
(cd "$folder" && grep " $name\$" SHA256SUMS | sha256sum -c - >/dev/null) || { echo "the download of $name is damaged" >&2 && exit 1; }
mv "$folder/$name" "$folder/facetmill"
chmod +x "$folder/facetmill"
"$folder/facetmill" --version
