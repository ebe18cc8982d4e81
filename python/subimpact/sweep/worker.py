"""One case of a sweep, from its number to the row that is stored."""

from __future__ import annotations

import math
import signal
import threading
import time
import zlib
from collections.abc import Sequence
from typing import NamedTuple

from .. import _core
from .._errors import CaseError
from .._text import one_line
from ..case import Case
from .plan import Plan

#: Columns of runs.csv between the swept keys and the message.
COLUMNS = (
    "outcome",
    "time_s",
    "n_sub_impacts",
    "n_zones",
    "n_decided",
    "all_decided",
    "wish_met",
    "horizon_s",
    "n_predictable",
    "predictable_until_s",
    "first_separation_s",
    "first_separation_error_s",
    "first_section_yield_s",
    "first_contact_yield_s",
    "max_force_N",
    "max_indentation_m",
    "residual_indentation_m",
    "impulse_Ns",
    "striker_velocity_m_per_s",
    "beam_mean_velocity_m_per_s",
    "restitution",
    "striker_energy_share",
    "max_energy_error",
)


class Row(NamedTuple):
    """What is kept of a case."""

    identity: str
    outcome: str
    cells: str  #: of COLUMNS after the outcome, and the message
    sub_impacts: bytes  #: lines of events.csv without their heading, compressed


def cell(value: object) -> str:
    """A value as the program's tables have it: 17 digits, and in texts no commas, no control
    characters and no quote at the beginning, which readers would take for a quoted cell."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, float):
        return format(value, ".17g")
    if isinstance(value, (list, tuple)):
        return ";".join(cell(item) for item in value)
    text = one_line(str(value)).replace(",", ";")
    return "'" + text[1:] if text.startswith('"') else text


def events_heading() -> str:
    """The heading of events.csv."""
    names = []
    listing = _core.columns().split("\n\n")[0].splitlines()[1:]
    for line in listing:
        names.append(line.split()[0])
    return ",".join(names)


def row_without_result(identity: str, outcome: str, message: str) -> Row:
    """Of a case that left no result."""
    cells = [""] * (len(COLUMNS) - 1) + [cell(message)]
    return Row(identity, outcome, ",".join(cells), zlib.compress(b"", 1))


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
        result = _core.run(case._load(), plan.error_bars, 1, None, plan.timeout)
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
    """What is kept of a result."""
    heading, *lines = result.events_csv().splitlines()
    first: dict[str, str] = {}
    if lines:
        first = dict(zip(heading.split(","), lines[0].split(",")))
    initial: float = result.value("striker.velocity")
    decided = result.n_decided
    values = (
        result.time,
        result.n_sub_impacts,
        result.n_zones,
        decided,
        None if decided is None else result.all_decided,
        result.wish_met,
        result.horizon,
        result.n_predictable,
        result.predictable_until,
        first.get("end_s"),
        first.get("end_error_s"),
        result.first_section_yield,
        result.first_contact_yield,
        result.max_force,
        result.max_indentation,
        result.residual_indentation,
        result.impulse,
        result.striker_velocity,
        result.beam_mean_velocity,
        (result.beam_mean_velocity - result.striker_velocity) / initial,
        (result.striker_velocity / initial) ** 2,
        result.max_energy_error,
        result.message if result.outcome != "completed" else "",
    )
    text = "".join(line + "\n" for line in lines)
    cells = ",".join(cell(value) for value in values)
    return Row(identity, result.outcome, cells, zlib.compress(text.encode(), 1))


def run_chunk(plan: Plan, numbers: Sequence[int]) -> tuple[list[Row], float]:
    """Runs cases one after another; returns their rows and the seconds that they took."""
    start = time.perf_counter()
    rows = []
    for number in numbers:
        with _Guard(plan.timeout):
            rows.append(run_case(plan, number))
    return rows, time.perf_counter() - start


class _Guard:
    """Ends the process if a case goes on long after its time, without looking at its clock.

    Only in the main thread of a process, which then runs nothing else."""

    def __init__(self, timeout: float | None) -> None:
        is_main = threading.current_thread() is threading.main_thread()
        self._seconds = 2 * timeout + 5 if timeout and is_main and timeout < math.inf else 0.0

    def __enter__(self) -> None:
        if self._seconds:
            signal.setitimer(signal.ITIMER_REAL, self._seconds)

    def __exit__(self, *_: object) -> None:
        if self._seconds:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
