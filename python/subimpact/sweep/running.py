"""A sweep from its plan to its tables."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from numbers import Real
from pathlib import Path
from typing import Any

from .._errors import PlanError, StoreError
from ..case import Case
from .engines import CallersExecutor, Coordinator, Processes, n_cores, run_here
from .plan import Axes, Plan
from .store import Store
from .tables import write_hdf5, write_tables
from .worker import Row, identity_of

_SECONDS_BETWEEN_COMMITS = 0.5
#: Outcomes that another attempt may change.
RETRIED = ("timed_out", "crashed", "out_of_memory")

Progress = Callable[[int, int], object]


class Sweep:
    """The results of a sweep: the files in its directory."""

    def __init__(self, plan: Plan, directory: Path, n_missing: int, notes: list[str]) -> None:
        self.plan = plan
        self.directory = directory  #: of sweep.sqlite, runs.csv and sub_impacts.csv
        self.n_missing = n_missing  #: cases of the plan that have no row yet
        self.notes = notes  #: what the user has to be told

    @cached_property
    def runs(self) -> Any:
        """runs.csv as a DataFrame of pandas: one row per case."""
        return self._table("runs.csv")

    @cached_property
    def sub_impacts(self) -> Any:
        """sub_impacts.csv as a DataFrame of pandas: one row per sub-impact of each case."""
        return self._table("sub_impacts.csv")

    def write_hdf5(self) -> Path:
        """Writes both tables into sweep.h5, which needs h5py; returns its path."""
        return write_hdf5(self.directory)

    def _table(self, name: str) -> Any:
        import pandas

        return pandas.read_csv(self.directory / name)

    def __repr__(self) -> str:
        missing = f", {self.n_missing} missing" if self.n_missing else ""
        return f"<Sweep of {len(self.plan)} cases in {self.directory}{missing}>"


class _Sink:
    """Collects rows and stores them twice per second."""

    def __init__(self, store: Store, n_done: int, n_all: int, progress: Progress | None) -> None:
        self._store = store
        self._rows: list[Row] = []
        self._last = time.monotonic()
        self._n_done = n_done
        self._n_all = n_all
        self._progress = progress

    def __call__(self, rows: list[Row]) -> None:
        self._rows += rows
        self._n_done += len(rows)
        if time.monotonic() - self._last >= _SECONDS_BETWEEN_COMMITS:
            self.flush()

    def flush(self) -> None:
        if self._rows:
            self._store.add(self._rows)
            self._rows = []
        self._last = time.monotonic()
        if self._progress is not None:
            self._progress(self._n_done, self._n_all)


def _missing(numbers: Iterable[int], identities: list[str], known: Mapping[str, str]) -> list[int]:
    """The cases without a row; of cases of one identity the first."""
    seen = set(known)
    missing = []
    for number in numbers:
        if identities[number] not in seen:
            seen.add(identities[number])
            missing.append(number)
    return missing


def _merge(store: Store, directory: str | os.PathLike[str]) -> None:
    if Path(directory).resolve() == store.directory.resolve():
        raise StoreError(f"{os.fspath(directory)}: is the directory to merge into")
    if not Path(directory).is_dir():
        raise StoreError(f"{os.fspath(directory)}: is no directory of a sweep")
    with Store(directory) as other:
        store.add(list(other.rows()))
        store.notes += other.notes


def _hand_out(
    plan: Plan,
    missing: list[int],
    sink: _Sink,
    workers: int | None,
    memory: float | None,
    executor: Any,
) -> None:
    if not missing:
        return
    if executor is not None:
        Coordinator(CallersExecutor(executor), plan, sink).run(missing)
    elif workers == 0:
        run_here(plan, missing, sink)
    else:
        n = min(workers or n_cores(), len(missing))
        Coordinator(Processes(n, memory), plan, sink).run(missing)


def sweep(
    case: Case | Plan,
    axes: Axes | None = None,
    *,
    out: str | os.PathLike[str],
    scatter: Mapping[str, float] | None = None,
    samples: int | None = None,
    seed: int = 1,
    error_bars: str | None = None,
    timeout: float | None = None,
    workers: int | None = None,
    memory: float | None = None,
    executor: Any = None,
    only: tuple[int, int] | None = None,
    retry: bool = False,
    merge: Iterable[str | os.PathLike[str]] = (),
    progress: Progress | None = None,
) -> Sweep:
    """Runs a population of cases; each run keeps to one core.

        sweep(case, {"striker.velocity": np.linspace(2, 16, 50)}, out="by-velocity")

    case, axes, scatter, samples, seed, error_bars, timeout
                what is run: see `Plan`. A Plan may stand in place of the case
    out         the directory of the results: the store (sweep.sqlite) and its tables runs.csv and
                sub_impacts.csv. A sweep that was stopped, by whatever, goes on from there; cases of
                an earlier plan that the new one has too are not run again
    workers     processes on this machine; by default one per core; 0: none, all runs in this one
    memory      GiB that a worker process may have
    executor    what runs the cases instead: a client of Dask, an MPIPoolExecutor of mpi4py, or
                another executor with the interface of `concurrent.futures`
    only        (first, end): a part of the cases, by their numbers from 0
    retry       runs cases again that were timed out, crashed or ran out of memory
    merge       directories of other sweeps, whose rows are taken first
    progress    called with the number of cases that have a row, and of all

    The tables are the same, byte for byte, whatever ran the cases. After Ctrl-C the rows so far are
    stored and in the tables, and KeyboardInterrupt is raised.
    """
    if isinstance(case, Plan):
        plan = case
    else:
        plan = Plan(case, axes or {}, scatter, samples, seed, error_bars, timeout)
    for name, value in (("workers", workers), ("memory", memory)):
        if value is not None and not (isinstance(value, Real) and value >= 0):
            raise PlanError(f"{name} is {value!r}; allowed: 0 or more")
    numbers = range(len(plan))[slice(*only)] if only else range(len(plan))
    identities = [identity_of(plan, number) for number in range(len(plan))]
    with Store(out) as store:
        for directory in merge:
            _merge(store, directory)
        if retry:
            store.drop(RETRIED)
        missing = _missing(numbers, identities, store.outcomes())
        sink = _Sink(store, len(numbers) - len(missing), len(numbers), progress)
        try:
            _hand_out(plan, missing, sink, workers, memory, executor)
        finally:
            sink.flush()
            n_missing = write_tables(plan, identities, store)
        return Sweep(plan, Path(out), n_missing, store.notes)
