"""sbom.py EXECUTABLE OUT.spdx.json: the bill of materials of a static executable, in SPDX 2.3, from what it says of itself."""

import hashlib
import json
import pathlib
import subprocess
import sys

LICENCES = {
    'boost1.74': 'BSL-1.0', 'boost1.83': 'BSL-1.0', 'cgal': 'GPL-3.0-or-later AND LGPL-3.0-or-later', 'cli11': 'BSD-3-Clause',
    'draco': 'Apache-2.0', 'eigen3': 'MPL-2.0', 'expat': 'MIT', 'fmtlib': 'MIT', 'glibc': 'LGPL-2.1-or-later',
    'gmp': 'LGPL-3.0-or-later OR GPL-2.0-or-later', 'libjpeg-turbo': 'IJG AND BSD-3-Clause AND Zlib', 'libpng1.6': 'libpng-2.0',
    'libseccomp': 'LGPL-2.1-only', 'libwebp': 'BSD-3-Clause', 'libzstd': 'BSD-3-Clause OR GPL-2.0-only', 'meshoptimizer': 'MIT',
    'mpfr4': 'LGPL-3.0-or-later', 'nettle': 'LGPL-3.0-or-later OR GPL-2.0-or-later', 'nlohmann-json3': 'MIT', 'onetbb': 'Apache-2.0',
    'openmesh': 'BSD-3-Clause', 'tinygltf': 'MIT', 'yaml-cpp': 'MIT', 'zlib': 'Zlib'}


def main():
    executable, out, *before = sys.argv[1:]
    about = json.loads(subprocess.run([*before, executable, '--version', '--json'], check=True, capture_output=True).stdout)
    digest = hashlib.sha256(pathlib.Path(executable).read_bytes()).hexdigest()
    packages = [{'SPDXID': 'SPDXRef-facetmill', 'name': 'facetmill', 'versionInfo': about['version'],
                 'downloadLocation': 'NOASSERTION', 'filesAnalyzed': False, 'licenseConcluded': 'GPL-3.0-or-later',
                 'licenseDeclared': 'GPL-3.0-or-later', 'copyrightText': 'NOASSERTION',
                 'checksums': [{'algorithm': 'SHA256', 'checksumValue': digest}]}]
    unknown = [name for name in about['sources'] if name not in LICENCES and not name.startswith('gcc-')]
    if unknown:
        sys.exit(f'sbom.py knows no licence of {", ".join(unknown)}: add it to LICENCES')
    for name, url in about['sources'].items():
        version = url.rstrip('/').rsplit('/', 1)[1]
        licence = LICENCES.get(name, 'GPL-3.0-or-later WITH GCC-exception-3.1')
        packages.append({
            'SPDXID': 'SPDXRef-' + name.replace('_', '-'), 'name': name, 'versionInfo': version, 'downloadLocation': url,
            'filesAnalyzed': False, 'licenseConcluded': licence, 'licenseDeclared': licence, 'copyrightText': 'NOASSERTION',
            'externalRefs': [{'referenceCategory': 'PACKAGE-MANAGER', 'referenceType': 'purl',
                              'referenceLocator': f'pkg:deb/debian/{name}@{version.replace("+", "%2B").replace(":", "%3A")}?arch=source'}]})
    document = {
        'spdxVersion': 'SPDX-2.3', 'dataLicense': 'CC0-1.0', 'SPDXID': 'SPDXRef-DOCUMENT', 'name': f'facetmill-{about["version"]}',
        'documentNamespace': f'https://facetmill.invalid/spdx/{digest}',
        # A fixed time, so that the same executable gives the same bytes.
        'creationInfo': {'created': '1980-01-01T00:00:00Z', 'creators': ['Tool: facetmill-sbom']},
        'packages': packages,
        'relationships': [{'spdxElementId': 'SPDXRef-DOCUMENT', 'relationshipType': 'DESCRIBES', 'relatedSpdxElement': 'SPDXRef-facetmill'}]
        + [{'spdxElementId': 'SPDXRef-facetmill', 'relationshipType': 'STATIC_LINK', 'relatedSpdxElement': p['SPDXID']} for p in packages[1:]]}
    pathlib.Path(out).write_text(json.dumps(document, indent=1) + '\n')


main()
