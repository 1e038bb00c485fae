"""From JSON to the dataclasses of the reports."""

from __future__ import annotations

import dataclasses
import functools
import keyword
import sys
import typing
from typing import Any, Dict, Type, TypeVar

if typing.TYPE_CHECKING:
    import pandas

T = TypeVar('T', bound='Record')


class Record:
    """What facetmill reports. `raw` is the JSON that it was made from."""

    @property
    def raw(self) -> Dict[str, Any]:
        return typing.cast(Dict[str, Any], self.__dict__['_raw'])

    def to_pandas(self) -> 'pandas.DataFrame':
        """The same as facetmill.to_pandas(self)."""
        from ._frames import to_pandas
        return to_pandas(self)

    @classmethod
    def from_json(cls: Type[T], value: Dict[str, Any]) -> T:
        """Makes the record from its JSON. Fields of later versions are only in `raw`."""
        hints = _hints(typing.cast(type, cls))
        given = {}
        for name in hints:
            key = name[:-1] if name.endswith('_') and keyword.iskeyword(name[:-1]) else name
            if key in value:
                given[name] = _decode(value[key], hints[name])
        if 'stage' in given and isinstance(given.get('result'), dict):
            kind = getattr(sys.modules[cls.__module__], 'RESULTS', {}).get(given['stage'])
            if kind is not None and set(_needed(kind)) <= set(given['result']):
                given['result'] = kind.from_json(given['result'])
        record = cls(**given)
        record.__dict__['_raw'] = value
        return record


@functools.lru_cache(maxsize=None)
def _hints(kind: type) -> Dict[str, Any]:
    return typing.get_type_hints(kind)


@functools.lru_cache(maxsize=None)
def _needed(kind: Any) -> Any:
    return tuple(f.name for f in dataclasses.fields(kind) if f.default is dataclasses.MISSING)


def _decode(value: Any, kind: Any) -> Any:
    arguments = typing.get_args(kind)
    if isinstance(value, list) and arguments and typing.get_origin(kind) is list:
        return [_decode(item, arguments[0]) for item in value]
    if isinstance(value, dict) and isinstance(kind, type) and issubclass(kind, Record):
        return kind.from_json(value)
    if typing.get_origin(kind) is typing.Union:
        for choice in arguments:
            is_record = isinstance(choice, type) and issubclass(choice, Record)
            if (isinstance(value, dict) and is_record) or (isinstance(value, list) and typing.get_origin(choice) is list):
                return _decode(value, choice)
    return value
