"""Reports as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List

from ._decode import Record

if TYPE_CHECKING:
    import pandas


def _flat(value: Dict[str, Any], start: str = '') -> Dict[str, Any]:
    row: Dict[str, Any] = {}
    for key, item in value.items():
        if isinstance(item, dict):
            row.update(_flat(item, f'{start}{key}.'))
        else:
            row[start + key] = item
    return row


def to_pandas(record: Record) -> 'pandas.DataFrame':
    """A row per stage of a report or per asset of a batch, else one row. Nested values become columns: after.faces."""
    import pandas
    rows: List[Dict[str, Any]] = record.raw.get('stages') or record.raw.get('assets') or [record.raw]
    return pandas.DataFrame([_flat(row) for row in rows])
