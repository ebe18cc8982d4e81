"""A measured force and the computed one of a run, on one time axis."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np

from .._errors import ResultsError
from ..result import Result
from .reading import Signal
from .units import value_in
from .words import answers_of

if TYPE_CHECKING:
    from ..result import Numbers

Found = Union[float, Literal["find"], None]
_LIKE_EACH_OTHER = 0.9  # correlation of two forces of the same strike
_IN_CONTACT = 0.05  # of the largest force
_OCTAVE = np.log(2.0)
_FEWEST = 20  # samples within the run
_ANOTHER = 0.3  # of the largest force, beyond what is compared
#: Standard errors in an error that is stated.
N_ERRORS = 3.0


def low_passed(times: Numbers, forces: Numbers, cutoff: float) -> Numbers:
    """The signal of a transducer with a Butterworth low-pass of fourth order, for a force that is
    zero before the first sample:

        H(s) = product over k = 0..3 of -p_k / (s - p_k),  p_k = 2 pi f exp(i pi (5 + 2 k)/8),

    with `cutoff` f in Hz, where the loss is 3 dB. At the samples the result is exact for the
    piecewise linear force, however far apart they are; low frequencies are delayed by 2.61/(2 pi f).
    """
    poles = 2 * np.pi * cutoff * np.exp(1j * np.pi * (5 + 2 * np.arange(4)) / 8)
    steps = np.diff(times)
    slopes = np.divide(np.diff(forces), steps, out=np.zeros_like(steps), where=steps > 0)
    filtered = np.zeros(len(times))
    for p in poles[:2]:  # the other pair is conjugate
        residue = -p * np.prod([q / (q - p) for q in poles if q != p])
        growth = np.exp(p * steps)
        phi = (growth - 1) / p
        state = forces[:-1] * phi + slopes * (phi - steps) / p
        distance = 1
        while distance < len(state):  # y_i = growth_i y_(i-1) + state_i, for twice as many at a time
            state[distance:] += growth[distance:] * state[:-distance]
            growth[distance:] *= growth[:-distance]
            distance *= 2
        filtered[1:] += 2 * (residue * state).real
    return filtered


def covariance_of(jacobian: Numbers, residuals: Numbers) -> Numbers:
    """That of parameters by least squares. Residuals that resemble their neighbours tell less than
    white noise: their autocorrelation widens the errors, and never narrows them."""
    from scipy.signal import correlate, fftconvolve

    n, k = jacobian.shape
    sizes: Numbers = np.linalg.norm(jacobian, axis=0)
    some = np.where(sizes > 0.0, sizes, 1.0)
    scaled = jacobian / some  # columns of one size: none is lost beside another
    inverse: Numbers = np.linalg.pinv(scaled.T @ scaled, hermitian=True) / np.outer(some, some)
    inverse[sizes == 0.0, sizes == 0.0] = np.inf
    white = inverse * (residuals @ residuals / max(n - k, 1))
    lags = min(int(np.sqrt(n)), n - 1)
    products = correlate(residuals, residuals, "full", "fft")[n - 1 - lags : n + lags] / n
    taper = products * (1 - np.abs(np.arange(-lags, lags + 1)) / (lags + 1))
    coloured = inverse @ (jacobian.T @ fftconvolve(jacobian, taper[:, None], "same", axes=0)) @ inverse
    with np.errstate(invalid="ignore", divide="ignore"):
        widening = np.sqrt(np.fmax(np.diag(coloured) / np.diag(white), 1.0))
    return white * widening[:, None] * widening


def jacobian(model: Callable[[Numbers], Numbers], x: Numbers, steps: Numbers, bounds: Numbers) -> Numbers:
    """The derivatives of a model, a column per parameter, by differences within the bounds."""
    columns = []
    for j, step in enumerate(steps):
        down, up = x.copy(), x.copy()
        down[j], up[j] = max(x[j] - step, bounds[0][j]), min(x[j] + step, bounds[1][j])
        columns.append((model(up) - model(down)) / (up[j] - down[j]))
    return np.stack(columns, axis=1)


def solve(model: Callable[[Numbers], Numbers], forces: Numbers, start: Numbers, steps: Numbers, bounds: Numbers,
          **options: Any) -> tuple[Numbers, Numbers]:
    """The parameters with which a model differs least from forces, and their covariance. `steps`: half the change of each
    parameter for its derivative; `bounds`: of two rows; `options`: of scipy.optimize.least_squares."""
    from scipy.optimize import least_squares

    size = float(np.abs(forces).max())  # strains are small beside the tolerance of gradients

    inside = np.clip(start, bounds[0] + 1e-6, bounds[1] - 1e-6)
    found = least_squares(lambda x: (model(x) - forces) / size, inside, jac=lambda x: jacobian(model, x, steps, bounds) / size,
                          bounds=tuple(bounds), **options)
    return found.x, covariance_of(found.jac, found.fun)


def correlation(one: Numbers, other: Numbers) -> float:
    """1 if they differ only by a factor."""
    size = float(np.sqrt((one @ one) * (other @ other)))
    return float(one @ other) / size if size > 0.0 else 0.0


class Curve:
    """A force, linear between its samples and zero before them."""

    def __init__(self, times: Numbers, forces: Numbers) -> None:
        self.times, self.forces = times, forces
        pieces = 0.5 * np.diff(times) * (forces[1:] + forces[:-1])
        self._integrals = np.r_[0.0, np.cumsum(pieces)]

    def at(self, times: Numbers) -> Numbers:
        return np.interp(times, self.times, self.forces, left=0.0)

    def means(self, width: float) -> Numbers:
        """Over bins from the first sample on."""
        edges = self.times[0] + width * np.arange(int((self.times[-1] - self.times[0]) / width) + 1)
        k = np.clip(np.searchsorted(self.times, edges, "right") - 1, 0, len(self.times) - 1)
        parts = 0.5 * (edges - self.times[k]) * (self.forces[k] + self.at(edges))
        return np.diff(self._integrals[k] + parts) / width

    def within(self, begin: float, end: float) -> tuple[Numbers, Numbers]:
        inside = (self.times > begin) & (self.times < end)
        return (np.r_[begin, self.times[inside], end],
                np.r_[self.at(np.array([begin])), self.forces[inside], self.at(np.array([end]))])


@dataclass(frozen=True)
class Side:
    """One of the two forces, or strains, on the time of the run."""

    times: Numbers  #: s
    forces: Numbers  #: N; the computed one as filtered, the measured one divided by the gain
    peak: float  #: N, the largest in the time that both cover; of strains that of the largest magnitude
    peak_time: float  #: s
    impulse: float  #: N s, in that time
    contact: float  #: s, how long in that time the force is above 5 % of its largest value


def _side(curve: Curve, begin: float, end: float) -> Side:
    times, forces = curve.within(begin, end)
    top = int(np.argmax(np.abs(forces)))
    steps, limit = np.diff(times), _IN_CONTACT * forces[top]
    low, high = np.minimum(forces[1:], forces[:-1]), np.maximum(forces[1:], forces[:-1])
    share = np.clip((high - limit) / np.where(high > low, high - low, 1.0), 0.0, 1.0)
    above = np.where(low >= limit, 1.0, np.where(high <= limit, 0.0, share))
    return Side(curve.times, curve.forces, float(forces[top]), float(times[top]),
                float(np.sum(0.5 * steps * (forces[1:] + forces[:-1]))), float(above @ steps))


@dataclass(frozen=True, repr=False)
class Alignment:
    """A measured force and the computed one on the time of the run. Errors are three standard
    errors; None: given, not found."""

    shift: float  #: s, by which the measured time is later than that of the run
    shift_error: float | None
    low_pass: float | None  #: Hz, of the filter of the computed force; None: no filter
    low_pass_error: float | None
    gain: float  #: measured over true force
    gain_error: float | None
    correlation: float  #: of both forces in the time they both cover; 1 if they differ by a factor
    interval: float  #: s, between measured samples
    begin: float  #: s, of the time that both cover
    end: float  #: s
    computed: Side
    measured: Side
    difference: tuple[Numbers, Numbers]  #: times and forces, computed less measured
    at_bound: bool  #: whether the cut-off found is at an end of the searched range
    quantity: str = "force"  #: or "strain": what is named a force here is then the strain of a gauge, m/m
    total_error: float | None = None  #: N, of the computed largest force, computation and body together; None: not known
    impulse_error: float | None = None  #: N s, the same of the impulse, where the record covers the run
    elsewhere: tuple[float, float] | None = None  #: time of the record, s, and force, N, of a strike that is not compared

    @property
    def doubt(self) -> str:
        """Why the comparison may mean nothing; "" if no reason was found."""
        if self.correlation < _LIKE_EACH_OTHER:
            return (f"the two {self.quantity}s have a correlation of {self.correlation:.2f}, and two of the same strike more than "
                    f"{_LIKE_EACH_OTHER}: the case is not that of the measurement, or the shift or the filter is wrong")
        ratio = abs(self.measured.peak / self.computed.peak) if self.computed.peak else 1.0
        if not 0.125 < ratio < 8.0:
            return (f"the measured {self.quantity} is {ratio:.3g} times the computed one: its unit, gain or sensitivity is likely "
                    "another one")
        if self.at_bound:
            return ("the cut-off found is at an end of the searched range: the measurement shows no low-pass filter of fourth "
                    "order between two periods in the record and half of the sampling rate")
        if self.elsewhere:
            time, force = self.elsewhere
            return (f"beyond the part that is compared the record has {force:.4g} N, at {time:.6g} s of its own time: another hit, or a "
                    "later sub-impact than the run has; keep one hit (rows=, skip=), give shift= for the other, or a later time.end")
        return ""

    def answers(self) -> list[dict[str, str]]:
        """Names, values and notes, in words."""
        return answers_of(self)

    def __repr__(self) -> str:
        lines = [f"{answer['name']:<14}  {answer['value']}  ({answer['note']})" for answer in self.answers()]
        return "\n".join(lines + ([f"warning: {self.doubt}"] if self.doubt else []))

    def plot(self, axes: Any = None) -> Any:
        """Draws both over the time of the run; returns the axes of Matplotlib."""
        from .drawing import draw_forces

        return draw_forces(self, axes)


def curve_of(result: Result, cutoff: float | None = None, column: str = "force_N") -> Curve:
    """The force of a run, or another column of its history, and as a transducer shows it."""
    if len(result.history) < 2:
        raise ResultsError("the run kept no history; run it again with output.interval above 0")
    if column not in (result.history.dtype.names or ()):
        raise ResultsError(f"the run has no {column}; give the case gauges, such as output.gauges = [{{ position = \"0.3 m\", "
                           "face = \"back\" }], and choose one with gauge=")
    times, forces = (np.ascontiguousarray(result.history[name]) for name in ("time_s", column))
    return Curve(times, forces if cutoff is None else low_passed(times, forces, cutoff))


class _Search:
    """Looks for shift, cut-off and gain at which a measured force resembles a computed one."""

    def __init__(self, computed: Curve, measured: Signal, shift: float | None) -> None:
        self.raw, self.measured, self.given = computed, measured, shift
        self.duration = float(computed.times[-1] - computed.times[0])
        record = float(measured.times[-1] - measured.times[0])
        self.width = max(measured.interval, self.duration / 2**15, record / 2**19)
        self._bins = Curve(measured.times, measured.forces).means(self.width)
        self.cutoffs = np.log([2.0 / min(self.duration, record), 0.5 / measured.interval])  # the range, of logarithms
        self.filtered = functools.lru_cache(maxsize=4)(self._filtered)

    def _filtered(self, x: float | None) -> Curve:
        """With the logarithm of a cut-off."""
        return self.raw if x is None else Curve(self.raw.times, low_passed(self.raw.times, self.raw.forces, float(np.exp(x))))

    def coarse(self, curve: Curve) -> tuple[float, float]:
        """The correlation at the best shift, or at the one given, and that shift."""
        from scipy.signal import correlate

        shift = self.given
        if shift is None:
            bins = curve.means(self.width)
            lag = int(np.argmax(correlate(self._bins, bins, "full", "fft"))) - len(bins) + 1
            shift = float(self.measured.times[0] - curve.times[0] + self.width * lag)
        times = self.measured.times - shift
        n = int(np.searchsorted(times, curve.times[-1], "right"))
        return correlation(curve.at(times[:n]), self.measured.forces[:n]), shift

    def _samples(self, guess: float) -> tuple[Numbers, Numbers]:
        """Those about the run at the best guess: near a solution they must not change."""
        margin = 0.0 if self.given is not None else max(8 * self.measured.interval, 2 * self.width)
        begin, end = guess + self.raw.times[0] - 0.1 * self.duration, guess + self.raw.times[-1] - margin
        about = slice(*np.searchsorted(self.measured.times, [begin, end]))
        return self.measured.times[about], self.measured.forces[about]

    def solve(self, low_pass: Found) -> tuple[Numbers, Numbers, Curve]:
        """Shift, logarithm of the cut-off and gain, their errors (NaN where given), the computed force."""
        find, unit = low_pass == "find", self.measured.interval
        x = None if low_pass is None or find else float(np.log(float(low_pass)))
        if find:
            grid = np.arange(self.cutoffs[1], self.cutoffs[0], -_OCTAVE / 3)
            x = float(max(grid, key=lambda x: self.coarse(self.filtered(x))[0]))
        guess = self.coarse(self.filtered(x))[1]
        times, forces = self._samples(guess)
        shape = self.filtered(x).at(times - guess)
        values = np.array([guess / unit, x or 0.0, float(shape @ forces) / (float(shape @ shape) or 1.0)])
        free = np.array([self.given is None, find, True])

        def force(free_values: Numbers) -> Numbers:
            values[free] = free_values
            shift, y, gain = values
            return gain * self.filtered(None if low_pass is None else float(y)).at(times - unit * shift)

        bounds = np.array([[-np.inf, self.cutoffs[0], -np.inf], [np.inf, self.cutoffs[1], np.inf]])
        found, covariance = solve(force, forces, values[free], np.array([0.5, 1e-3, 0.5])[free], bounds[:, free],
                                  x_scale="jac", xtol=1e-12)
        values[free] = found
        errors = np.full(3, np.nan)
        errors[free] = N_ERRORS * np.sqrt(np.diag(covariance))
        in_seconds = np.array([unit, 1.0, 1.0])
        return values * in_seconds, errors * in_seconds, self.filtered(None if low_pass is None else float(values[1]))


def column_of(signal: Signal, gauge: int) -> str:
    """The column of history.csv that a signal is compared with."""
    return "force_N" if signal.quantity == "force" else f"gauge_{gauge}_strain"


def _check_pushes(forces: Numbers, whose: str, remedy: str) -> None:
    low, high = float(np.min(forces, initial=0.0)), float(np.max(forces, initial=0.0))
    if not high > 0.0 or high < -low:
        raise ResultsError(f"the {whose} force lies between {low:.4g} and {high:.4g} N; {remedy}")


def in_seconds(shift: float | str | None) -> float | None:
    """A shift such as 1e-5 or "10us". Raises ResultsError."""
    time = value_in("time", shift) if isinstance(shift, str) else shift
    if shift is not None and (time is None or not np.isfinite(time)):
        raise ResultsError(f"shift is {shift!r}; allowed: s, such as 1e-5, or \"10us\"")
    return None if time is None else float(time)


def align(result: Result, signal: Signal, shift: float | str | None = None, gain: float | Literal["find"] = 1.0,
          low_pass: Found = None, gauge: int = 1) -> Alignment:
    """Compares a measured force, or a strain, with the history of a run, whose force is zero before it begins.

    shift     s, or "50us", by which the measured time is later than that of the run; None: it is found, where
              the two forces differ least
    gain      measured over true force; "find": by least squares
    low_pass  Hz, the cut-off of the transducer, by which the computed force is filtered: `low_passed`;
              "find": that with which the forces differ least, between two periods within the record
              and half of the sampling rate
    gauge     of a measured strain: the number, from 1, of the gauge in output.gauges

    Raises ResultsError if there is no common time, the run has no history, no force or no such gauge.
    """
    if isinstance(low_pass, str) and low_pass != "find":
        low_pass = value_in("frequency", low_pass) or 0.0
    if low_pass is not None and low_pass != "find" and not 0.0 < float(low_pass) < np.inf:
        raise ResultsError("low_pass is no frequency; allowed: Hz above 0, \"20kHz\", or \"find\"")
    if not (isinstance(result, Result) and isinstance(signal, Signal)):
        raise TypeError(f"align() has a {type(result).__name__} and a {type(signal).__name__}; allowed: a subimpact.Result, a Signal")
    shift = in_seconds(shift)
    raw = curve_of(result, column=column_of(signal, gauge))
    if (raw.times[-1] - raw.times[0]) < _FEWEST * signal.interval:
        raise ResultsError(f"samples are {1e6 * signal.interval:.4g} us apart, and the run is over after "
                           f"{1e6 * (raw.times[-1] - raw.times[0]):.4g} us; give units=us,N if the times have another unit, or a finer record")
    if signal.quantity == "force":
        _check_pushes(raw.forces, "computed", "a run without contact has no force to compare with a measurement")
        _check_pushes(signal.forces, "measured", "contact pushes, and its force is positive here: read it with sign=-1")
    search = _Search(raw, signal, shift)
    if shift is not None:
        _check_common(shift, signal, raw)
    (found_shift, x, found_gain), (shift_error, x_error, gain_error), computed = search.solve(low_pass)
    begin, end = _check_common(found_shift, signal, raw)
    factor = float(found_gain if gain == "find" else gain)
    if factor == 0.0:
        raise ResultsError(f"the gain found is 0: the measured {signal.quantity} has nothing of the computed one; leave shift= out, or change it")
    times, forces = signal.times - found_shift, signal.forces / factor
    inside = (times >= begin) & (times <= end)
    here = computed.at(times[inside])
    cutoff = None if low_pass is None else float(np.exp(x))
    find = low_pass == "find"
    covered = bool(begin <= raw.times[0] and end >= raw.times[-1])
    beyond = np.where(inside | (np.abs(times) < 2 * signal.interval), 0.0, forces)
    other, measured = int(np.argmax(beyond)), _side(Curve(times, forces), begin, end)
    is_hit = signal.quantity == "force" and beyond[other] > _ANOTHER * measured.peak
    return Alignment(
        total_error=_total_error(result, "largest_force"), impulse_error=_total_error(result, "impulse") if covered else None,
        elsewhere=(float(signal.times[other]), float(forces[other])) if is_hit else None,
        shift=float(found_shift), shift_error=float(shift_error) if shift is None else None,
        low_pass=cutoff, low_pass_error=float(x_error) * cutoff if cutoff and find else None,
        gain=factor, gain_error=float(gain_error) if gain == "find" else None,
        correlation=correlation(here, forces[inside]), interval=signal.interval, begin=begin, end=end,
        computed=_side(computed, begin, end), measured=measured,
        difference=(times[inside], here - forces[inside]),
        at_bound=find and float(np.min(np.abs(search.cutoffs - x))) < 1e-2, quantity=signal.quantity)


def _total_error(result: Result, key: str) -> float | None:
    """Of an answer of the run, computation and body together."""
    answer = next(answer for answer in result.answers if answer["key"] == key)
    errors = [answer["error"], answer["body_error"]]
    return None if None in errors else float(np.hypot(*errors))


def _check_common(shift: float, signal: Signal, run: Curve) -> tuple[float, float]:
    """The time of the run that both cover."""
    begin = max(float(signal.times[0]) - shift, float(run.times[0]))
    end = min(float(signal.times[-1]) - shift, float(run.times[-1]))
    if not begin < end:
        raise ResultsError(
            f"with a shift of {shift:.6g} s the measurement, from {signal.times[0]:.6g} to {signal.times[-1]:.6g} s, and the "
            f"run, from 0 to {run.times[-1]:.6g} s, have no time in common; leave the shift out, or change it")
    return begin, end
