"""What all figures share: style, units, and panels that are made where none are given."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import style as matplotlib_style

from ..result import Result

#: Colours of Okabe and Ito, which the colour-blind can distinguish.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8B7500")
GREY = "#808080"
CONTACT, DOUBT = "#FBE6BE", "#E3B457"

#: Inches.
WIDTH = 7.2

STYLE: dict[str, Any] = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#404040",
    "axes.grid": True,
    "axes.labelsize": 9,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 9,
    "figure.titlesize": 9,
    "figure.titleweight": "bold",
    "font.sans-serif": ["DejaVu Sans", "Arial", "Helvetica"],
    "font.size": 9,
    "grid.color": "#D8D8D8",
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.6,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "path.simplify_threshold": 0.25,
    "pdf.fonttype": 42,
    "savefig.dpi": 200,
    "svg.fonttype": "none",
    "svg.hashsalt": "subimpact",
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
}

Draw = Callable[..., None]


class Absent(LookupError):
    """A figure that cannot be drawn of these results: the reason, and what to do."""


def present(table: Any, otherwise: str) -> Any:
    """The table, if it has rows. Raises Absent with what to do otherwise."""
    if not len(table):
        raise Absent(otherwise)
    return table


def grid_of(n: int, columns: int, height: float, least: float = 0.0) -> tuple[Any, dict[str, Any]]:
    """So many panels in rows, each so high (inches), for `figure`."""
    rows = -(-n // columns)
    cells = np.full(rows * columns, -1)
    cells[:n] = np.arange(n)
    return (cells.reshape(rows, columns).tolist(),
            {"empty_sentinel": -1, "figsize": (WIDTH, max(least, height * rows))})


def style() -> AbstractContextManager[None]:
    """Sizes, fonts and colours for publication, whatever the user's settings of Matplotlib are."""
    return matplotlib_style.context(["default", STYLE])


def figure(mosaic: Any, height: float = 4.6, **options: Any) -> Callable[[Draw], Callable[..., Any]]:
    """Makes `draw(source, axes, ...)`, which draws into one panel or a list of them and returns nothing, a function that
    makes these in a figure of its own where `axes` is None, and returns them. `mosaic`: the panels
    as Matplotlib's subplot_mosaic takes them, or a function of the source that returns them and
    other options of that function."""

    def of(draw: Draw) -> Callable[..., Any]:
        takes = next(iter(inspect.signature(draw).parameters))

        @functools.wraps(draw)
        def drawn(source: Any, axes: Any = None, *more: Any, **named: Any) -> Any:
            is_fit = {"result": isinstance(source, Result), "runs": isinstance(source, Mapping) or hasattr(source, "columns")}
            if not is_fit.get(takes, True):
                kinds = {"result": "a subimpact.Result", "runs": "the runs of a sweep, sweep.runs"}
                raise TypeError(f"{draw.__name__}() has a {type(source).__name__}; allowed: {kinds[takes]}")
            if isinstance(axes, str):
                raise TypeError(f"axes is {axes!r}; allowed: panels of Matplotlib, or None; what to draw is named: column={axes!r}")
            if axes is not None:
                draw(source, axes, *more, **named)
                return axes
            panels, changed = mosaic(source) if callable(mosaic) else (mosaic, {})
            with style():
                made = plt.figure(figsize=changed.pop("figsize", (WIDTH, height)), layout="constrained")
                try:
                    all_axes = list(made.subplot_mosaic(panels, **{**options, **changed}).values())
                    axes = all_axes if len(all_axes) > 1 else all_axes[0]
                    draw(source, axes, *more, **named)
                except BaseException:
                    plt.close(made)
                    raise
                if marks := marks_of(source):
                    made.suptitle("\n".join(marks))
            return axes

        return drawn

    return of


def marks_of(source: Any) -> list[str]:
    """What stands above the figures of a run: that it did not complete, that it is not certain."""
    if not isinstance(source, Result):
        return []
    marks = []
    if source.outcome != "completed":
        marks.append(f"{source.outcome.replace('_', ' ').replace('-', ' ')} at {1e3 * source.time:.6g} ms")
        if source.first_failure is not None:
            first, last = (1e6 * time for time in source.first_failure)
            marks.append(f"first failure between {first:.6g} and {last:.6g} µs")
    certain, n = source.n_certain, len(source.sub_impacts)
    if certain is not None and not source.all_certain:
        doubtful = f"{n - certain} of {n} sub-impacts {'is' if n - certain == 1 else 'are'} not certain"
        marks.append(doubtful if certain < n else "there may be another sub-impact")
    return marks


_UNITS: Mapping[str, tuple[tuple[float, str, float], ...]] = {
    "force": ((1e3, "kN", 1e-3), (0.1, "N", 1.0), (0.0, "mN", 1e3)),
    "length": ((1e-4, "mm", 1e3), (1e-7, "µm", 1e6), (0.0, "nm", 1e9)),
    "energy": ((0.1, "J", 1.0), (1e-4, "mJ", 1e3), (0.0, "µJ", 1e6)),
    "strain": ((0.0, "µm/m", 1e6),),
    "time": ((1e-3, "ms", 1e3), (0.0, "µs", 1e6)),
}


def unit(quantity: str, *values: Any) -> tuple[str, float]:
    """The unit that suits the largest of these values in SI units, and its number per SI unit."""
    largest = max((np.nanmax(np.abs(v), initial=0.0) for v in values), default=0.0)
    return next((name, factor) for least, name, factor in _UNITS[quantity] if largest >= least)


def legend_above(axes: Any, handles: Any = None, columns: int = 8) -> None:
    """The legend above the right end of a panel."""
    axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=columns, borderaxespad=0.1,
                handlelength=1.8, columnspacing=1.4)


def bands(axes: Any, starts: Any, ends: Any, colour: str, bottom: float = 0.0, height: float = 1.0,
          **options: Any) -> None:
    """Bands from start to end over a part of the height of a panel."""
    axes.broken_barh(list(zip(starts, np.subtract(ends, starts))), (bottom, height), linewidth=0,
                     transform=axes.get_xaxis_transform(), zorder=0, **{"facecolor": colour, **options})
