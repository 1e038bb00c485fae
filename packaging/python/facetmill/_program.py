"""Runs the executable, and turns its reports and errors into objects."""

from __future__ import annotations

import contextlib
import errno
import importlib.metadata
import json
import os
import platform
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

from . import reports
from ._stages import StageDescription

# Of an ELF file's header: e_machine.
_MACHINES = {b'\x3e\x00': 'x86_64', b'\xb7\x00': 'aarch64'}

PathLike = Union[str, 'os.PathLike[str]']
Pipeline = Union[PathLike, Mapping[str, Any]]


@dataclass(frozen=True)
class Progress:
    """A stage that begins (`done` is False) or has ended. In a batch: an asset that has ended."""

    name: str
    number: int
    of: int
    done: bool
    faces: Optional[int]


OnProgress = Callable[[Progress], None]


class Error(Exception):
    """A run that did not pass.

    `id` is the id of the message (E-FILE), `place` is FILE:LINE:COLUMN or empty, `hint` says what to do, and `exit_code`
    is the program's. `report` is the report of the run where one was made, so that failed checks can be read.
    """

    def __init__(self, message: str, *, id: str = '', place: str = '', hint: str = '', exit_code: int = 0,
                 report: Optional[reports.Report] = None) -> None:
        super().__init__(message)
        self.message, self.id, self.place, self.hint = message, id, place, hint
        self.exit_code, self.report = exit_code, report

    def __str__(self) -> str:
        start = f'{self.place}: ' if self.place else ''
        kind = f'{self.id}: ' if self.id else ''
        return f'{start}{kind}{self.message}' + (f' (hint: {self.hint})' if self.hint else '')


def executable() -> str:
    """The path of the program: $FACETMILL, else the one of this package, else the one on PATH."""
    given = os.environ.get('FACETMILL')
    if given:
        return given
    try:
        for file in importlib.metadata.files('facetmill') or []:
            if file.name in ('facetmill', 'facetmill.exe') and file.parent.name in ('bin', 'Scripts'):
                found = Path(str(file.locate())).resolve()
                if found.exists():
                    return str(found)
    except importlib.metadata.PackageNotFoundError:
        pass
    on_path = shutil.which('facetmill')
    if on_path is None:
        raise FileNotFoundError(f'there is no program facetmill for {platform.system()} on {platform.machine()}: '
                                'pip install facetmill, or set FACETMILL to a program that you have built')
    return on_path


def start(arguments: Sequence[str], **options: Any) -> 'subprocess.Popen[Any]':
    """Starts the program. An error of the system becomes a sentence that says what to do."""
    program = executable()
    try:
        return subprocess.Popen([program, *arguments], **options)
    except OSError as error:
        why = _why_not_started(program, error)
        if why is None:
            raise
        raise type(error)(error.errno, why, program) from None


def _why_not_started(program: str, error: OSError) -> Optional[str]:
    """What keeps the program from starting; None if the system says it well enough."""
    if error.errno == errno.ENOEXEC:
        with open(program, 'rb') as file:
            made_for = _MACHINES.get(file.read(20)[18:20], 'another system')
        return (f'this is the file for {made_for}, and this machine is {platform.machine()}: '
                'pip install --force-reinstall facetmill takes the right one')
    if error.errno == errno.EACCES:
        return 'the program may not be executed: chmod +x it, or install it in a file system that is not mounted noexec'
    return None


@contextlib.contextmanager
def _says_where_temporary_files_go() -> Iterator[None]:
    try:
        yield
    except FileNotFoundError as error:
        raise Error('there is no folder for temporary files', id='E-WRITE', exit_code=4,
                    hint='set TMPDIR to a folder that can be written') from error


@contextlib.contextmanager
def temporary_folder() -> Iterator[Path]:
    """A folder for a report."""
    with _says_where_temporary_files_go():
        folder = tempfile.TemporaryDirectory(prefix='facetmill-')
    with folder as name:
        yield Path(name)


def _temporary_text() -> IO[str]:
    with _says_where_temporary_files_go():
        return tempfile.TemporaryFile('w+', encoding='utf8')


def events(lines: Iterable[str], on_progress: Optional[OnProgress] = None) -> Tuple[List[Dict[str, Any]], str]:
    """The errors among the program's messages, and whatever else it printed."""
    errors: List[Dict[str, Any]] = []
    others: List[str] = []
    number = of = 0
    for line in lines:
        try:
            event = json.loads(line)
        except ValueError:
            others.append(line)
            continue
        if event.get('level') == 'error':
            errors.append(event)
        kind = event.get('event')
        if kind in ('begin', 'asset'):
            number, of = event.get('number', 0), event.get('of', 0)
        if not on_progress:
            continue
        if kind == 'begin':
            on_progress(Progress(event['name'], number, of, False, None))
        elif kind == 'stage' and 'asset' not in event:
            on_progress(Progress(event['name'], number, of, True, event.get('faces_after')))
        elif kind == 'asset':
            on_progress(Progress(event['asset'], number, of, True, None))
    return errors, ''.join(others)


def error_of(errors: List[Dict[str, Any]], others: str, code: int, report: Optional[reports.Report] = None) -> Error:
    if not errors:
        return Error(others.strip() or f'facetmill ended with exit code {code}', exit_code=code, report=report)
    first = errors[0]
    place = ':'.join(str(first[key]) for key in ('file', 'line', 'column') if key in first)
    return Error(first.get('message', ''), id=first.get('id', ''), place=place, hint=first.get('hint', ''),
                 exit_code=code, report=report)


def call(arguments: Sequence[str], *, text: Optional[str] = None, on_progress: Optional[OnProgress] = None,
         cwd: Optional[PathLike] = None) -> Tuple[int, str, List[Dict[str, Any]], str]:
    """Runs the program: exit code, standard output, errors, and messages that are not JSON."""
    with _temporary_text() as output, _temporary_text() as given:
        if text is not None:
            given.write(text)
            given.seek(0)
        process = start(arguments, stdout=output, stderr=subprocess.PIPE, text=True, encoding='utf8',
                        stdin=given if text is not None else subprocess.DEVNULL, cwd=cwd)
        try:
            errors, others = events(process.stderr or (), on_progress)
            code = process.wait()
        except BaseException:
            process.terminate()
            process.wait()
            raise
        finally:
            if process.stderr:
                process.stderr.close()
        output.seek(0)
        return code, output.read(), errors, others


def _value(value: Any) -> str:
    return json.dumps(value) if isinstance(value, (bool, dict, list)) else str(value)


def _run(arguments: List[str], check: bool, on_progress: Optional[OnProgress], text: Optional[str],
         cwd: Optional[PathLike]) -> reports.Report:
    with temporary_folder() as folder:
        path = folder / 'report.json'
        verbose = ['-v'] if on_progress else []
        code, _, errors, others = call([arguments[0], '--log', 'json', *verbose, '--report', str(path), *arguments[1:]],
                                       text=text, on_progress=on_progress, cwd=cwd)
        report = reports.Report.from_json(json.loads(path.read_text('utf8'))) if path.exists() else None
    if report is None or (check and code != 0):
        raise error_of(errors, others, code, report)
    return report


def run(pipeline: Pipeline, *, check: bool = True, output_dir: Optional[PathLike] = None, options: Sequence[str] = (),
        on_progress: Optional[OnProgress] = None, cwd: Optional[PathLike] = None, **params: Any) -> reports.Report:
    """Runs a pipeline: a YAML file, the name of a built-in pipeline, or a dict with the keys of such a file.

    params are those of the pipeline (`input='scan.ply'`). `options` are further options of `facetmill run`. Raises
    Error if the run does not pass; with check=False a run whose checks fail returns its report.
    """
    arguments = ['run', *options]
    if output_dir is not None:
        arguments += ['--output-dir', os.fspath(output_dir)]
    for name, value in params.items():
        arguments += ['-D', f'{name}={_value(value)}']
    if isinstance(pipeline, Mapping):  # JSON is YAML
        return _run([*arguments, '-'], check, on_progress, json.dumps(dict(pipeline)), cwd)
    return _run([*arguments, os.fspath(pipeline)], check, on_progress, None, cwd)


def pipe(stages: Union[str, Sequence[str]], *, check: bool = True, options: Sequence[str] = (),
         on_progress: Optional[OnProgress] = None, cwd: Optional[PathLike] = None) -> reports.Report:
    """Runs stages written in one line, as after `facetmill pipe`: pipe('load a.stl ! clean ! write a.glb').

    A list is taken word by word, which is the way to pass paths with blanks.
    """
    import shlex
    words = shlex.split(stages) if isinstance(stages, str) else [os.fspath(word) for word in stages]
    return _run(['pipe', *options, *words], check, on_progress, None, cwd)


def _json(arguments: Sequence[str], allowed: Sequence[int] = (0,)) -> Any:
    code, output, errors, others = call(arguments)
    if code not in allowed:
        raise error_of(errors, others, code)
    return json.loads(output)


def info(path: PathLike, *, options: Sequence[str] = ()) -> reports.Info:
    """The properties of a mesh file."""
    return reports.Info.from_json(_json(['info', '--json', '--log', 'json', *options, os.fspath(path)]))


def diff(a: PathLike, b: PathLike, *, options: Sequence[str] = ()) -> reports.Diff:
    """Compares two mesh files. `same` says whether they agree."""
    return reports.Diff.from_json(_json(['diff', '--json', '--log', 'json', *options, os.fspath(a), os.fspath(b)], (0, 1)))


def batch(pipeline: PathLike, inputs: Union[PathLike, Sequence[PathLike]], *, output_dir: PathLike, check: bool = True,
          options: Sequence[str] = (), on_progress: Optional[OnProgress] = None, **params: Any) -> reports.Batch:
    """Runs a pipeline for each input: paths, or patterns ('scans/**/*.ply').

    Progress counts finished assets. With check=False, a batch with failed assets returns its summary.
    """
    arguments = ['batch', '--log', 'json', *options, '--output-dir', os.fspath(output_dir)]
    for path in [inputs] if isinstance(inputs, (str, os.PathLike)) else inputs:
        arguments += ['--input', os.fspath(path)]
    for name, value in params.items():
        arguments += ['-D', f'{name}={_value(value)}']
    with temporary_folder() as folder:
        path = folder / 'batch.json'
        code, _, errors, others = call([*arguments, '--report', str(path), os.fspath(pipeline)], on_progress=on_progress)
        summary = reports.Batch.from_json(json.loads(path.read_text('utf8'))) if path.exists() else None
    if summary is None or (check and code != 0):
        raise error_of(errors, others, code)
    return summary


def stages() -> List[StageDescription]:
    """All stages with their options, as `facetmill stages --json` describes them."""
    return [StageDescription.from_json(stage) for stage in _json(['stages', '--json'])]


def version() -> str:
    """The version of the program."""
    return str(_json(['--version', '--json'])['version'])
