"""Results of a run."""

from __future__ import annotations

import json
import math
import os
import tempfile
from functools import cached_property
from html import escape
from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import _core
from ._errors import OutputError
from ._stored import Stored
from ._text import path_text

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Numbers = npt.NDArray[np.float64]
    Table = npt.NDArray[np.void]


TABLES = ("sub_impacts", "transitions", "supports", "history", "sections", "points", "shapes", "envelope", "strikes")


def columns() -> str:
    """The columns of the tables of a result with their meanings, as `subimpact columns` prints."""
    return _core.columns()


def _table(name: str, meaning: str) -> cached_property[Table]:
    def table(result: Result) -> Table:
        return result._run.table(name)

    table.__doc__ = meaning
    return cached_property(table)


class Result:
    """The results of a run.

    Tables are structured NumPy arrays with the columns of the CSV files of a run, made at their first use and read-only:
    `table["start_s"]` is a view of a column, `pandas.DataFrame(table)` the table for pandas. An empty cell of the file is NaN
    in a column of real numbers and -1 in one of whole numbers.
    """

    def __init__(self, run: _core.Finished | Stored) -> None:
        self._run = run

    sub_impacts = _table("sub_impacts", "One row per sub-impact: events.csv.")
    transitions = _table("transitions", "One row per located event: transitions.csv.")
    supports = _table("supports", "One row per contact with a support that the beam can lift off: supports.csv.")
    history = _table("history", "One row per output.interval, and two per event of the contact: history.csv.")
    sections = _table("sections", "The sections of output.sections over time: sections.csv.")
    points = _table("points", "The points of output.points over time: points.csv.")
    shapes = _table("shapes", "The whole beam at some instants: shapes.csv, after a run with all digits.")
    envelope = _table("envelope", "Extremes along the beam: envelope.csv.")
    strikes = _table("strikes", "The strikes of a case with repeat.strikes, one after another: strikes.csv.")

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: settings given and used, counts, zones, conservation, work."""
        return json.loads(self._run.summary())

    @cached_property
    def report_data(self) -> dict[str, Any]:
        """report.json: what screen and page show, rounded as errors allow."""
        return json.loads(self._run.report_json())

    @property
    def answers(self) -> list[dict[str, Any]]:
        """The main numbers of the run, each with the errors of computation and body: `summary["answers"]`."""
        return self.summary["answers"]

    @property
    def verdict(self) -> dict[str, Any]:
        """First words on the run, and their kinds: `summary["verdict"]`."""
        return self.summary["verdict"]

    @property
    def case(self) -> Any:
        """The Case that was run, with every choice made: of mesh, method, theory ..."""
        return import_module(".case", __package__).Case.from_text(self.report_data["case"])

    @property
    def outcome(self) -> str:
        """ "completed", "stopped", "inaccurate", "unstable", "chattering", "solver-failed" or
        "left-validity"."""
        return str(self.summary["outcome"]["kind"])

    @property
    def message(self) -> str:
        """Of a run that did not complete: the cause and what to do."""
        return str(self.summary["outcome"]["message"])

    @property
    def time(self) -> float:
        """The time reached, s."""
        return float(self.summary["outcome"]["time_s"])

    @property
    def first_failure(self) -> tuple[float, float] | None:
        """The interval, s, in which results stop being right; None if they do not."""
        failure = self.summary["outcome"]["first_failure_s"]
        return (failure[0], failure[1]) if failure else None

    @property
    def usable(self) -> bool:
        """Whether the whole result passed every check."""
        return self.outcome in ("completed", "stopped")

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the run."""
        return self._run.interrupted

    @property
    def timed_out(self) -> bool:
        """Whether the time that the run was given ended it."""
        return self._run.timed_out

    @property
    def warnings(self) -> list[str]:
        """Warnings about results that passed all checks."""
        return list(self.summary["warnings"])

    @property
    def n_certain(self) -> int | None:
        """How many sub-impacts are certain; None without error bars."""
        return int((self.sub_impacts["certain"] == 1).sum()) if self.summary["error_bars"] else None

    @property
    def all_certain(self) -> bool:
        """Whether it is certain that there are these sub-impacts and no others."""
        bars = self.summary["error_bars"]
        return bool(bars) and bars["first_unresolved_index"] is None

    def __getitem__(self, key: str) -> Any:
        """The value of a key of the case that was run, with every choice made."""
        table, _, leaf = key.rpartition(".")
        keys = self.summary["case"]
        try:
            value = keys[table][leaf] if table else keys["title" if leaf == "title" else ""]
        except KeyError:
            raise KeyError(f"{key} is no key of a case; tables are attributes, as in result.history[\"force_N\"]") from None
        return math.inf if value == "inf" and table else value

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes the files that `subimpact run` writes. Raises OutputError."""
        self._run.write(path_text(directory, OutputError))

    def report(self) -> str:
        """The summary and the table of sub-impacts, as `subimpact run` prints them."""
        return str(self.report_data["printed"])

    def to_pandas(self, table: str = "sub_impacts") -> Any:
        """A table as a pandas.DataFrame: "sub_impacts", "history", "sections" ..."""
        import pandas

        if table not in TABLES:
            raise ValueError(f"table is {table!r}; allowed: {', '.join(TABLES)}")
        return pandas.DataFrame(getattr(self, table))

    def __getstate__(self) -> dict[str, bytes]:
        if isinstance(self._run, Stored):
            return self._run.files
        with tempfile.TemporaryDirectory() as directory:
            self.write(directory)
            return Stored.read(directory).files

    def __setstate__(self, files: dict[str, bytes]) -> None:
        self._run = Stored(files)

    def _repr_html_(self) -> str:
        """The summary and the sub-impacts as `subimpact run` prints them, for notebooks."""
        return f"<pre>{escape(self.report())}</pre>"

    def __repr__(self) -> str:
        return f"<Result {self.report_data['brief']}>"

    def plot(self, axes: Any = None) -> Any:
        """Draws the contact force over time, sub-impacts shaded; returns the axes of Matplotlib. Other
        figures: `subimpact.plot`."""
        return import_module(".plot", __package__).force(self, axes)


def read_results(directory: str | os.PathLike[str]) -> Result:
    """A finished run, read back from its files. Raises ResultsError."""
    return Result(Stored.read(directory))
