"""Studies of methods as tables: what `subimpact compare`, `work-precision` and `stability` write."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from . import _core
from ._checks import check_jobs
from ._tables import table_of
from .case import Case, as_case

Table = dict[str, Any]  #: columns, by their names: arrays of numbers (NaN: no number) or of texts


class Comparison(NamedTuple):
    """One scene by several methods."""

    runs: Table  #: comparison.csv: a row per method
    matches: Table  #: matches.csv: a row per method and sub-impact


def compare(case: Case, methods: Sequence[str]) -> Comparison:
    """Runs a scene by several methods ("erk", "erk:verner+library") and compares them with a reference by two methods at rtol
    1e-11. Raises CaseError; after Ctrl-C, KeyboardInterrupt."""
    runs, matches = _core.compare(as_case(case)._load(), list(methods))
    return Comparison(table_of(runs, "comparison"), table_of(matches, "matches"))


def work_precision(case: Case, methods: Sequence[str] = (), *, point_seconds: float = 10.0) -> Table:
    """Cost and error of every method (or of these) at tolerances and fixed steps, a row per run, for `plot.work_precision`. Runs
    are timed one at a time; one that would take longer than `point_seconds` is left out. Raises as compare()."""
    return table_of(_core.work_precision(as_case(case)._load(), list(methods), point_seconds), "work_precision")


def stability(case: Case, methods: Sequence[str] = (), *, run_seconds: float = 20.0, jobs: int = 1) -> Table:
    """How runs of every method (or of these) come out, a row per run, for `plot.outcomes`. Raises as compare()."""
    check_jobs(jobs)
    return table_of(_core.stability(as_case(case)._load(), list(methods), run_seconds, jobs), "outcomes")
