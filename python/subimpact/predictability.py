"""How far a strike with scattering numbers can be predicted; the command `subimpact scatter`."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._checks import check_jobs, check_progress
from ._command import Command, text_of_table
from ._errors import CaseError
from ._runs import Runs
from .case import Case, as_case
from .derivatives import END, FORCE, START, VELOCITY, Sensitivity, study_of, write_table
from .sweep.plan import Plan

if TYPE_CHECKING:
    from .result import Numbers, Table

N_SAMPLES = 64
_OF_LENGTH = 0.5  # of a duration or separation, in events beside it
_OF_CHANGE = 0.25  # of a duration or separation, in itself
_DEVIATIONS = 2.0  # within which a graze is possible

#: Numbers of the strike as a whole: columns of runs.csv, their names and units, and how many of these in one SI unit.
_TOTALS = (("n_sub_impacts", "sub-impacts", "", 1), ("restitution", "restitution", "", 1), ("max_force_N", "force", "N", 1),
           ("impulse_Ns", "impulse", "N s", 1), ("residual_indentation_m", "dent", "mm", 1e3),
           ("permanent_set_m", "set", "mm", 1e3), ("striker_velocity_m_per_s", "velocity", "m/s", 1))


@dataclass
class Total:
    """A number of the strike as a whole over the samples."""

    mean: float
    standard_deviation: float
    quantile_5: float  #: below which a twentieth of the samples lies
    quantile_95: float
    nominal: float  #: of the case itself, on the mesh of the samples


class Scatter:
    """What the relative standard deviations of numbers of a case leave of its event times: by first derivatives, up to
    where these hold; and of the strike as a whole: over samples."""

    def __init__(self, study: Sensitivity, scatter: dict[str, float]) -> None:
        self.study = study  #: the derivatives
        self.base = study.base  #: the run of the case itself, on the mesh of the derivatives
        self.interrupted = study.interrupted
        self.totals: dict[str, Total] = {}  #: by the names of columns of runs.csv
        self.n_samples = 0  #: runs of samples that completed
        self.samples_mesh = ""
        self._s = np.array([scatter.get(key, 0.0) for key in study.keys])
        self._deviations = self.deviation(study.derivatives, study.errors)
        first, reason = self._limit()
        self.n_predictable = first  #: leading sub-impacts that can be predicted one by one
        self.reason = reason  #: why the next one cannot; "" if all can
        hits = self.base.sub_impacts
        ends = np.where(np.isnan(hits["end_s"]), self.base.time, hits["end_s"])
        #: up to which the strike can be predicted, s
        self.horizon = self.base.time if not reason else float(ends[first - 1]) if first else 0.0
        self.table = self._table()
        self.zones = [self._zone(*np.flatnonzero(hits["zone"] == zone)[[0, -1]]) for zone in dict.fromkeys(hits["zone"].tolist())]

    def deviation(self, derivatives: Numbers, errors: Numbers) -> Numbers:
        """Standard deviations of numbers with these derivatives (keys last), each enlarged by its error."""
        change = np.where(self._s > 0, (np.abs(derivatives) + errors) * self._s, 0.0)
        return np.sqrt(np.square(change).sum(axis=-1))

    def _of_difference(self, later: tuple[int, int], earlier: tuple[int, int]) -> float:
        d, e = self.study.derivatives, self.study.errors
        return float(self.deviation(d[later] - d[earlier], e[later] + e[earlier]))

    def _table(self) -> Table:
        hits = self.base.sub_impacts
        table = np.empty(len(hits), [("sub_impact", "i8"), *((name, "f8") for name in (
            "start_s", "start_scatter_s", "end_s", "end_scatter_s"))])
        table["sub_impact"] = np.arange(1, len(hits) + 1)
        for name, q in (("start", START), ("end", END)):
            table[f"{name}_s"] = hits[f"{name}_s"]
            table[f"{name}_scatter_s"] = _within(self._deviations[:, q], self.base["time.end"])
        table.flags.writeable = False
        return table

    def _limit(self) -> tuple[int, str]:
        """How many sub-impacts can be predicted, and why the next one cannot."""
        first, why = self._limit_by_near_miss()
        for i in range(min(first, len(self.base.sub_impacts))):
            if reason := self._reason(i):
                return i, reason
        return min(first, len(self.base.sub_impacts)), why

    def _limit_by_near_miss(self) -> tuple[int, str]:
        first, why = len(self.base.sub_impacts), ""
        for (number, value, error), miss in zip(self.study.near_misses, self.base.summary["near_misses"]):
            deviation, margin = float(self.deviation(value, error)), miss["margin_m"]
            if _DEVIATIONS * deviation < margin or (why and first <= number):
                continue
            first = number
            scatter = "whose scatter is not known" if np.isnan(deviation) else f"which scatters by {1e6 * deviation:.2g} um"
            why = (f"at {1e6 * miss['time_s']:.6g} us the {'contact stays closed' if miss['kind'] == 'opening' else 'gap stays open'} "
                   f"by {1e6 * margin:.2g} um, {scatter}")
        return first, why

    def _reason(self, i: int) -> str:
        """Why a sub-impact cannot be predicted; "" if it can."""
        hits = self.base.sub_impacts
        start, end = hits["start_s"], hits["end_s"]
        has_ended = np.isfinite(end)
        largest = max(self._deviations[i, START], self._deviations[i, END if has_ended[i] else START])
        if np.isnan(largest):
            flag = self.study.flags[i][START]
            return f"it {flag}" if flag else "its standard deviation is not known"
        lengths: list[tuple[str, float, tuple[tuple[int, int], tuple[int, int]] | None]] = []
        if has_ended[i]:
            lengths.append(("its duration", end[i] - start[i], ((i, END), (i, START))))
        if i > 0 and has_ended[i - 1]:
            lengths.append(("the separation before it", start[i] - end[i - 1], ((i, START), (i - 1, END))))
        if i + 1 < len(hits) and has_ended[i]:
            lengths.append(("the separation after it", start[i + 1] - end[i], None))
        for words, length, ends in lengths:
            if excess := _excess("its start or end", largest, _OF_LENGTH, words, length):
                return excess
            if ends and (excess := _excess(words, self._of_difference(*ends), _OF_CHANGE, "itself", length)):
                return excess
        peak = hits["peak_force_N"][i]
        if has_ended[i] and _DEVIATIONS * self._deviations[i, FORCE] > peak:
            return f"its peak force, {peak:.3g} N, scatters by {self._deviations[i, FORCE]:.2g} N, and it may vanish"
        return ""

    def _zone(self, first: int, last: int) -> dict[str, float]:
        """Of a zone's start, end and impulse, the momentum that the striker loses; NaN: not known."""
        study, hits, d, e = self.study, self.base.sub_impacts, self.study.derivatives, self.study.errors
        mass, v0 = _core.moving_mass(study.run), _core.velocity_scale(study.run)
        by_velocity = np.array([key == "striker.velocity" for key in study.keys], dtype=float)
        by_mass = np.array([key == "striker.mass" for key in study.keys], dtype=float)
        before, error = (d[first - 1, VELOCITY], e[first - 1, VELOCITY]) if first > 0 else (v0 * by_velocity, 0.0)
        lost = (hits["striker_velocity_m_per_s"][first - 1] if first > 0 else v0) - hits["striker_velocity_m_per_s"][last]
        impulse = self.deviation(mass * (before - d[last, VELOCITY] + lost * by_mass), mass * (error + e[last, VELOCITY]))
        return {"start_scatter_s": float(_within(self._deviations[first, START], self.base["time.end"])),
                "end_scatter_s": float(_within(self._deviations[last, END], self.base["time.end"])),
                "impulse_scatter_Ns": float(_within(impulse, 2.0 * mass * v0))}

    def add_samples(self, runs: list[_core.Finished], nominal: _core.Finished) -> None:
        names = _core.swept_columns()
        rows = [dict(zip(names, run.swept_cells().split(","))) for run in (nominal, *runs)]
        self.n_samples, self.samples_mesh = len(runs), json.loads(nominal.summary())["used"]["mesh"]
        for name, *_ in _TOTALS:
            one, *values = (float(row[name] or "nan") for row in rows)
            if values and np.isfinite(values).all():
                spread = float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
                low, high = np.quantile(values, (0.05, 0.95)).tolist()
                self.totals[name] = Total(float(np.mean(values)), spread, low, high, one)

    def summary(self) -> dict[str, Any]:
        """What scatter.json has beside the table of starts and ends."""
        return {"horizon_s": self.horizon, "n_predictable": self.n_predictable, "reason": self.reason or None,
                "mesh": self.base.summary["used"]["mesh"], "zones": self.zones, "samples": self.n_samples,
                "samples_mesh": self.samples_mesh, "totals": {name: vars(total) for name, total in self.totals.items()}}

    def report(self) -> str:
        """What `subimpact scatter` prints."""
        table, n = self.table, len(self.table)
        known = np.nan_to_num(np.stack([table["start_scatter_s"], table["end_scatter_s"]])[:, :self.n_predictable])
        largest = _core.rounded(0.0, 1e6 * known.max(initial=0.0), 4)
        upto = f"up to {1e6 * self.horizon:.1f} us"
        scattered = f"; times scatter by up to {largest[1] if largest else '?'} us"
        if not self.reason:
            head = f"all {n} sub-impacts{scattered}"
        elif self.n_predictable == 0:
            head = f"no sub-impact: {self.reason}"
        else:
            head = f"{self.n_predictable} of {n} sub-impacts, {upto}{scattered}; beyond: {self.reason}"
        columns = [["no.", *(str(number) for number in table["sub_impact"])]]
        ends = ["", *("  from here on not predictable" if self.reason and i == self.n_predictable else "" for i in range(n))]
        for name in ("start", "end"):
            columns.append([f"{name}, us", *map(_time, table[f"{name}_s"].tolist(), table[f"{name}_scatter_s"].tolist())])
        text = (f"predictable: {head}\n\non {self.base.summary['used']['mesh']}; times with their standard deviations by the scatter of "
                "the case (?: not known, or more than is possible: derivatives do not hold that far)\n"
                + text_of_table(columns, [6, 22, 22], ends))
        for number, (zone, one) in enumerate(zip(self.zones, self.base.summary["zones"]), 1):
            impulse = _core.rounded(one["impulse_Ns"], zone["impulse_scatter_Ns"], 6)
            text += (f"zone {number} {_time(one['start_s'], zone['start_scatter_s']):>22} "
                     f"{_time(one['end_s'], zone['end_scatter_s']):>22}  impulse "
                     f"{' +- '.join(impulse) if impulse else format(one['impulse_Ns'], '.2g') + ' ?'} N s\n")
        for column, name, unit, per_si in _TOTALS:
            total = self.totals.get(column)
            if total is None or total.mean == total.standard_deviation == 0.0:  # no dent, no set
                continue
            mean = _core.rounded(per_si * total.mean, per_si * total.standard_deviation, 6) if total.standard_deviation > 0 else None
            text += (f"{name}: {' +- '.join(mean) if mean else format(per_si * total.mean, '.6g')} {unit}".rstrip()
                     + f": nine of ten from {per_si * total.quantile_5:.3g} to {per_si * total.quantile_95:.3g}\n")
        if self.totals:
            text += f"means +- standard deviations of {self.n_samples} runs on {self.samples_mesh}\n"
        return text

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes scatter.csv, the table, and scatter.json. Raises OutputError."""
        summary = json.loads(json.dumps(self.summary()), parse_constant=lambda _: None)  # null where a number is not known
        write_table(directory, "scatter", self.table, scatter=json.dumps(summary, indent=1) + "\n")

    def __repr__(self) -> str:
        return f"<Scatter of {self.base!r}: {self.n_predictable} predictable>"


def _within(deviation: Any, length: float) -> Any:
    """The standard deviation of a number that is confined to a range is at most half of it. Where derivatives give more,
    they do not hold over the scatter, and it is not known."""
    return np.where(deviation <= 0.5 * length, deviation, np.nan)


def _excess(what: str, deviation: float, share: float, of: str, length: float) -> str:
    if deviation <= share * length:
        return ""
    if np.isnan(deviation):
        return f"the standard deviation of {what} is not known"
    return (f"{what} scatters by {1e6 * deviation:.2g} us, more than {'half' if share == _OF_LENGTH else 'a quarter'} of {of}, "
            f"{1e6 * length:.2g} us")


def _time(time: float | None, deviation: float) -> str:
    if time is None or np.isnan(time):
        return "(open)"
    if deviation == 0.0:
        return f"{1e6 * time:g}"
    rounded = _core.rounded(1e6 * time, 1e6 * deviation, 4)
    return " +- ".join(rounded) if rounded else f"{1e6 * time:.0f} ?"


def scatter(
    case: Case,
    *,
    jobs: int = 1,
    progress: Callable[[int, int], object] | None = None,
    distribution: str = "normal",
) -> Scatter:
    """What the scatter of a case, its [scatter], leaves of the strike: standard deviations of event times by derivatives, how many
    sub-impacts can be predicted one by one, and numbers of the strike as a whole over 64 samples. Where the runs would take long,
    they are on coarser meshes, at least an eighth as fine.

    jobs      threads; results do not depend on it
    distribution  of the samples: "normal" or "uniform", of the same standard deviations
    progress  called with the number of runs that ended, and of all; False ends the study

    Raises CaseError for a case that cannot be run or in which nothing scatters, KeyboardInterrupt after Ctrl-C.
    """
    check_jobs(jobs)
    check_progress(progress)
    case = as_case(case)
    deviations = {key: case[f"scatter.{key}"] for key in _core.shifted_keys(case._load()) if case[f"scatter.{key}"]}
    keys = list(deviations)
    if not keys:
        raise CaseError('nothing scatters; give relative standard deviations in [scatter] of the case, such as "striker.velocity" '
                        "= 0.01", "scatter")
    chosen = Case.from_text(_core.as_chosen(case._load(), jobs))
    runs = Runs(jobs, progress, 2 + 4 * len(keys) + 1 + N_SAMPLES)
    for_derivatives = Case.from_text(_core.for_derivatives(chosen._load()))
    affordable = Case.from_text(_core.affordable(for_derivatives._load(), 2 + 4 * len(keys)))
    found = Scatter(study_of(affordable, keys, chosen, runs), deviations)
    if runs.interrupted:
        raise KeyboardInterrupt
    if found.base.outcome != "completed":
        return found
    if len(found.study.keys) < len(keys):
        raise CaseError(f"the scatter of event times is not known: {found.study.remarks[-1]}", "scatter")
    base = Case.from_text(_core.affordable(chosen._load(), N_SAMPLES))
    base["output.shapes"] = base["time.end"]  # of which the permanent set is known
    del base["accuracy.event_times"]
    plan = Plan(base, samples=N_SAMPLES, distribution=distribution)
    nominal, *made = runs.of([lambda: plan.base, *(partial(plan.case_of, number) for number in range(N_SAMPLES))])
    if runs.interrupted:
        raise KeyboardInterrupt
    whole = [run for run in made if isinstance(run, _core.Finished) and run.outcome == "completed"]
    if isinstance(nominal, _core.Finished) and 2 * len(whole) >= N_SAMPLES:
        found.add_samples(whole, nominal)
    return found


_EXAMPLES = """Standard deviations of starts and ends are by derivatives (subimpact sensitivity); a sub-impact is predictable one
by one until it scatters by half of its duration or of a separation beside it. Numbers of the strike as a whole are
those of 64 runs with sampled numbers.

Examples:
  subimpact new ensemble > case.toml && subimpact scatter case.toml
  subimpact scatter case.toml --set scatter.striker.velocity=0.01 --out out/scatter

Exit status: 0 done; 2 bad command line or case file, or a case in which nothing scatters; 3 a run failed; 128 and
the signal's number: stopped (130 by Ctrl-C)."""


def main(arguments: Sequence[str] | None = None) -> int:
    command = Command("scatter", "Shows how far a strike can be predicted whose numbers scatter ([scatter] of the case).", _EXAMPLES)
    command.add("--distribution", choices=("normal", "uniform"), default="normal", help="of the samples: normal, or uniform between "
                "1.73 standard deviations below and above")
    return command.run(arguments, lambda case, options, shared: scatter(case, distribution=options.distribution, **shared))


if __name__ == "__main__":
    sys.exit(main())
