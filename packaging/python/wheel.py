"""wheel.py EXECUTABLE ARCHITECTURE OUT: makes the wheel for Linux on x86_64 or aarch64, or for windows (64-bit), with the
same bytes each time.

The executable is static, so one wheel serves glibc and musl alike. It has no build backend: a wheel is a zip file.
"""

import base64
import hashlib
import pathlib
import platform
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
TAGS = 'py3-none-manylinux_2_17_{0}.manylinux2014_{0}.musllinux_1_1_{0}'
WINDOWS_TAG = 'py3-none-win_amd64'
METADATA = '''Metadata-Version: 2.1
Name: facetmill
Version: {version}
Summary: Declarative mesh pipelines that end in checked glTF
License: GPL-3.0-or-later
Keywords: mesh,gltf,glb,stl,obj,ply,3mf,draco,simplify,repair
Classifier: Environment :: Console
Classifier: License :: OSI Approved :: GNU General Public License v3 or later (GPLv3+)
Classifier: Operating System :: {system}
Classifier: Programming Language :: Python :: 3
Classifier: Topic :: Multimedia :: Graphics :: 3D Modeling
Classifier: Typing :: Typed
Requires-Python: >=3.8
Provides-Extra: mesh
Requires-Dist: numpy; extra == "mesh"
Provides-Extra: pandas
Requires-Dist: pandas; extra == "pandas"
Description-Content-Type: text/markdown

'''


def main() -> None:
    executable, architecture, out = sys.argv[1:]
    version = (TOP / 'VERSION').read_text().split()[0]
    info = f'facetmill-{version}.dist-info'
    windows = architecture == 'windows'
    tags = WINDOWS_TAG if windows else TAGS.format(architecture)
    files = {f'facetmill/{p.name}': p.read_bytes() for p in (HERE / 'facetmill').iterdir() if p.suffix in ('.py', '.typed')}
    with tempfile.TemporaryDirectory() as folder:
        reports = pathlib.Path(folder, 'reports.py')
        foreign = ['wine'] if windows else [] if architecture == platform.machine() else [f'qemu-{architecture}-static']
        subprocess.run([sys.executable, str(HERE / 'dataclasses_from_schema.py'), str(reports), *foreign, executable],
                       check=True)
        files['facetmill/reports.py'] = reports.read_bytes()
    files[f'facetmill-{version}.data/scripts/facetmill{".exe" if windows else ""}'] = pathlib.Path(executable).read_bytes()
    files[f'{info}/METADATA'] = (METADATA.format(version=version, system='Microsoft :: Windows' if windows else 'POSIX :: Linux') + (HERE / 'README.md').read_text()).encode()
    files[f'{info}/WHEEL'] = ('Wheel-Version: 1.0\nGenerator: facetmill\nRoot-Is-Purelib: false\n'
                              + ''.join(f'Tag: py3-none-{tag}\n' for tag in tags.split('-')[2].split('.'))).encode()
    files[f'{info}/licenses/LICENSE'] = (TOP / 'LICENSE').read_bytes()
    record = f'{info}/RECORD'
    rows = []
    for name in sorted(files):
        digest = base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest()).rstrip(b'=').decode()
        rows.append(f'{name},sha256={digest},{len(files[name])}\n')
    files[record] = (''.join(rows) + f'{record},,\n').encode()
    wheel = pathlib.Path(out, f'facetmill-{version}-{tags}.whl')
    with zipfile.ZipFile(wheel, 'w', zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in [*sorted(set(files) - {record}), record]:
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if '/scripts/' in name else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[name])
    print(wheel)


main()
