"""Runs of a case."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Literal

from . import _core
from ._checks import check_jobs, check_progress, seconds
from ._errors import CaseError, OutputError
from ._text import path_text
from .case import Case, as_case
from .result import Result

ErrorBars = Literal["off", "all"]


def run(
    case: Case,
    *,
    error_bars: ErrorBars | None = None,
    within: float | str | None = None,
    jobs: int = 1,
    progress: Callable[[float], object] | None = None,
    timeout: float | str | None = None,
    body_errors: bool = True,
    out: str | os.PathLike[str] | None = None,
) -> Result:
    """Simulates a case, as `subimpact run` does.

    error_bars  None: errors of event times from a run half as fine, for a quarter of the time; "off": none; "all": those of
                sub-impacts too where the case fixes the mesh
    within      bound on the error of every event time, s or "1 us", for which the program chooses what the case leaves open
                of mesh, method and tolerance: accuracy.event_times
    jobs        threads for the runs of error estimates; results do not depend on it
    progress    called up to twenty times per second with the simulated time, s; False ends the run
    timeout     ends the run after some seconds, or "90 s"
    body_errors  whether errors of the body are estimated too: `Result.summary["body_errors"]`
    out         directory for the files of the run: `Result.write`

    Other Python threads go on meanwhile. A run that `progress`, `timeout` or Ctrl-C ends returns what there is, with the outcome
    "stopped" (`Result.interrupted`, `Result.timed_out`), and one whose solver fails with an outcome that says so. Raises
    CaseError for a case that cannot be run. The [scatter] of a case does not change its run: see `subimpact.scatter`.
    """
    case = as_case(case)
    if error_bars not in (None, "off", "all"):
        raise ValueError(f"error_bars is {error_bars!r}; allowed: None, \"off\", \"all\"")
    if within is not None:
        case = case.changed({"accuracy.event_times": within})
        if case["accuracy.event_times"] > case["time.end"]:
            raise CaseError(f"within is {within!r}; allowed: up to time.end, {case['time.end']:g} s")
    check_jobs(jobs)
    check_progress(progress)
    limit = seconds(timeout)
    directory = None if out is None else path_text(out, OutputError)
    result = Result(_core.run(case._load(), error_bars, jobs, progress, limit, body_errors))
    if directory is not None:
        result.write(directory)
    return result
