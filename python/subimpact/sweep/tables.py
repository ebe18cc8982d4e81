"""The tables of a sweep, in the order of its plan."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from typing import IO

from .. import _core
from .._errors import OutputError, ResultsError, StoreError
from .._files import Files
from .._tables import arrays_of
from .._text import one_line
from .plan import Plan
from .store import KIND, SECONDS_OF_THE_DYING, Store
from .worker import COLUMNS, cell

RUNS = "runs.csv"
SUB_IMPACTS = "sub_impacts.csv"
CASE = "base.toml"
HDF5 = "sweep.h5"


def write_tables(plan: Plan, identities: Mapping[int, str], store: Store) -> Counter[str]:
    """Writes runs.csv and sub_impacts.csv, both as one, from the rows there are, which have the
    identities of the plan's cases, and base.toml, the case that its keys change; returns how many
    rows have each outcome, and notes why the first of each other than "completed" has it. Raises OutputError."""
    try:
        with _new(store.output, RUNS) as runs, _new(store.output, SUB_IMPACTS) as sub_impacts:
            outcomes = _write_rows(plan, identities, store, runs, sub_impacts)
        with _new(store.output, CASE) as base:
            base.write(plan.base.to_toml())
    except OSError as error:
        raise _not_written(store.directory, error) from None
    store.output.commit()
    return outcomes


def _new(output: _core.OutputDirectory, name: str) -> IO[str]:
    return open(Path(output.staging, name), "x", encoding="utf-8", newline="\n")


def _not_written(directory: Path, error: Exception) -> OutputError:
    cause = getattr(error, "strerror", None) or error
    return OutputError(
        f"{directory}: the tables cannot be written ({cause}); make room, and start the sweep again: its "
        "rows are stored"
    )


def _write_rows(
    plan: Plan, identities: Mapping[int, str], store: Store, runs: IO[str], sub_impacts: IO[str]
) -> Counter[str]:
    keys = plan.keys()
    outcomes: Counter[str] = Counter()
    reasons: dict[str, str] = {}
    runs.write(",".join(["run", *keys, *COLUMNS, "message"]) + "\n")
    sub_impacts.write(",".join(["run", *_core.event_columns()]) + "\n")
    numbers = sorted(identities)
    rows = store.rows_of([identities[number] for number in numbers])
    for number, row in zip(numbers, rows):
        if row is None:
            continue
        outcome = cell(row.outcome)
        outcomes[outcome] += 1
        if outcome != "completed" and outcome not in reasons:
            reasons[outcome] = f"run {number}: {next(csv.reader([row.cells]))[-1]}"
        values = dict(plan.settings(number))
        cells = [str(number), *(cell(values[key]) for key in keys), outcome, one_line(row.cells)]
        runs.write(",".join(cells) + "\n")
        if row.sub_impacts:
            lines = row.sub_impacts.removesuffix("\n").replace("\n", f"\n{number},")
            sub_impacts.write(f"{number},{lines}\n")
    store.notes += [f"{outcomes[outcome]} of {len(numbers)} cases {outcome}, the first of them {reason}" for outcome, reason in reasons.items()]
    return outcomes


def write_hdf5(directory: Path) -> Path:
    """Writes sweep.h5 beside the two tables: a group each, with one data set per column. Empty cells
    of numbers are NaN. Needs h5py. Raises StoreError if the tables are not as the sweep wrote them, and
    OutputError."""
    import h5py

    identity = _tables(directory)[0]
    with closing(_core.OutputDirectory(str(directory), KIND, SECONDS_OF_THE_DYING, identity)) as output:
        now, tables = _tables(directory)
        if now != identity:
            raise StoreError(f"{directory}: another sweep has written its tables here meanwhile; write those")
        try:
            with h5py.File(Path(output.staging) / HDF5, "x") as file:
                for name, (heading, *rows) in tables.items():
                    group = file.create_group(name.removesuffix(".csv"))
                    for label, column in arrays_of({each: [row[k] for row in rows] for k, each in enumerate(heading)}).items():
                        is_text = column.dtype.kind == "U"
                        group.create_dataset(label, data=column.tolist(), dtype=h5py.string_dtype() if is_text else float)
        except (OSError, RuntimeError) as error:
            raise _not_written(directory, error) from None
        output.commit()
    return directory / HDF5


def _tables(directory: Path) -> tuple[str, dict[str, list[list[str]]]]:
    """The identity of a sweep, and the rows of its tables as it wrote them. Raises StoreError."""
    try:
        files = Files(directory)
        if RUNS not in files.listed:
            raise ResultsError(f"{directory}: has no list of the tables of a sweep; {files.again}")
        return files.identity, {name: list(files.lines(name)) for name in (RUNS, SUB_IMPACTS)}
    except ResultsError as error:
        raise StoreError(str(error)) from None
