"""What is said and drawn of a measured force beside the computed one."""

from __future__ import annotations

import base64
import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from .aligning import Alignment

    Numbers = npt.NDArray[np.float64]

CAPTION = ("The measured force and the computed one on the time of the run, their difference (computed less measured), and both "
           "about the largest force.")
_MOST_ROWS = 22_000  # of a chart of the page


def rounded(value: float, error: float | None, unit: str) -> str:
    """With the digits that the error allows."""
    if not error or not math.isfinite(error):
        return f"{value:.6g} {unit}"
    decimals = min(max(1 - math.floor(math.log10(error)), 0), 9)
    return f"{value:.{decimals}f} +- {error:.{decimals}f} {unit}"


def _difference(name: str, computed: float, measured: float, unit: str, note: str) -> dict[str, str]:
    percent = f": {100 * (computed - measured) / measured:+.2g} %" if measured else ""
    return {"name": name, "value": f"{computed:.4g} {unit} computed, {measured:.4g} measured{percent}", "note": note}


def answers_of(a: Alignment) -> list[dict[str, str]]:
    """Names, values and notes."""
    def known(error: float | None) -> str:
        return "as given" if error is None else "found"

    def times(factor: float, error: float | None) -> float | None:
        return None if error is None else factor * error

    answers = [{"name": "shift", "value": rounded(1e6 * a.shift, times(1e6, a.shift_error), "us"),
                "note": f"by which the measured time is later, {known(a.shift_error)}; correlation {a.correlation:.4f}, samples "
                        f"{1e6 * a.interval:.4g} us apart"}]
    if a.low_pass is not None:
        answers.append({"name": "low-pass", "value": rounded(1e-3 * a.low_pass, times(1e-3, a.low_pass_error), "kHz"),
                        "note": f"{known(a.low_pass_error)}; Butterworth, fourth order, on the computed force"})
    if a.gain != 1.0:
        answers.append({"name": "gain", "value": rounded(a.gain, a.gain_error, "").strip(),
                        "note": f"{known(a.gain_error)}; by which the measured force is divided"})
    c, m = a.computed, a.measured
    cover = f"from {1e6 * a.begin:.6g} to {1e6 * a.end:.6g} us of the run, which both cover"
    return [*answers,
            _difference("largest force", c.peak, m.peak, "N",
                        f"at {1e6 * c.peak_time:.1f} and {1e6 * m.peak_time:.1f} us of the run"),
            _difference("impulse", c.impulse, m.impulse, "N s", cover),
            _difference("time in contact", 1e6 * c.contact, 1e6 * m.contact, "us", "above 5 % of the largest force")]


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
    return {"time_s": {"f64": base64.b64encode(times.astype("<f8").tobytes()).decode()},
            "force_N": {"f32": base64.b64encode(forces.astype("<f4").tobytes()).decode()}}


def _draw(axes: Any, lines: list[tuple[Numbers, Numbers, str, Any]], begin: float, end: float) -> None:
    from ..plot.style import unit

    time, per_second = unit("time", end)
    force, per_newton = unit("force", *(forces for _, forces, _, _ in lines))
    for times, forces, label, options in lines:
        inside = (times >= begin) & (times <= end)
        axes.plot(*thinned(per_second * times[inside], per_newton * forces[inside], 600), label=label, **options)
    axes.set(xlim=(per_second * begin, per_second * end), xlabel=f"time of the run, {time}", ylabel=f"force, {force}")


def _forces(a: Alignment, **options: Any) -> list[tuple[Numbers, Numbers, str, Any]]:
    from ..plot.style import COLOURS

    computed = "computed" if a.low_pass is None else "computed, as the transducer shows it"
    return [(a.measured.times, a.measured.forces, "measured", {"color": COLOURS[1], **options}),
            (a.computed.times, a.computed.forces, computed, {"color": COLOURS[0]})]


def draw_forces(a: Alignment, axes: Any = None) -> Any:
    """Both forces over the time of the run."""
    import matplotlib.pyplot as plt

    from ..plot.style import style

    if axes is None:
        with style():
            axes = plt.figure(layout="constrained").add_subplot()
            return draw_forces(a, axes)
    _draw(axes, _forces(a), a.begin, a.end)
    axes.legend()
    return axes


def draw_all(a: Alignment) -> list[Any]:
    """Both forces, their difference, and both about the largest force: the panels of a figure."""
    import matplotlib.pyplot as plt

    from ..plot.style import GREY, WIDTH, legend_above, style

    with style():
        figure = plt.figure(figsize=(WIDTH, 7.4), layout="constrained")
        top, middle, bottom = figure.subplots(3, gridspec_kw={"height_ratios": [2, 1, 2]})
        _draw(top, _forces(a), a.begin, a.end)
        legend_above(top)
        _draw(middle, [(*a.difference, "", {"color": GREY})], a.begin, a.end)
        middle.set_ylabel("difference" + middle.get_ylabel().removeprefix("force"))
        half = 0.03 * (a.end - a.begin)
        _draw(bottom, _forces(a, marker=".", markersize=3), max(a.begin, a.measured.peak_time - half),
              min(a.end, a.measured.peak_time + half))
        return [top, middle, bottom]
