"""Results of a run."""

from __future__ import annotations

import json
import os
import tempfile
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._errors import OutputError, ResultsError
from ._text import path_text

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from .case import Case

    Table = npt.NDArray[np.void]


TABLES = ("sub_impacts", "transitions", "history", "sections", "points", "shapes", "envelope", "strikes")


def columns() -> str:
    """The columns of the tables of a result with their meanings, as `subimpact columns` prints."""
    return _core.columns()


class Result:
    """The results of a run.

    Tables are structured NumPy arrays with the columns of the CSV files of a run; each is made once,
    at its first use, and is read-only. `table["start_s"]` is a view of a column;
    `pandas.DataFrame(table)` is the table for pandas. An empty cell of the file is NaN in a column
    of real numbers and -1 in one of whole numbers.
    """

    def __init__(self, finished: _core.Finished) -> None:
        self._finished = finished

    @cached_property
    def sub_impacts(self) -> Table:
        """One row per sub-impact: events.csv."""
        return self._finished.table("sub_impacts")

    @cached_property
    def transitions(self) -> Table:
        """One row per located event: transitions.csv."""
        return self._finished.table("transitions")

    @cached_property
    def history(self) -> Table:
        """One row per output.interval, and two per event of the contact: history.csv."""
        return self._finished.table("history")

    @cached_property
    def sections(self) -> Table:
        """The sections of output.sections over time: sections.csv."""
        return self._finished.table("sections")

    @cached_property
    def points(self) -> Table:
        """The points of output.points over time: points.csv."""
        return self._finished.table("points")

    @cached_property
    def shapes(self) -> Table:
        """The whole beam at some instants: shapes.csv, with all digits."""
        return self._finished.table("shapes")

    @cached_property
    def envelope(self) -> Table:
        """Extremes along the beam: envelope.csv."""
        return self._finished.table("envelope")

    @cached_property
    def strikes(self) -> Table:
        """The strikes of a case with repeat.strikes, one after another: strikes.csv."""
        return self._finished.table("strikes")

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: settings given and used, counts, zones, conservation, work."""
        summary: dict[str, Any] = json.loads(self._finished.summary())
        return summary

    @property
    def answers(self) -> list[dict[str, Any]]:
        """The main numbers of the run, each with the errors of computation and body: `summary["answers"]`."""
        answers: list[dict[str, Any]] = self.summary["answers"]
        return answers

    @property
    def verdict(self) -> dict[str, Any]:
        """First words on the run, and their kinds: `summary["verdict"]`."""
        verdict: dict[str, Any] = self.summary["verdict"]
        return verdict

    @property
    def case(self) -> Case:
        """The case that was run, with every choice made: of mesh, method, theory ..."""
        from .case import Case

        return Case.from_text(self._finished.case_text())

    @property
    def outcome(self) -> str:
        """ "completed", "stopped", "inaccurate", "unstable", "chattering", "solver-failed" or
        "left-validity"."""
        return self._finished.outcome

    @property
    def message(self) -> str:
        """Of a run that did not complete: the cause and what to do."""
        return self._finished.message

    @property
    def time(self) -> float:
        """The time reached, s."""
        return self._finished.time

    @property
    def first_failure(self) -> tuple[float, float] | None:
        """The interval, s, in which results stop being right; None if they do not."""
        return self._finished.first_failure

    @property
    def usable(self) -> bool:
        """Whether the whole result passed every check."""
        return self._finished.usable

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the run."""
        return self._finished.interrupted

    @property
    def timed_out(self) -> bool:
        """Whether the time that the run was given ended it."""
        return self._finished.timed_out

    @property
    def warnings(self) -> list[str]:
        """Warnings about results that passed all checks."""
        return self._finished.warnings

    @property
    def n_certain(self) -> int | None:
        """How many sub-impacts are certain; None without error bars."""
        return self._finished.n_certain

    @property
    def all_certain(self) -> bool:
        """Whether it is certain that there are these sub-impacts and no others."""
        return self._finished.all_certain

    @property
    def n_predictable(self) -> int | None:
        """How many leading sub-impacts can be predicted in spite of the case's [scatter]; None
        without scatter. `summary["predictability"]` has the reason and the horizon."""
        return self._finished.n_predictable

    def __getitem__(self, key: str) -> Any:
        """The value of a key of the case that was run, with every choice made."""
        try:
            return self._finished.value(key)
        except KeyError:
            raise KeyError(f"{key} is no key of a case; tables are attributes, as in result.history[\"force_N\"]") from None

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes the files that `subimpact run` writes. Raises OutputError."""
        self._finished.write(path_text(directory, OutputError))

    def report(self) -> str:
        """The summary and the table of sub-impacts, as `subimpact run` prints them."""
        return self._finished.report()

    def to_pandas(self, table: str = "sub_impacts") -> Any:
        """A table as a pandas.DataFrame: "sub_impacts", "history", "sections" ..."""
        import pandas

        if table not in TABLES:
            raise ValueError(f"table is {table!r}; allowed: {', '.join(TABLES)}")
        return pandas.DataFrame(getattr(self, table))

    def __getstate__(self) -> dict[str, bytes]:
        with tempfile.TemporaryDirectory() as directory:
            self.write(directory)
            return {path.name: path.read_bytes() for path in Path(directory).iterdir() if path.is_file()}

    def __setstate__(self, files: dict[str, bytes]) -> None:
        with tempfile.TemporaryDirectory() as directory:
            for name, content in files.items():
                Path(directory, name).write_bytes(content)
            self._finished = _core.read_results(directory)

    def _repr_html_(self) -> str:
        """The summary and the sub-impacts as `subimpact run` prints them, for notebooks."""
        return f"<pre>{escape(self.report())}</pre>"

    def __repr__(self) -> str:
        return f"<Result {self._finished.brief()}>"

    def plot(self, axes: Any = None) -> Any:
        """Draws the contact force over time, sub-impacts shaded; returns the axes of Matplotlib. Other
        figures: `subimpact.plot`."""
        from .plot import force

        return force(self, axes)


def read_results(directory: str | os.PathLike[str]) -> Result:
    """A finished run, read back from its files. Raises ResultsError."""
    return Result(_core.read_results(path_text(directory, ResultsError)))
