"""Tables of CSV files and of studies: columns as arrays."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._errors import ResultsError


def table_of(text: str, name: str) -> dict[str, Any]:
    """The columns of a CSV text with a heading: arrays of numbers, NaN in empty cells, or of texts. Raises ResultsError."""
    try:
        heading, *rows = csv.reader(text.splitlines(), strict=True)
    except (ValueError, csv.Error) as error:
        raise ResultsError(f"{name}: cannot be read ({error})") from None
    if any(len(row) != len(heading) for row in rows) or not rows:
        raise ResultsError(f"{name}: is no table with rows of {len(heading)} cells")
    return arrays_of(dict(zip(heading, zip(*rows))))


def read_table(file: str | os.PathLike[str]) -> dict[str, Any]:
    """The same of a file. Raises ResultsError."""
    try:
        return table_of(Path(file).read_text(encoding="utf-8"), os.fspath(file))
    except (OSError, ValueError) as error:
        raise ResultsError(f"{os.fspath(file)}: cannot be read ({error})") from None


def arrays_of(columns: Mapping[str, Sequence[str]]) -> dict[str, Any]:
    """Columns of cells as arrays of numbers, NaN in empty cells, or of texts."""
    return {name: _numbers(np.array(cells, dtype=str)) for name, cells in columns.items()}


def _numbers(cells: Any) -> Any:
    try:
        return np.where(cells == "", "nan", cells).astype(float)
    except ValueError:
        return cells
