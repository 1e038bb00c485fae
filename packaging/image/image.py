"""image.py OUT.tar EXECUTABLE ARCH [EXECUTABLE ARCH]: an OCI image (archive of an image layout) from scratch.

It holds the static program and its licence, runs as nobody with the working folder /work, and needs no writable root.
ARCH is amd64 or arm64; each gets its manifest. The same inputs give the same bytes.
"""

import gzip
import hashlib
import io
import json
import pathlib
import sys
import tarfile

TOP = pathlib.Path(__file__).resolve().parent.parent.parent


def tar(files):
    """A tar of {path: (bytes or None for a folder, mode)} without times, owners or names of users."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode='w', format=tarfile.GNU_FORMAT) as archive:
        for path, (content, mode) in files.items():
            entry = tarfile.TarInfo(path)
            entry.mode, entry.type = mode, tarfile.DIRTYPE if content is None else tarfile.REGTYPE
            entry.size = len(content or b'')
            archive.addfile(entry, io.BytesIO(content or b''))
    return data.getvalue()


class Layout:
    def __init__(self):
        self.blobs = {}

    def blob(self, kind, content):
        digest = hashlib.sha256(content).hexdigest()
        self.blobs[f'blobs/sha256/{digest}'] = (content, 0o644)
        return {'mediaType': kind, 'digest': f'sha256:{digest}', 'size': len(content)}

    def json(self, kind, value):
        return self.blob(kind, json.dumps(value, separators=(',', ':')).encode())


def main():
    out, *programs = sys.argv[1:]
    version = (TOP / 'VERSION').read_text().strip()
    layout, manifests, oci = Layout(), [], 'application/vnd.oci.image.'
    for program, architecture in zip(programs[::2], programs[1::2]):
        layer = tar({'usr': (None, 0o755), 'usr/bin': (None, 0o755),
                     'usr/bin/facetmill': (pathlib.Path(program).read_bytes(), 0o755),
                     'usr/share': (None, 0o755), 'usr/share/doc': (None, 0o755), 'usr/share/doc/facetmill': (None, 0o755),
                     'usr/share/doc/facetmill/LICENSE': ((TOP / 'LICENSE').read_bytes(), 0o644),
                     'tmp': (None, 0o1777), 'work': (None, 0o777)})
        config = layout.json(oci + 'config.v1+json', {
            'architecture': architecture, 'os': 'linux',
            'config': {'User': '65534:65534', 'Entrypoint': ['/usr/bin/facetmill'], 'Cmd': ['--help'], 'WorkingDir': '/work',
                       'Env': ['PATH=/usr/bin'],
                       'Labels': {'org.opencontainers.image.title': 'facetmill', 'org.opencontainers.image.version': version,
                                  'org.opencontainers.image.licenses': 'GPL-3.0-or-later'}},
            'rootfs': {'type': 'layers', 'diff_ids': ['sha256:' + hashlib.sha256(layer).hexdigest()]},
            'history': [{'created_by': 'facetmill ' + version}]})
        blob = layout.blob(oci + 'layer.v1.tar+gzip', gzip.compress(layer, 9, mtime=0))
        manifest = layout.json(oci + 'manifest.v1+json', {'schemaVersion': 2, 'mediaType': oci + 'manifest.v1+json',
                                                          'config': config, 'layers': [blob]})
        manifests.append({**manifest, 'platform': {'architecture': architecture, 'os': 'linux'}})
    index = {'schemaVersion': 2, 'mediaType': oci + 'index.v1+json', 'manifests': manifests}
    if len(manifests) == 1:
        manifests[0]['annotations'] = {'org.opencontainers.image.ref.name': version}
    else:
        index['manifests'] = [{**layout.json(oci + 'index.v1+json', index),
                               'annotations': {'org.opencontainers.image.ref.name': version}}]
    files = {'oci-layout': (b'{"imageLayoutVersion":"1.0.0"}', 0o644), 'blobs': (None, 0o755), 'blobs/sha256': (None, 0o755),
             'index.json': (json.dumps(index, separators=(',', ':')).encode(), 0o644), **dict(sorted(layout.blobs.items()))}
    pathlib.Path(out).write_bytes(tar(files))
    print(out)


main()
