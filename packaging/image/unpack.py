"""unpack.py IMAGE.tar FOLDER: checks the digests of an OCI image and unpacks its layers, for tests without a container engine."""

import gzip
import hashlib
import io
import json
import sys
import tarfile


def main():
    image, folder = sys.argv[1:]
    with tarfile.open(image) as archive:
        files = {m.name: archive.extractfile(m).read() for m in archive.getmembers() if m.isfile()}

    def blob(descriptor):
        content = files['blobs/' + descriptor['digest'].replace(':', '/')]
        assert len(content) == descriptor['size'] and 'sha256:' + hashlib.sha256(content).hexdigest() == descriptor['digest']
        return content

    index = json.loads(files['index.json'])
    while 'manifests' in index:
        index = json.loads(blob(index['manifests'][0]))
    config = json.loads(blob(index['config']))
    for layer, digest in zip(index['layers'], config['rootfs']['diff_ids']):
        content = gzip.decompress(blob(layer))
        assert 'sha256:' + hashlib.sha256(content).hexdigest() == digest
        with tarfile.open(fileobj=io.BytesIO(content)) as archive:
            archive.extractall(folder)


main()
