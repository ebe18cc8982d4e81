"""Figures of the tables of studies: work-precision, stability, comparisons of methods and sensitivities."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import matplotlib
import numpy as np

from .style import COLOURS, GREY, figure

Table = Mapping[str, Any]

VERDICTS = {"right": "#009E73", "wrong count": "#E69F00", "inaccurate": "#CC79A7", "unstable": "#D55E00",
            "failed": "#7A0019", "refused": "#56B4E9", "not run": "#D0D0D0"}
_WORDS = {"failed": "solver failed", "not run": "left out"}


def _unique(names: Any) -> list[str]:
    """In the order of the table."""
    return list(dict.fromkeys(names))


def _labels(table: Table) -> Any:
    """One a row; not a number for a single case without one."""
    return np.array(["" if label != label else str(label) for label in table["label"]])


def _marked(k: int) -> dict[str, str]:
    """Colour and mark of the k-th of many curves; no two of 56 are alike."""
    return {"color": COLOURS[k % len(COLOURS)], "marker": "os^vDP*"[k % 7]}


def _one_per_label(table: Table) -> tuple[Any, dict[str, Any]]:
    n = len(_unique(_labels(table)))
    return [[*range(n)]], {"figsize": (2.6 + 3.2 * n, 5.2), "sharex": True, "sharey": True}


@figure(_one_per_label)
def work_precision(points: Table, axes: Any = None, cost: str = "wall_s") -> Any:
    """Cost against the largest error of an event time, with error control (solid) and at fixed steps (dashed, with the
    order observed last). Filled: every sub-impact found; hollow: below the error of the reference (grey), which alone is
    known; crosses: a sub-impact lost or invented, the error at least its duration; crosses at the right: unstable, or gave up."""
    methods, panels = _unique(points["method"]), np.ravel(axes)
    scale, words = {"wall_s": (1e3, "wall time, ms")}.get(cost, (1.0, "evaluations of the right-hand side"))
    verdict, error = points["verdict"], 1e6 * np.fmax(points["max_error_s"], points["odd_duration_s"])
    floor = 1e6 * points["reference_error_s"]
    finished = ((verdict == "right") | (verdict == "wrong count")) & (error > 0)
    broken = ~finished & (verdict != "refused") & (verdict != "not run")
    low = 10.0 ** np.floor(np.log10(min(error[finished].min(initial=1.0), floor.min())))
    edge = 10.0 ** np.ceil(np.log10(error[finished].max(initial=1e-6)))
    labels = _labels(points)
    for panel, label in zip(panels, _unique(labels)):
        here = labels == label
        panel.axvspan(edge, 50 * edge, color="#F0F0F0", linewidth=0)
        panel.axvspan(low, floor[here][0], color="#E4E4E4", linewidth=0)
        for x, said in ((18 * edge, "failed"), (1.3 * low, "below the error of the reference")):
            panel.text(x, 0.5, said, transform=panel.get_xaxis_transform(), rotation=90, va="center", color="#606060", fontsize=7)
        for method, kind in itertools.product(methods, ("rtol", "step")):
            of_line = here & (points["method"] == method) & (points["kind"] == kind) & (points[cost] > 0)
            marked = _marked(methods.index(method))
            shown = of_line & finished
            panel.plot(error[shown], scale * points[cost][shown], "-" if kind == "rtol" else "--", color=marked["color"], linewidth=0.9)
            right = of_line & finished & (verdict == "right")
            for which, look in ((right & (error > floor), marked), (right & (error <= floor), {**marked, "markerfacecolor": "white"}),
                                (shown & ~right, {**marked, "marker": "x"}), (of_line & broken, {**marked, "marker": "x"})):
                x = np.full(which.sum(), 3 * edge) if which[broken].any() else error[which]
                panel.plot(x, scale * points[cost][which], linestyle="none", **look)
            if (ordered := np.flatnonzero(of_line & (points["observed_order"] > 1.5))).size:  # less is rounding
                last = ordered[-1]
                panel.annotate(f"{points['observed_order'][last]:.1f}", (error[last], scale * points[cost][last]), (3, 3),
                               textcoords="offset points", color=marked["color"], fontsize=7)
        panel.set(xscale="log", yscale="log", title=label, xlabel="largest error of an event time, µs", xlim=(low, 50 * edge))
        panel.minorticks_off()
    panels[0].set_ylabel(words)
    lines = [matplotlib.lines.Line2D([], [], label=method, linewidth=0.9, **_marked(k)) for k, method in enumerate(methods)]
    kinds = [matplotlib.lines.Line2D([], [], color=GREY, linestyle=style, label=said)
             for style, said in (("-", "error control"), ("--", "fixed steps, order"))]
    panels[-1].legend(handles=lines + kinds, loc="upper left", bbox_to_anchor=(1, 1))


@figure([[0]], height=3.8)
def differences(matches: Table, axes: Any = None, reference_error: float = 0.0) -> Any:
    """How far starts (filled) and ends (hollow) of sub-impacts by each method lie from those of the reference, whose error
    is grey. Crosses at the top: sub-impacts that the method lacks, or has alone."""
    methods = _unique(matches["method"])
    for k, method in enumerate(methods):
        rows, marked = matches["method"] == method, _marked(k)
        for event, face in (("start", marked["color"]), ("end", "white")):
            x, y = 1e3 * matches[f"reference_{event}_s"][rows], 1e6 * np.abs(matches[f"{event}_difference_s"][rows])
            axes.plot(x[y > 0], y[y > 0], linestyle="none", markerfacecolor=face, label=method if event == "start" else None, **marked)
        odd = rows & ~np.isfinite(matches["start_difference_s"])
        at = 1e3 * np.fmin(matches["reference_start_s"], matches["start_s"])[odd]
        axes.plot(at, np.full(len(at), 1.02 + 0.03 * k), "x", color=marked["color"], transform=axes.get_xaxis_transform(), clip_on=False)
    axes.set(yscale="log", xlabel="time, ms", ylabel="difference to the reference, µs")
    axes.axhspan(axes.get_ylim()[0], 1e6 * reference_error, color="#E4E4E4", linewidth=0, zorder=0)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))


@figure([[0]], height=4.4)
def sensitivity(table: Table, axes: Any = None) -> Any:
    """Changes of starts and ends of sub-impacts per 1 % more of each key, with their errors; the first touch has none."""
    keys = [name[2:] for name in getattr(getattr(table, "dtype", None), "names", None) or table if name.startswith("d_")]
    times = np.isin(table["quantity"], ("start_s", "end_s")) & (table["value"] > 0)
    for k, key in enumerate(keys):
        axes.errorbar(1e3 * table["value"][times], 1e4 * table[f"d_{key}"][times], 1e4 * table[f"error_{key}"][times], label=key,
                      linewidth=0.7, **_marked(k))
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set(xlabel="start or end of a sub-impact, ms", ylabel="change per 1 %, µs")
    axes.set_yscale("symlog", linthresh=1.0)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))


@figure([[0, 1]], height=3.8)
def outcomes(table: Table, axes: Any = None) -> Any:
    """How runs come out, by method and by step or tolerance."""
    for panel, group in zip(axes, ("fixed step", "tolerance")):
        of_group = table["group"] == group
        rows, settings = _unique(table["row"][of_group]), _unique(table["omega_h_or_rtol"][of_group])
        for row, setting, verdict in zip(*(table[name][of_group] for name in ("row", "omega_h_or_rtol", "verdict"))):
            panel.barh(rows.index(row), 0.92, 0.88, left=settings.index(setting) - 0.46, color=VERDICTS[verdict])
        panel.set(title="fixed step" if group == "fixed step" else "error control",
                  xlabel="$ω_{max} h$" if group == "fixed step" else "relative tolerance")
        panel.set_xticks(range(len(settings)), [f"{s:g}" for s in settings], rotation=60)
        panel.set_yticks(range(len(rows)), [row.replace(";", ",") for row in rows], fontsize=7)
        panel.tick_params(length=0)
        panel.invert_yaxis()
        panel.grid(False)
        panel.spines[:].set_visible(False)
    patches = [matplotlib.patches.Patch(color=colour, label=_WORDS.get(verdict, verdict))
               for verdict, colour in VERDICTS.items()]
    axes[1].legend(handles=patches, loc="upper left", bbox_to_anchor=(1, 1), handlelength=1)
