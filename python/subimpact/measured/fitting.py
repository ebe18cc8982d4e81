"""Keys of a case fitted to a measured force or strain."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .._errors import CaseError, ResultsError
from ..case import Case, as_case, keys as all_keys
from ..result import Result
from ..running import ErrorBars, run
from .aligning import Alignment, align, column_of, curve_of, in_seconds, jacobian, solve
from .reading import Signal
from .words import rounded

if TYPE_CHECKING:
    from ..result import Numbers

#: Where what the fit changes begins: the first step of the solver is about as large.
_BEGIN = 0.1
_STEP = 1e-3  # of a key, for derivatives; the tolerance of a run is far below
_FELT = 1e-9  # change of the force that is more than rounding, in its largest value
_ROWS = 4000  # of a run, between which its force is linear
_APART = 1e-3  # of unit derivatives of the force: the least share that is not a sum of the others


@dataclass(frozen=True, repr=False)
class Fit:
    """Keys of a case with which a run gives what was measured."""

    keys: tuple[str, ...]
    values: Numbers  #: in SI units, as `case` has them
    errors: Numbers  #: standard errors
    correlation: Numbers  #: of the keys: a row and a column per key
    alignment: Alignment  #: the measured force beside that of the fitted case
    case: Case  #: the fitted one
    n_runs: int
    at_bound: tuple[str, ...] = ()  #: keys whose value is an end of what was allowed

    def __repr__(self) -> str:
        lines = []
        for key, value, error, others in zip(self.keys, self.values, self.errors, self.correlation):
            scale = 10.0 ** (3 * math.floor(math.log10(abs(value)) / 3)) if value else 1.0
            power = "" if scale == 1.0 else f"e{round(math.log10(scale)):+d}"
            text = rounded(value / scale, error / scale, "").strip().replace(" +-", f"{power} +-") + power
            bound = ", at the end of its bounds" if key in self.at_bound else ""
            bound += ", which this record does not tell" if error > abs(value) else ""
            related = " ".join(f"{other:+.2f}" for other in others)
            lines.append(f"{key:<24}  {text} {all_keys()[key].unit} (standard error){bound}; correlation {related}")
        return "\n".join([*lines, f"after {self.n_runs} runs", repr(self.alignment)])

    def plot(self, axes: Any = None) -> Any:
        """Draws both forces over the time of the run; returns the axes of Matplotlib."""
        return self.alignment.plot(axes)


def _start(case: Case, keys: Sequence[str]) -> dict[str, float]:
    known, start = all_keys(), {}
    for key in keys:
        if key not in known or known[key].type != "number":
            numbers = ", ".join(name for name in known if known[name].type == "number"
                                and name.startswith(("beam.", "striker.", "contact.")))
            what = f"is {known[key].allowed}" if key in known else "is no key"
            raise CaseError(f"{key} {what}, and a fit changes numbers; allowed: {numbers}", key)
        value = case[key]
        if not isinstance(value, (int, float)) or not math.isfinite(value):
            raise CaseError(f"{key} is {'open' if value is None else repr(value)} in the case, and a fit begins with a number; "
                            f"set case[\"{key}\"] to a likely one", key)
        start[key] = float(value)
    if not start or len(start) < len(keys):
        raise CaseError(f"keys is {list(keys)!r}; allowed: one key or several, each once")
    return start


class _Runs:
    """Runs of the case with other values of its keys; the last ones are kept."""

    def __init__(self, case: Case, signal: Signal, start: Mapping[str, float]) -> None:
        self.units = dict.fromkeys(start, 1.0)  # of keys that begin at 0
        changes: dict[str, Any] = {"output.sections": [], "output.points": [], "output.shapes": 0.0}
        finest = case["time.end"] / _ROWS
        changes["output.interval"] = signal.interval / max(1, math.ceil(signal.interval / finest))
        self.quantity = signal.quantity
        self.case = case.changed({**case.chosen(), **changes})  # one model for all runs
        self.start = start
        self.n = 0
        self._result = functools.lru_cache(maxsize=2 * len(start) + 9)(self._run)

    def values(self, x: Numbers) -> dict[str, float]:
        """At _BEGIN they are those of the start. Keys that begin at 0 change by a unit, others by a factor."""
        return {key: float(value * math.exp(y - _BEGIN)) if value else float((y - _BEGIN) * self.units[key])
                for (key, value), y in zip(self.start.items(), x)}

    def choose_units(self, force: Callable[[Numbers], Numbers], limits: tuple[Numbers, Numbers]) -> None:
        """Of keys that begin at 0, a thousand times the least change that can be seen in the force."""
        before = force(np.full(len(self.start), _BEGIN))
        for j, key in enumerate(self.units):
            change = _STEP * (np.arange(len(self.start)) == j)
            self.units[key] = 1.0 if self.start[key] else 1e-6
            while (not self.start[key] and self.units[key] < min(limits[1][j], 1e12)
                   and np.abs(force(_BEGIN + change) - before).max() < 1e-3 * np.abs(before).max()):
                self.units[key] *= 10.0
            if not self.start[key]:  # as far as a unit, or nine tenths of what is allowed
                change *= min(1e3, 0.9 * (limits[1][j] - _BEGIN) / (_STEP * self.units[key]))
            if not np.abs(force(_BEGIN + change) - before).max() > _FELT * np.abs(before).max():
                raise ResultsError(f"the {self.quantity} does not depend on {key}, or by less than rounding; leave it out of the "
                                   "fit, or begin elsewhere")

    def __call__(self, x: Numbers) -> Result:
        return self._result(tuple(self.values(x).items()))

    def with_errors(self, x: Numbers) -> Result:
        """The run of the case itself, whose errors are those of the fitted one."""
        return self._run(tuple(self.values(x).items()), error_bars=None, body_errors=True)

    def _run(self, values: tuple[tuple[str, float], ...], error_bars: ErrorBars | None = "off", body_errors: bool = False) -> Result:
        result = run(self.case.changed(dict(values)), error_bars=error_bars, body_errors=body_errors)
        self.n += 1
        if result.interrupted:
            raise KeyboardInterrupt
        if result.outcome not in ("completed", "inaccurate"):
            where = ", ".join(f"{key} = {value:.6g}" for key, value in values)
            raise ResultsError(f"the run with {where} ended {result.outcome}: {result.message}; begin elsewhere, or give bounds")
        return result


def _check_apart(derivatives: Numbers, names: Sequence[str], quantity: str) -> None:
    """Refuses keys whose changes together leave the force as it is."""
    _, sizes, directions = np.linalg.svd(derivatives / np.linalg.norm(derivatives, axis=0), full_matrices=False)
    if (alike := np.abs(directions[sizes < _APART * sizes[0]]).max(axis=0, initial=0.0) > 0.05).any():
        stand = [name for name, is_alike in zip(names, alike) if is_alike]
        raise ResultsError(f"{', '.join(stand)} stand for one another: changed together they leave the {quantity} as it is, so that it "
                           "does not tell their values; leave one of them out of the fit, with its value from elsewhere")


def _limits(runs: _Runs, bounds: Mapping[str, tuple[Any, Any]] | None) -> tuple[Numbers, Numbers]:
    """Of what the fit changes: the range of each key, or what is given."""
    if strange := sorted(set(bounds or {}) - set(runs.start)):
        raise CaseError(f"bounds has {', '.join(map(repr, strange))}; allowed: the keys of the fit, {', '.join(runs.start)}")
    lower, upper = [], []
    for key, value in runs.start.items():
        known = all_keys()[key]
        low, high = (bounds or {}).get(key) or (-math.inf if known.least is None else known.least,
                                                math.inf if known.most is None else known.most)
        low, high = (runs.case.changed({key: end})[key] if isinstance(end, str) else end for end in (low, high))
        if not low <= value <= high:
            raise CaseError(f"{key} is {value:g}, and its bounds are {low:g} and {high:g}; begin between them", key)
        if value:
            low, high = sorted((low / value, high / value))
            low, high = (math.log(low) if low > 0 else -math.inf), (math.log(high) if high > 0 else math.inf)
        lower.append(_BEGIN + low / runs.units[key])
        upper.append(_BEGIN + high / runs.units[key])
    return np.array(lower), np.array(upper)


def fit(
    case: Case,
    signal: Signal,
    keys: str | Sequence[str],
    *,
    shift: float | str | None = None,
    low_pass: float | None = None,
    gain: float = 1.0,
    gauge: int = 1,
    bounds: Mapping[str, tuple[Any, Any]] | None = None,
    progress: Callable[[int, float], object] | None = None,
) -> Fit:
    """Finds the values of keys with which the force, or strain, of the run differs least from the measured one,
    by least squares. It begins with the values of the case, which must be likely ones, and refuses keys that stand for one another.

    keys       numbers of the case: "striker.nose_radius", "contact.damping"
    shift      s, by which the measured time is later; None: it is found with the keys
    low_pass   Hz, cut-off of the transducer; `gain`, measured over true force; `gauge`: as `align` takes them
    bounds     least and largest values by key, with or without units; the others are what the key allows
    progress   called with the number of runs and the root of the mean square of the difference, N

    Every run but the last, whose errors `alignment` compares with, is without error bars. Raises CaseError for keys that are no numbers or
    have no value, and ResultsError as `align` does, and for keys that the force does not depend on.
    """
    shift = in_seconds(shift)
    start = _start(as_case(case), [keys] if isinstance(keys, str) else list(keys))
    runs = _Runs(case, signal, start)
    n = len(start)
    first = align(runs(np.full(n, _BEGIN)), signal, shift, gain, low_pass, gauge)
    apart = 20 * signal.interval  # a unit of the shift
    margin = 0.1 * (first.end - first.begin)
    later = signal.times - first.shift
    inside = (later > first.begin - margin) & (later < first.end - 16 * signal.interval)
    times, forces = signal.times[inside], signal.forces[inside] / gain
    if len(times) < 10 * (n + 1):
        raise ResultsError(f"{len(times)} samples lie within the run where its {signal.quantity} resembles the measured one most (correlation "
                           f"{first.correlation:.2f}), too few for {n + 1} numbers; a record of noise alone? If not, give shift=, or sample faster")

    def force(z: Numbers) -> Numbers:
        moved = first.shift + ((z[n] - _BEGIN) * apart if shift is None else 0.0)
        computed = curve_of(runs(z[:n]), low_pass, column_of(signal, gauge)).at(times - moved)
        if progress is not None:
            progress(runs.n, float(np.sqrt(np.mean((computed - forces) ** 2))))
        return computed

    free = np.full(n + (shift is None), _BEGIN)
    runs.choose_units(lambda x: force(np.r_[x, free[n:]]), _limits(runs, bounds))
    ends = np.pad(_limits(runs, bounds), ((0, 0), (0, len(free) - n)), constant_values=np.nan)
    ends[:, n:] = [[-np.inf], [np.inf]]
    steps = np.r_[np.full(n, _STEP), np.full(len(free) - n, 0.5 * signal.interval / apart)]
    _check_apart(jacobian(force, free, steps, ends), [*start, "the shift"], signal.quantity)
    found, covariance = solve(force, forces, free, steps, ends, method="dogbox", xtol=1e-6, ftol=1e-7)
    covariance = covariance[:n, :n]
    values = runs.values(found[:n])
    deviations = np.sqrt(np.diag(covariance))
    per_x = np.array([abs(value) if start[key] else runs.units[key] for key, value in values.items()])
    with np.errstate(invalid="ignore"):
        related = covariance / np.outer(deviations, deviations)
    gap = np.minimum(np.abs(found - ends[0]), np.abs(ends[1] - found))[:n]
    at_bound = tuple(key for key, distance in zip(start, gap) if distance < 1e-5)
    return Fit(tuple(start), np.array(list(values.values())), deviations * per_x, related,
               align(runs.with_errors(found[:n]), signal, shift, gain, low_pass, gauge), case.changed(values), runs.n, at_bound)
