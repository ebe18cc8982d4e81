"""Derivatives of event times, forces and velocities; the command `subimpact sensitivity`."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from . import _core
from ._checks import check_jobs, check_progress
from ._command import Command, text_of_table
from ._errors import CaseError
from ._runs import Runs
from ._stored import write_files
from .case import Case, as_case
from .result import Result

if TYPE_CHECKING:
    import numpy.typing as npt

    from .result import Numbers, Table

Quantity = Literal[
    "start_s",
    "end_s",
    "peak_force_N",
    "impulse_Ns",
    "max_indentation_m",
    "striker_velocity_m_per_s",
]
QUANTITIES: tuple[str, ...] = get_args(Quantity)
START, END, FORCE, VELOCITY = 0, 1, 2, 5  #: indices of some of them

#: The shifts h: a key is multiplied by exp(+-h).
SHIFTS = (1e-5, 1e-6)
_RATIO = SHIFTS[0] / SHIFTS[1]
_RUNS_PER_KEY = 4  # plus and minus the larger shift, plus and minus the smaller one
_LOOSER = 10.0  # tolerance of the run that shows the error of the base run
_UNRELIABLE = 0.1  # of the largest derivative of a row
_BENT = 0.05  # of the largest derivative of a row, between the shifts
_GRAZE = 3.0  # of the change of a margin over the larger shift


class Sensitivity:
    """The derivatives of the numbers of every sub-impact by the logarithms of keys."""

    def __init__(self, run: _core.Finished, keys: list[str], remarks: list[str], interrupted: bool) -> None:
        self.run = run
        self.base = base = Result(run)  #: the run about which derivatives are taken, at a tolerance of 1e-13 or less
        self.keys = keys  #: the keys p by which there are derivatives df/d ln p
        self.remarks = remarks  #: what differs from the case, and keys without derivatives, in sentences
        self.interrupted = interrupted  #: whether Ctrl-C ended the study; `keys` are those whose runs had ended
        self.values = values_of(base.sub_impacts)  #: by sub-impact and quantity; NaN: it has not ended
        shape = (*self.values.shape, len(keys))
        self.derivatives, self.errors = np.full(shape, np.nan), np.full(shape, np.nan)
        self.flags: list[list[str]] = [[""] * len(QUANTITIES) for _ in self.values]
        #: of each near miss: the first sub-impact that it makes uncertain, from 0; derivatives of its margin, and their errors
        self.near_misses: list[tuple[int, Numbers, Numbers]] = []

    @cached_property
    def table(self) -> Table:
        """sensitivity.csv as a structured array. A row per number of a sub-impact: "quantity" (its name with the unit), "sub_impact"
        (from 1), "value", for each key "d_<key>", the derivative by its logarithm, and "error_<key>", in the unit of the quantity;
        "flag": why they are not reliable. NaN: a contact merges, splits or vanishes."""
        pairs = np.stack([self.derivatives, self.errors], axis=-1).reshape(*self.values.shape, -1)
        rows = [(QUANTITIES[q], i + 1, value, *pairs[i, q], self.flags[i][q])
                for (i, q), value in np.ndenumerate(self.values) if np.isfinite(value)]
        columns = [(name, "f8") for key in self.keys for name in (f"d_{key}", f"error_{key}")]
        table = np.array(rows, [("quantity", "U24"), ("sub_impact", "i8"), ("value", "f8"), *columns,
                                ("flag", f"U{max([16, *(len(row[-1]) for row in rows)])}")])
        table.flags.writeable = False
        return table

    def jacobian(self, quantity: Quantity) -> Numbers:
        """The derivatives of one quantity by the logarithms of `keys`, of shape (sub-impacts that have it, keys), in the unit with
        which its name ends: "start_s", "end_s", "peak_force_N", "impulse_Ns", "max_indentation_m" or "striker_velocity_m_per_s".
        The change by one per cent of a key is a hundredth of its column. Raises ValueError for other names."""
        if quantity not in QUANTITIES:
            raise ValueError(f"quantity is {quantity!r}; allowed: {', '.join(QUANTITIES)}")
        q = QUANTITIES.index(quantity)
        return self.derivatives[np.isfinite(self.values[:, q]), q]

    def report(self) -> str:
        """The table that `subimpact sensitivity` prints: changes of event times per 1 %."""
        # The first touch, where time begins, has no derivative.
        rows = [(i, q) for i in range(len(self.values)) for q in (START, END) if self.values[i, q] > 0]
        columns = [["", "no.", *(str(i + 1) for i, _ in rows)], ["", "", *(("start", "end")[q] for _, q in rows)],
                   ["", "us", *(f"{1e6 * self.values[row]:.4f}" for row in rows)]]
        for k, key in enumerate(self.keys):
            table, _, leaf = key.rpartition(".")
            columns.append([f"{table}.", leaf, *(_per_percent(self.derivatives[row][k], self.errors[row][k]) for row in rows)])
        flags = ["", "", *(f" ! {self.flags[i][q]}" if self.flags[i][q] else "" for i, q in rows)]
        used = self.base.summary["used"]
        return (f"{used['mesh']}, {used['method']}; change of event times in us per 1 % more of\n"
                + text_of_table(columns, [4, 5] + [9] * (len(columns) - 2), flags) + "".join(f"{each}\n" for each in self.remarks))

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes sensitivity.csv. Raises OutputError."""
        write_table(directory, "sensitivity", self.table)

    def __repr__(self) -> str:
        return f"<Sensitivity of {self.base!r} by {', '.join(self.keys) or 'no key'}>"


def write_table(directory: str | os.PathLike[str], name: str, table: Table, **others: str) -> None:
    """Writes name.csv and other files, by their names without endings (JSON). Raises OutputError."""
    from .sweep.worker import cell

    lines = [",".join(table.dtype.names or ()), *(",".join("" if value != value else cell(value) for value in row)
                                                  for row in table.tolist())]
    files = {f"{name}.csv": "\n".join([*lines, ""]), **{f"{other}.json": text for other, text in others.items()}}
    write_files(directory, name, {file: text.encode() for file, text in files.items()})


def _per_percent(derivative: float, error: float) -> str:
    """With as many digits as the error allows; a question mark where it allows none."""
    if derivative != derivative:
        return "-"
    rounded = _core.rounded(1e4 * derivative, 1e4 * error, 6)
    return rounded[0] if rounded else "?"


def values_of(sub_impacts: Table) -> Numbers:
    values: Numbers = np.stack([sub_impacts[name].astype(float) for name in QUANTITIES], axis=1)
    values[np.isnan(values[:, END]), END:] = np.nan
    return values


def counterparts(base: Table, other: Table) -> tuple[Numbers, npt.NDArray[np.bool_]]:
    """The numbers of another run's sub-impacts that correspond to those of a base run, NaN where contacts have merged,
    split or vanished; and whether the other run has a new contact before each."""
    of, follows = _core.counterparts(base, other)
    values = np.vstack([values_of(other), np.full(len(QUANTITIES), np.nan)])
    return values[[-1 if number is None else number for number in of]], np.array(follows)


def shifted(case: Case, key: str, shift: float) -> Case:
    """The case with the value of a key times exp(shift): of lists of forces and springs, every force and stiffness."""
    value = case[key]
    factor = math.exp(shift)
    if isinstance(value, list):
        value = [{name: number if name not in ("stiffness", "force", "table") else [[time, factor * force] for time, force in number]
                  if isinstance(number, list) else factor * number for name, number in entry.items()} for entry in value]
    else:
        value = factor * value
    changes = {key: value}
    for one, other in (("beam.poisson", "contact.beam_poisson"), ("contact.beam_poisson", "beam.poisson")):
        if key == one and case[other] is not None:
            changes[other] = value
    return case.changed(changes)


def _differences(base: Numbers, runs: Numbers) -> tuple[Numbers, Numbers]:
    """Slopes, and bends (the mean of both sides minus the value between them), of runs of shape (keys, 4, ...), for the
    larger and the smaller shift: of shape (keys, 2, ...)."""
    plus, minus = runs[:, 0::2], runs[:, 1::2]
    steps = np.array(SHIFTS).reshape(1, 2, *([1] * base.ndim))
    return (plus - minus) / (2.0 * steps), 0.5 * (plus - base + (minus - base))


def _noise(bends: Numbers) -> Numbers:
    """The error of one run, from second differences: the bend at the smaller shift, minus its value extrapolated from the
    larger shift for a smooth number, is that error times the root of 3/2."""
    return np.abs(bends[:, 1] - bends[:, 0] / (_RATIO * _RATIO)) / np.sqrt(1.5)


def _derived(base: Numbers, runs: Numbers, error: Numbers, smooth: bool) -> tuple[Numbers, Numbers]:
    """Derivatives and their errors, three times what follows from the difference of the slopes and the error of one run.
    Where sections yield, a section may just not flow for one value of a key and flow for another, for a time that grows
    as the root of the distance; the error of slopes then has a root, too."""
    slopes, _ = _differences(base, runs)
    step = slopes[:, 1] - slopes[:, 0]
    noise = error + np.finfo(float).eps * np.abs(base)
    extrapolated = 1.0 / (_RATIO * _RATIO - 1.0)
    left = extrapolated if smooth else 0.46  # 1/(sqrt(ratio) - 1)
    of_larger = np.abs(step) * (1.0 + left) + noise / SHIFTS[0]
    of_smaller = np.abs(step) * left + noise / SHIFTS[1]
    value = np.where(of_larger < of_smaller, slopes[:, 0], slopes[:, 1] + (extrapolated if smooth else 0.0) * step)
    # As of the first touch, where time begins.
    constant = (runs == base).all(axis=1)
    return np.where(constant, 0.0, value), np.where(constant, 0.0, 3.0 * np.minimum(of_larger, of_smaller))


def _upper_median(values: Numbers) -> Numbers:
    """Over the first axis, NaN left out; 0 of nothing else."""
    n = np.isfinite(values).sum(axis=0)
    return np.nan_to_num(np.take_along_axis(np.sort(values, axis=0), (n // 2)[None], axis=0)[0])


def _derive(study: Sensitivity, check: Table, share: float, runs: list[Table]) -> None:
    """Sets derivatives, errors and flags. `share`: of its differences from the check run, the error of the base run."""
    base, keys, n = study.base.sub_impacts, study.keys, len(study.keys)
    if n == 0 or len(base) == 0:
        return
    found = [counterparts(base, run) for run in runs]
    moved = np.stack([values for values, _ in found]).reshape(n, _RUNS_PER_KEY, *study.values.shape)
    new_before = np.stack([new for _, new in found]).reshape(n, _RUNS_PER_KEY, -1).any(axis=1)
    moved[:, :, np.isnan(study.values)] = np.nan
    smooth = study.base.summary["counts"]["yielded_sections"] == 0
    slopes, bends = _differences(study.values, moved)
    check_error = np.nan_to_num(share * np.abs(study.values - counterparts(base, check)[0]))
    # Numbers of the beam change its matrices, whose rounding adds to the errors: keys like this one show its errors.
    of_beam = np.array([key.startswith("beam.") for key in keys])
    error = np.empty((n, *study.values.shape))
    for kind in np.unique(of_beam):
        error[of_beam == kind] = np.maximum(_upper_median(_noise(bends)[of_beam == kind]), check_error)
    beside = np.pad(error, ((0, 0), (1, 1), (0, 0)))
    error = np.maximum(np.maximum(beside[:, :-2], beside[:, 2:]), error)
    derivatives, errors = _derived(study.values, moved, error, smooth)
    study.derivatives, study.errors = np.moveaxis(derivatives, 0, -1), np.moveaxis(errors, 0, -1)

    missing = ~np.isfinite(moved).all(axis=1)
    larger, smaller = (np.abs(bends[:, k]) / SHIFTS[k] for k in (0, 1))
    kink = ((smaller > 0.5 * larger) & (smaller < 2.0 * larger) & (smaller > 1e-3 * np.abs(slopes[:, 1]))
            & (np.abs(bends[:, 1]) > 3.0 * check_error))
    largest = np.nan_to_num(np.abs(derivatives)).max(axis=0)
    bend = np.nan_to_num(np.maximum(0.0, np.abs(slopes[:, 0] - slopes[:, 1]) - error / SHIFTS[1]))
    first = ((missing, "merges, splits or vanishes within the shifts of"), (kink, "has a kink in"))
    then = ((np.broadcast_to(new_before[:, :, None], kink.shape), "a contact appears before it within the shifts of"),
            (bend > _BENT * largest, "is about to merge, split or vanish with"),
            (np.nan_to_num(errors) > _UNRELIABLE * largest, "the shifts disagree in"))
    for causes in (first, then):
        for k, key in enumerate(keys):
            for where, words in causes:
                for i, q in np.argwhere(where[k] & np.isfinite(study.values)):
                    study.flags[i][q] = study.flags[i][q] or f"{words} {key}"


def _derive_near_misses(study: Sensitivity, runs: list[_core.Finished]) -> None:
    """Margins of near misses; flags sub-impacts that one makes uncertain which the shifts nearly reach."""
    misses, base = study.base.summary["near_misses"], study.run
    smooth = study.base.summary["counts"]["yielded_sections"] == 0
    margins = np.array([_core.matched_margins(base, run) for run in runs]).reshape(len(study.keys), _RUNS_PER_KEY, len(misses))
    for i, miss in enumerate(misses):
        here, moved = np.array(miss["margin_m"]), margins[:, :, i]
        value, error = _derived(here, moved, _noise(_differences(here, moved)[1]), smooth)
        first, change = _core.first_in_doubt(base, i), np.nan_to_num(np.abs(value)) * SHIFTS[0]
        study.near_misses.append((first, value, error))
        for k in np.flatnonzero(_GRAZE * change >= miss["margin_m"]):
            if first < len(study.flags):
                study.flags[first] = [flag or f"a near miss is within the shifts of {study.keys[k]}" for flag in study.flags[first]]


def _flag_later_contacts(study: Sensitivity, runs: list[Table]) -> None:
    """Flags the last sub-impact where a shifted run has one more."""
    base = study.base.sub_impacts
    for number, run in enumerate(runs):
        pairs = _core.matched(base, run)
        if pairs and pairs[-1][0] is None and study.flags:
            words = f"a contact appears after it within the shifts of {study.keys[number // _RUNS_PER_KEY]}"
            study.flags[-1] = [flag or words for flag in study.flags[-1]]


def study_of(case: Case, keys: list[str], given: Case, runs: Runs) -> Sensitivity:
    """The derivatives of a case as it is. `given`: the case from which it was made."""
    step = case["solver.step"]
    looser = {"solver.step": 0.5 * step} if step else {"solver.rtol": _LOOSER * case["solver.rtol"]}
    share = 4.0 / 3.0 if step else 1.0 / (_LOOSER - 1.0)  # of second order
    remarks = []
    if case["solver.method"] != given["solver.method"]:
        remarks = [f"by {case['solver.method']} in place of {given['solver.method']}: faster so near to rounding, and without "
                   "interpolated events, which jump with the phase of steps"]
    elif case["solver.rtol"] != given["solver.rtol"] and not step:
        remarks = [f"at rtol {case['solver.rtol']:g} in place of {given['solver.rtol']:g}, whose errors would hide the shifts"]
    moved = [shifted(case, key, sign * shift) for key in keys for shift in SHIFTS for sign in (1.0, -1.0)]
    for each in moved:
        each.check()
    base, check = runs.of([lambda: case, lambda: case.changed(looser)])
    for run in (base, check):
        if isinstance(run, CaseError):
            raise run
    assert isinstance(base, _core.Finished) and isinstance(check, _core.Finished)
    if base.outcome != "completed":
        return Sensitivity(base, [], remarks, runs.interrupted)
    made = runs.of([lambda each=each: each for each in moved])  # type: ignore[misc]
    kept: list[_core.Finished] = []
    complete = []
    for k, key in enumerate(keys):
        of_key = made[k * _RUNS_PER_KEY:(k + 1) * _RUNS_PER_KEY]
        failed = [run for run in of_key if isinstance(run, CaseError) or run.outcome != "completed"]
        if not failed:
            complete.append(key)
            kept += of_key  # type: ignore[arg-type]
        elif isinstance(failed[0], CaseError):
            raise failed[0]
        elif failed[0].outcome != "stopped":
            remarks.append(f"no derivatives by {key}: a run with a shifted value ended {failed[0].outcome}: {failed[0].message}")
    study = Sensitivity(base, complete, remarks, runs.interrupted)
    if not runs.interrupted and not (study.values > 0)[:, :END + 1].any():
        remarks.append("no number of a sub-impact can be derived before time.end: the first contact lasts to the end; use a later "
                       "time.end")
    tables = [run.table("sub_impacts") for run in kept]
    _derive(study, check.table("sub_impacts"), share, tables)
    _derive_near_misses(study, kept)
    _flag_later_contacts(study, tables)
    return study


def sensitivity(
    case: Case,
    by: str | Sequence[str] = (),
    *,
    jobs: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> Sensitivity:
    """Derivatives of start, end, peak force, impulse, indentation and striker velocity of every sub-impact by the logarithms of
    keys: from two pairs of runs per key, at rtol 1e-13 on one mesh, whose mismatch gives the error of each derivative.

    by        keys; none: all numbers of beam, striker and contact that take effect
    jobs      threads; results do not depend on it
    progress  called with the number of runs that ended, and of all; False ends the study

    A sub-impact is flagged if it is merged, split or lost in a shifted run, if another one appears before it, if a near miss
    lies within its change over the shifts, if the slopes on the two sides differ (a kink) or those of the two shifts (about to
    merge, split or vanish), or if an error is a tenth of the largest derivative of the row.

    After Ctrl-C there are the keys whose runs had ended; if there are none, KeyboardInterrupt is raised. A base run that fails
    leaves no derivatives: see `base`. Raises CaseError for a case that cannot be run, and for a key without a derivative.
    """
    check_jobs(jobs)
    check_progress(progress)
    chosen = Case.from_text(_core.as_chosen(as_case(case)._load(), jobs))
    base = Case.from_text(_core.for_derivatives(chosen._load()))
    keys = ([by] if isinstance(by, str) else list(by)) or _core.shifted_keys(base._load())
    for key in keys:
        if reason := _core.why_not_shifted(base._load(), key):
            raise CaseError(f"{key} {reason}", key)
    runs = Runs(jobs, progress, 2 + _RUNS_PER_KEY * len(keys))
    study = study_of(base, keys, chosen, runs)
    if runs.by_signal and not study.keys:
        raise KeyboardInterrupt
    return study


_EXAMPLES = """Each key takes four runs, two shifts to either side, at rtol 1e-13 on the mesh of the case; their
differences give the derivative, the mismatch of the shifts its error. Rows of contacts that are about to merge, to
split or to vanish are flagged.

Examples:
  subimpact sensitivity case.toml
  subimpact sensitivity case.toml --by striker.velocity,beam.thickness --out out/by-two
  subimpact sensitivity case.toml --method nystrom --set time.end=2e-3

Exit status: 0 done; 2 bad command line or case file, or a key without a derivative; 3 a run failed; 128 and the
signal's number: stopped (130 by Ctrl-C), with the keys whose runs had ended."""


def main(arguments: Sequence[str] | None = None) -> int:
    command = Command("sensitivity", "Shows how event times, forces and velocities depend on the numbers of a case.", _EXAMPLES)
    command.add("--by", metavar="KEY,...", default="", help="keys to derive by; default: all numbers of beam, striker and "
                "contact that take effect")
    return command.run(arguments, lambda case, options, shared: sensitivity(case, [key for key in options.by.split(",") if key],
                                                                            **shared))


if __name__ == "__main__":
    sys.exit(main())
