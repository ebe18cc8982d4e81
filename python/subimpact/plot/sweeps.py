"""Figures of the runs of a sweep: a map over two keys, and how numbers are distributed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib
import matplotlib.ticker
import numpy as np

from ..case import keys
from .style import COLOURS, Absent, figure, grid_of, present

Table = Mapping[str, Any]

#: Columns of runs.csv that histograms() shows.
CHIEF = ("n_sub_impacts", "first_separation_s", "max_force_N", "impulse_Ns", "restitution", "permanent_set_m")

_KEYS = keys()
_UNITS = {"s": ("µs", 1e6), "N": ("kN", 1e-3), "m": ("mm", 1e3), "J": ("J", 1.0), "Ns": ("mN s", 1e3)}
_MOST_CELLS_WITH_NUMBERS = 600
_LARGE_ERROR = 0.1  # of a number, from which on a map hatches it
# 0, 1, 2 ... each of a colour of its own; more are shaded.
_COUNTS = ("#FFFFFF", "#56B4E9", "#E69F00", "#009E73", "#F0E442", "#CC79A7", "#D55E00", "#0072B2", "#A6761D",
           "#B3B3B3")


def _name_and_unit(column: str) -> tuple[str, float]:
    """How a column of runs.csv is called on an axis, and its factor."""
    if column in _KEYS:
        return f"{column}, {_KEYS[column].unit}".removesuffix(", "), 1.0
    words, _, ending = column.rpartition("_")
    if ending not in _UNITS or not words:
        return column.removeprefix("n_").replace("sub_impacts", "sub-impacts").replace("_", " "), 1.0
    name, factor = _UNITS[ending]
    return f"{words.replace('_', ' ')}, {name}", factor


def known_numbers(runs: Table, column: str) -> Any:
    """The finite ones of a column; none of texts."""
    values = np.asarray(runs[column] if column in runs else [])
    return values[np.isfinite(values)] if values.dtype.kind in "if" else values[:0]


def _numbers(runs: Table, column: str) -> Any:
    present(known_numbers(runs, column), f"the runs have no numbers in a column {column}")
    return np.asarray(runs[column], float)


def error_column(runs: Table, column: str) -> str | None:
    """That with the error of a number: first_separation_error_s of first_separation_s."""
    names = (f"{column[:i]}_error{column[i:]}" for i in range(len(column) + 1))
    return next((name for name in names if name in runs), None)


def _is_doubtful(runs: Table, column: str) -> Any:
    """By run: a count that is not certain, an error that is large or not known, a warning."""
    certain = np.asarray(runs["all_certain"] if "all_certain" in runs else np.full(len(runs["run"]), np.nan))
    judged = np.isin(certain, (0, 1))
    if error := error_column(runs, column):
        with np.errstate(invalid="ignore"):
            doubtful = judged & ~(np.asarray(runs[error], float) <= _LARGE_ERROR * np.abs(np.asarray(runs[column], float)))
    else:
        doubtful = judged & (certain == 0) & column.startswith("n_")
    if "warnings" in runs:
        doubtful = doubtful | [isinstance(kinds, str) and kinds != "" for kinds in runs["warnings"]]
    return doubtful


def _grid(runs: Table) -> tuple[str, str]:
    """The two keys that the map is over: y and x."""
    columns = list(runs)
    keys = columns[columns.index("run") + 1 : columns.index("outcome")]
    varied = {key: len(np.unique(runs[key])) for key in keys if np.asarray(runs[key]).dtype.kind in "if"}
    varied = {key: n for key, n in varied.items() if n > 1}
    texts = [key for key in keys if key not in varied and len(np.unique(np.asarray(runs[key]).astype(str))) > 1]
    if len(varied) < 2 and texts:
        raise Absent(f"a map needs two keys with numbers, and {', '.join(texts)} has words; draw the runs of one of them at a time")
    if len(varied) < 2 or np.prod([*varied.values()][:2]) > 4 * len(runs["run"]):
        raise Absent("a map needs two keys that vary over the values of a grid")
    y, x = [*varied][:2]
    return y, x


@figure([[0]], height=5.0)
def sweep_map(runs: Table, axes: Any = None, column: str = "n_sub_impacts") -> Any:
    """A number of each run over the two keys that the sweep varies; of several runs in a cell the mean.
    Hatched: a count that is not certain, a number with an error that is above a tenth of it or not known, a run with
    warnings. Grey: no run, or one that did not complete."""
    y_key, x_key = _grid(runs)
    xs, x = np.unique(runs[x_key], return_inverse=True)
    ys, y = np.unique(runs[y_key], return_inverse=True)
    label, factor = _name_and_unit(column)
    values = np.where(runs["outcome"] == "completed", factor * _numbers(runs, column), np.nan)
    known = np.isfinite(values)
    total, number = (np.zeros((len(ys), len(xs))) for _ in range(2))
    np.add.at(total, (y[known], x[known]), values[known])
    np.add.at(number, (y[known], x[known]), 1)
    cells = np.divide(total, number, out=np.full_like(total, np.nan), where=number > 0)
    norm, colours = _colours(cells, column)
    axes.set_facecolor("#DDDDDD")
    mesh = axes.pcolormesh(cells, cmap=colours, norm=norm, edgecolor="white", linewidth=0.3)
    bar = axes.figure.colorbar(mesh, ax=axes, label=label)
    if isinstance(norm, matplotlib.colors.BoundaryNorm):
        bar.set_ticks(np.arange(0, norm.boundaries[-1], -(-len(norm.boundaries) // 16)))
        bar.minorticks_off()
    doubtful = np.zeros_like(total)
    np.add.at(doubtful, (y, x), known & _is_doubtful(runs, column))
    if doubtful.any():
        axes.pcolor(np.where(doubtful > 0, 1.0, np.nan), hatch="////", alpha=0.0)
    for size, keys, axis, key in ((len(xs), xs, axes.xaxis, x_key), (len(ys), ys, axes.yaxis, y_key)):
        every = -(-size // 12)
        axis.set_ticks(np.arange(0, size, every) + 0.5, [f"{value:.3g}" for value in keys[::every]])
        axis.set_label_text(_name_and_unit(key)[0])
    axes.grid(False)
    axes.tick_params(length=0)
    if not np.isfinite(cells).all():
        axes.set_title(f"grey: no {label.partition(',')[0]}, as not completed or not known", loc="left")
    if cells.size <= _MOST_CELLS_WITH_NUMBERS:
        _write_numbers(axes, mesh, cells)


def _colours(cells: Any, column: str) -> tuple[Any, Any]:
    if not column.startswith("n_"):
        return None, "viridis"
    most = int(np.nanmax(cells, initial=1))
    own = list(_COUNTS[: most + 1])
    shades = matplotlib.colormaps["magma"](np.linspace(0.55, 0.0, max(0, most + 1 - len(own))))
    colours = matplotlib.colors.ListedColormap([*own, *shades])
    return matplotlib.colors.BoundaryNorm(np.arange(most + 2) - 0.5, most + 1), colours


def _write_numbers(axes: Any, mesh: Any, cells: Any) -> None:
    rows, columns = cells.shape
    texts = {at: f"{cells[at]:.3g}" for at in np.ndindex(*cells.shape) if np.isfinite(cells[at])}
    longest = max(map(len, texts.values()), default=1)
    size = min(8.0, 360 / columns / (0.7 * longest), 280 / rows)
    for (i, j), text in texts.items():
        red, green, blue, _ = mesh.to_rgba(cells[i, j])
        is_dark = 0.3 * red + 0.6 * green + 0.1 * blue < 0.5
        axes.text(j + 0.5, i + 0.5, text, ha="center", va="center", fontsize=size,
                  color="white" if is_dark else "black")


@figure([[0]], height=3.4)
def histogram(runs: Table, axes: Any = None, column: str = "n_sub_impacts") -> Any:
    """How a number is distributed over the runs. Line: the mean; shaded: from the 5 % to the 95 % quantile;
    dotted: the median."""
    label, factor = _name_and_unit(column)
    values = factor * _numbers(runs, column)
    n_all, values = len(values), values[np.isfinite(values)]
    if column.startswith("n_") and np.ptp(values) < 60:
        edges: Any = np.arange(values.min(), values.max() + 2) - 0.5
    else:
        edges = int(np.clip(2 * np.sqrt(len(values)), 5, 40))
    low, middle, high = np.quantile(values, (0.05, 0.5, 0.95))
    axes.axvspan(low, high, color="#EAF2F8", linewidth=0, zorder=0)
    axes.hist(values, edges, color=COLOURS[5], edgecolor="white", linewidth=0.5)
    axes.axvline(values.mean(), color=COLOURS[1])
    axes.axvline(middle, color=COLOURS[6], linestyle=":")
    axes.set_title(f"{len(values)} of {n_all} runs; mean {values.mean():.4g}; 5 %: {low:.4g}, 95 %: {high:.4g}")
    axes.set(xlabel=label, ylabel="runs")
    for axis in (axes.yaxis, *([axes.xaxis] if column.startswith("n_") else [])):
        axis.set_major_locator(matplotlib.ticker.MaxNLocator(integer=True, min_n_ticks=1))


def _chief(runs: Table) -> Sequence[str]:
    """The columns of CHIEF that differ from run to run."""
    shown = [name for name in CHIEF if len(np.unique(known_numbers(runs, name))) > 1]
    return present(shown, "no number differs from run to run")


@figure(lambda runs: grid_of(len(_chief(runs)), min(len(_chief(runs)), 2), 2.4))
def histograms(runs: Table, axes: Any = None) -> Any:
    """How the chief numbers are distributed over the runs. Line: the mean; shaded: from the 5 %
    to the 95 % quantile; dotted: the median."""
    for panel, column in zip(np.ravel(axes), _chief(runs)):
        histogram(runs, panel, column)
