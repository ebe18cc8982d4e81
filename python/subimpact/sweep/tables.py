"""The tables of a sweep, in the order of its plan."""

from __future__ import annotations

import os
import zlib
from pathlib import Path
from typing import IO

from .plan import Plan
from .store import Store
from .worker import COLUMNS, cell, events_heading

RUNS = "runs.csv"
SUB_IMPACTS = "sub_impacts.csv"


class _Replacement:
    """A file that appears whole, in place of the one before."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._temporary = path.with_name(f".{path.name}.new")

    def __enter__(self) -> IO[str]:
        self._file = open(self._temporary, "w", encoding="utf-8", newline="\n")
        return self._file

    def __exit__(self, kind: object, *_: object) -> None:
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()
        if kind is None:
            os.replace(self._temporary, self._path)
        else:
            os.unlink(self._temporary)


def write_tables(plan: Plan, identities: list[str], store: Store) -> int:
    """Writes runs.csv and sub_impacts.csv from the rows there are, which have the identities of the
    plan's cases; returns how many cases have none."""
    n_missing = 0
    keys = plan.keys()
    with _Replacement(store.directory / RUNS) as runs, _Replacement(
        store.directory / SUB_IMPACTS
    ) as sub_impacts:
        runs.write(",".join(["run", *keys, *COLUMNS, "message"]) + "\n")
        sub_impacts.write("run," + events_heading() + "\n")
        for number, identity in enumerate(identities):
            row = store.get(identity)
            if row is None:
                n_missing += 1
                continue
            values = dict(plan.settings(number))
            cells = [str(number), *(cell(values[key]) for key in keys), row.outcome, row.cells]
            runs.write(",".join(cells) + "\n")
            for line in zlib.decompress(row.sub_impacts).decode().splitlines(keepends=True):
                sub_impacts.write(f"{number},{line}")
    return n_missing


def write_hdf5(directory: Path) -> Path:
    """Writes sweep.h5 from the two tables: a group each, with one data set per column. Empty cells
    of numbers are NaN. Needs h5py."""
    import h5py

    path = directory / "sweep.h5"
    temporary = path.with_name(".sweep.h5.new")
    with h5py.File(temporary, "w") as file:
        for name in (RUNS, SUB_IMPACTS):
            group = file.create_group(name.removesuffix(".csv"))
            with open(directory / name, encoding="utf-8") as table:
                heading = next(table).rstrip("\n").split(",")
                rows = [line.rstrip("\n").split(",") for line in table]
            for column, label in enumerate(heading):
                cells = [row[column] for row in rows]
                try:
                    group[label] = [float(text or "nan") for text in cells]
                except ValueError:
                    group.create_dataset(label, data=cells, dtype=h5py.string_dtype())
    os.replace(temporary, path)
    return path
