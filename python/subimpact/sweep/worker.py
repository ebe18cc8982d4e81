"""One case of a sweep, from its number to the row that is stored."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Sequence
from typing import NamedTuple

from .. import _core
from .._errors import CaseError
from .._text import one_line
from ..case import Case
from .plan import Plan

#: Columns of runs.csv between the swept keys and the message.
COLUMNS = tuple(_core.swept_columns())


class Row(NamedTuple):
    """What is kept of a case."""

    identity: str
    outcome: str
    cells: str  #: of COLUMNS after the outcome, and the message
    sub_impacts: str  #: lines of events.csv without their heading
    place: str = ""  #: in a plan, Plan.place: by which the identity is found again without making the case


def cell(value: object) -> str:
    """A value as a cell of CSV: 17 digits; texts without control characters, quoted where they have commas or quotes."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, float):
        return format(value, ".17g")
    if isinstance(value, (list, tuple)):
        return ";".join(cell(item) for item in value)
    text = one_line(str(value))
    return '"' + text.replace('"', '""') + '"' if "," in text or '"' in text else text


def row_without_result(identity: str, outcome: str, message: str) -> Row:
    cells = [""] * (len(COLUMNS) - 1) + [cell(message)]
    return Row(identity, outcome, ",".join(cells), "")


def identity_of(plan: Plan, number: int, case: Case | None = None) -> str:
    """Of a case, allowed or not; `case` is plan.case_of(number), if it is there already."""
    try:
        return (case or plan.case_of(number)).identity(plan.how)
    except CaseError:
        settings = repr(plan.settings(number))
        base = plan.case.identity(plan.how + settings)
        return f"refused-{base[:24]}"


def run_case(plan: Plan, number: int) -> Row:
    """Runs a case on one core. Raises KeyboardInterrupt if Ctrl-C ends it."""
    case = plan.case_of(number)
    identity = identity_of(plan, number, case)
    try:
        result = _core.run(case._load(), plan.error_bars, 1, None, plan.timeout, False)
        if result.interrupted:
            raise KeyboardInterrupt
        if result.timed_out:
            return row_without_result(identity, "timed_out", f"took more than {plan.timeout:g} s")
        return row_of(identity, result)
    except CaseError as error:
        return row_without_result(identity, "refused", str(error))
    except MemoryError:
        return row_without_result(identity, "out_of_memory", "the memory of a worker does not suffice")


def row_of(identity: str, result: _core.Finished) -> Row:
    _, _, lines = result.events_csv().partition("\n")
    outcome, cells = result.swept_cells().split(",", 1)
    message = result.message if outcome != "completed" else ""
    return Row(identity, outcome, f"{cells},{cell(message)}", lines)


def run_chunk(plan: Plan, numbers: Sequence[int]) -> tuple[list[Row], float]:
    """Runs cases one after another; returns their rows and the seconds that they took."""
    start, patience = time.perf_counter(), _patience(plan.timeout)
    rows = []
    try:
        for number in numbers:
            if patience:  # a case may go on long after its time, without looking at its clock
                signal.setitimer(signal.ITIMER_REAL, patience)
            rows.append(run_case(plan, number))
    finally:
        if patience:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
    return rows, time.perf_counter() - start


def _patience(timeout: float | None) -> float:
    """Seconds after which a case ends its process; 0: never. Only in a main thread, which then runs nothing else."""
    return 2 * timeout + 5 if timeout and threading.current_thread() is threading.main_thread() else 0.0
