"""Reports as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Union

from .reports import Batch, Report

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


def to_pandas(report: Union[Report, Batch]) -> 'pandas.DataFrame':
    """A row per stage of a report, or per asset of a batch. Nested values become columns such as after.faces."""
    import pandas
    rows: List[Dict[str, Any]] = report.raw['assets' if isinstance(report, Batch) else 'stages']
    return pandas.DataFrame([_flat(row) for row in rows])
