"""What is drawn of a measured force beside the computed one, in figures and on the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..page import numbers
from ..plot.style import COLOURS, GREY, figure, legend_above, unit

if TYPE_CHECKING:
    from ..result import Numbers

_MOST_ROWS = 22_000  # of a chart of the page
_MOST_DRAWN = 600  # samples of a line


def thinned(times: Numbers, forces: Numbers, most: int) -> tuple[Numbers, Numbers]:
    """At most so many samples, with the largest and the smallest of each span."""
    span = -(-2 * len(times) // most)
    if span <= 2:
        return times, forces
    n = len(times) // span * span
    spans = forces[:n].reshape(-1, span)
    kept = np.unique(np.r_[0, (np.arange(len(spans))[:, None] * span + np.stack(
        [spans.argmin(1), spans.argmax(1)], axis=1)).ravel(), len(times) - 1])
    return times[kept], forces[kept]


def packed(times: Numbers, forces: Numbers) -> dict[str, dict[str, str]]:
    """A force as the page reads it."""
    times, forces = thinned(times, forces, _MOST_ROWS)
    return {"time_s": numbers.packed("f64", times), "force_N": numbers.packed("f32", forces)}


def _line(axes: Any, quantity: str, times: Numbers, forces: Numbers, begin: float, end: float, largest: float,
          **options: Any) -> None:
    """Of the time from begin to end, in units that suit the end and the largest force or strain."""
    (time, per_second), (force, per_newton) = unit("time", end), unit(quantity, largest)
    inside = (times >= begin) & (times <= end)
    axes.plot(*thinned(per_second * times[inside], per_newton * forces[inside], _MOST_DRAWN), **options)
    axes.set(xlim=(per_second * begin, per_second * end), xlabel=f"time of the run, {time}", ylabel=f"{quantity}, {force}")


@figure("a", height=3.2)
def draw_signal(signal: Any, axes: Any = None) -> Any:
    """A measured force, or a strain, on its own time: a Signal."""
    t, f = signal.times, signal.forces
    _line(axes, signal.quantity, t, f, float(t[0]), float(t[-1]), float(np.abs(f).max()), color=COLOURS[1])
    axes.set_xlabel(axes.get_xlabel().replace("time of the run", "time"))


@figure("a", height=3.2)
def draw_forces(a: Any, axes: Any = None, begin: float | None = None, end: float | None = None, **options: Any) -> Any:
    """The measured force and the computed one of an Alignment on the time of the run."""
    part = (a.begin if begin is None else begin, a.end if end is None else end, max(abs(a.computed.peak), abs(a.measured.peak)))
    label = "computed" if a.low_pass is None else "computed, as the transducer shows it"
    _line(axes, a.quantity, a.measured.times, a.measured.forces, *part, color=COLOURS[1], label="measured", **options)
    _line(axes, a.quantity, a.computed.times, a.computed.forces, *part, color=COLOURS[0], label=label)
    legend_above(axes)


@figure([["forces"], ["difference"], ["near"]], height=7.4, height_ratios=[2, 1, 2])
def draw_all(a: Any, axes: Any = None) -> Any:
    """The measured force and the computed one on the time of the run, their difference (computed less measured), and both
    about the largest force."""
    draw_forces(a, axes[0])
    times, difference = a.difference
    _line(axes[1], a.quantity, times, difference, a.begin, a.end, float(np.abs(difference).max()), color=GREY)
    axes[1].set_ylabel("difference" + axes[1].get_ylabel().removeprefix(a.quantity))
    half, peak = 0.03 * (a.end - a.begin), a.measured.peak_time
    draw_forces(a, axes[2], max(a.begin, peak - half), min(a.end, peak + half), marker=".", markersize=3)
    axes[2].get_legend().remove()
