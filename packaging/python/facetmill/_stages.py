"""What stages there are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List, Optional

from ._decode import Record


@dataclass(frozen=True)
class OptionDescription(Record):
    """An option of a stage. `default` is text, as in a pipeline."""

    name: str
    type: str
    help: str
    default: Optional[str] = None
    choices: Optional[Dict[str, str]] = None
    primary: bool = False
    required: bool = False
    repeatable: bool = False


@dataclass(frozen=True)
class FieldDescription(Record):
    """A value that a stage reports."""

    name: str
    type: str
    help: str


@dataclass(frozen=True)
class StageDescription(Record):
    """A stage. `rules` say which options need or exclude each other."""

    name: str
    about: str
    details: str
    options: List[OptionDescription]
    examples: List[str]
    result: List[FieldDescription]
    rules: List[str]
