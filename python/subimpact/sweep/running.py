"""A sweep from its plan to its tables."""

from __future__ import annotations

import math
import os
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from .._checks import check_progress, is_positive, is_whole, seconds
from .._errors import PlanError, StoreError
from .._text import path_text
from ..case import Case
from .engines import CallersExecutor, Coordinator, Processes, least_memory, n_cores
from .interruption import Interruption
from .plan import Axes, Plan
from .store import FILE, Store
from .tables import write_hdf5, write_tables
from .worker import Row, identity_of, run_case

_SECONDS_BETWEEN_COMMITS = 0.5
#: Outcomes that another attempt may change.
RETRIED = ("timed_out", "crashed", "out_of_memory")

Progress = Callable[[int, int], object]


@dataclass(repr=False, eq=False)
class Sweep:
    """The results of a sweep: the files in its directory."""

    plan: Plan
    directory: Path  #: of sweep.rows, runs.csv, sub_impacts.csv and base.toml, the case that the keys change
    outcomes: dict[str, int]  #: how many cases have each outcome
    notes: list[str]  #: messages for the user
    _temporary: tempfile.TemporaryDirectory[str] | None = None

    @property
    def n_missing(self) -> int:
        """Cases that have no row yet."""
        return len(self.plan) - sum(self.outcomes.values())

    @cached_property
    def runs(self) -> Any:
        """runs.csv as a DataFrame of pandas: one row per case."""
        return self._table("runs.csv")

    @cached_property
    def sub_impacts(self) -> Any:
        """sub_impacts.csv as a DataFrame of pandas: one row per sub-impact of each case."""
        return self._table("sub_impacts.csv")

    def write_hdf5(self) -> Path:
        """Writes both tables into sweep.h5, which needs h5py; returns its path. Raises StoreError if
        the tables were changed since, and OutputError."""
        return write_hdf5(self.directory)

    def _table(self, name: str) -> Any:
        import pandas

        return pandas.read_csv(self.directory / name, float_precision="round_trip")

    def __repr__(self) -> str:
        missing = f", {self.n_missing} missing" if self.n_missing else ""
        return f"<Sweep of {len(self.plan)} cases in {self.directory}{missing}>"


@dataclass
class _Sink:
    """Collects rows and stores them twice per second."""

    plan: Plan
    store: Store
    identities: dict[int, str]
    n_done: int
    n_all: int
    progress: Progress | None
    rows: list[Row] = field(default_factory=list)
    last: float = field(default_factory=time.monotonic)

    def __call__(self, rows: dict[int, Row]) -> None:
        self.identities.update((number, row.identity) for number, row in rows.items())
        self.rows += [row._replace(place=self.plan.place(number)) for number, row in rows.items()]
        self.n_done += len(rows)
        if time.monotonic() - self.last >= _SECONDS_BETWEEN_COMMITS:
            self.flush()

    def flush(self) -> None:
        if self.rows:
            self.store.add(self.rows)
            self.rows = []
        self.last = time.monotonic()
        if self.progress is not None:
            self.progress(self.n_done, self.n_all)


def _merge(store: Store, directory: str | os.PathLike[str]) -> None:
    path = Path(path_text(directory, StoreError))
    if path.resolve() == store.directory.resolve():
        raise StoreError(f"{path}: is the directory to merge into; name those of other sweeps")
    if not os.path.lexists(path / FILE):
        raise StoreError(f"{path}: is no directory of a sweep; allowed: one with {FILE}")
    with Store(path) as other:
        store.add(other.rows())
        store.notes += other.notes


#: GiB, and processes.
_MOST_MEMORY = 1e6
_MOST_WORKERS = 10_000


def _check(workers: Any, memory: Any, only: Any) -> None:
    if workers is not None and not is_whole(workers, 0, _MOST_WORKERS):
        raise PlanError(f"workers is {workers!r}; allowed: a whole number from 0 to {_MOST_WORKERS}")
    if memory is not None:
        least = math.ceil(100 * least_memory()) / 100
        if not is_positive(memory, _MOST_MEMORY) or memory < least:
            raise PlanError(
                f"memory is {memory!r}; allowed: {least:g} GiB (what each process takes before its first "
                f"case, and 0.25) to {_MOST_MEMORY:g}; leave it out for no limit"
            )
    if only is not None:
        is_pair = isinstance(only, (tuple, list)) and len(only) == 2
        if not is_pair or not all(is_whole(number, 0, 2**63) for number in only) or only[0] >= only[1]:
            raise PlanError(
                f"only is {only!r}; allowed: the first number of a part of the cases, from 0, and the "
                "number after its last, such as (0, 1000)"
            )


def sweep(
    case: Case | Plan,
    axes: Axes | None = None,
    *,
    out: str | os.PathLike[str] | None = None,
    scatter: Mapping[str, float] | None = None,
    samples: int | None = None,
    seed: int = 1,
    error_bars: str | None = None,
    timeout: float | str | None = None,
    distribution: str = "normal",
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

    case, axes, scatter, samples, seed, error_bars, timeout, distribution
                what is run: see `Plan`. A Plan may stand in place of the case
    out         the directory of the store (sweep.rows) and its tables runs.csv and sub_impacts.csv. What it has is not run
                again, whatever stopped the sweep or changed the plan. Left out: a temporary directory, which goes with the Sweep
    workers     processes on this machine; by default one per core; 0: none, all runs in this one
    memory      GiB of address space that a worker process may have
    executor    what runs the cases instead: a client of Dask, an MPIPoolExecutor of mpi4py, another of `concurrent.futures`
    only        (first, end): a part of the cases, by their numbers from 0
    retry       runs cases again that were timed out, crashed or ran out of memory
    merge       directories of other sweeps, whose rows are taken first
    progress    called with the number of cases that have a row, and of all

    The tables are the same, byte for byte, whatever ran the cases. After Ctrl-C, SIGTERM and SIGHUP (in the main thread, unless
    the process has handlers of its own) they have the rows so far, and KeyboardInterrupt is raised; its `signal` is the number.
    """
    _check(workers, memory, only)
    check_progress(progress)
    if isinstance(case, Plan):
        plan = case
    else:
        limit = seconds(timeout, PlanError)
        plan = Plan(case, {} if axes is None else axes, scatter, samples, seed, error_bars, limit, distribution)
        if not plan.keys():
            raise PlanError('nothing differs from case to case; give axes, such as {"striker.mass": [0.1, 0.2]}')
    numbers = range(len(plan))[slice(*only)] if only else range(len(plan))
    temporary = None
    if out is None:
        temporary = tempfile.TemporaryDirectory(prefix="subimpact-sweep-")
        out = temporary.name
    with Interruption() as interruption, Store(out) as store:
        for directory in merge:
            _merge(store, directory)
        if retry:
            store.drop(RETRIED)
        identities: dict[int, str] = {}
        missing = list(numbers)
        # Without rows to go on from, the identities come with the rows: each takes time to find.
        if store.outcomes or len({repr(plan.settings(number)) for number in range(len(plan))}) < len(plan):
            identities = {number: store.identities.get(plan.place(number)) or identity_of(plan, number) for number in range(len(plan))}
            first: dict[str, int] = {}  # of the cases of one identity
            for number in numbers:
                first.setdefault(identities[number], number)
            missing = [number for identity, number in first.items() if identity not in store.outcomes]
        sink = _Sink(plan, store, identities, len(numbers) - len(missing), len(numbers), progress)
        try:
            if workers == 0 and executor is None:
                for number in missing:
                    sink({number: run_case(plan, number)})
            elif missing:
                n = min(workers or n_cores(), len(missing))
                engine: Processes | CallersExecutor = Processes(n, memory) if executor is None else CallersExecutor(executor)
                Coordinator(engine, plan, sink).run(missing)
        finally:
            interruption.hold()
            sink.flush()
            outcomes = write_tables(plan, identities, store)
        return Sweep(plan, store.directory, dict(outcomes), store.notes, temporary)
