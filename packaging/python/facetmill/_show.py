"""The 3D view in notebooks."""

from __future__ import annotations

import html
import os
from typing import Any

from ._program import PathLike, call, error_of, temporary_folder


class _View:
    """A page that a notebook shows in a frame."""

    def __init__(self, page: str, height: int) -> None:
        self.page, self.height = page, height

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.page, quote=True)}" sandbox="allow-scripts" '
                f'style="width:100%;height:{self.height}px;border:0"></iframe>')


def show(path: PathLike, *, height: int = 640) -> Any:
    """Shows a mesh file in a notebook: its report with the 3D view, which can be turned."""
    with temporary_folder() as folder:
        page = folder / 'view.html'
        code, _, errors, others = call(['pipe', '--log', 'json', '--report', str(page), 'load', os.fspath(path), '!',
                                        'write', str(folder / 'view.glb')])
        if code != 0:
            raise error_of(errors, others, code)
        return _View(page.read_text('utf8'), height)
