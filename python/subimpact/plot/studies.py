"""Figures of the tables of studies: work-precision and stability."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib
import numpy as np

from .style import COLOURS, GREY, figure, legend_above

Table = Mapping[str, Any]

#: Errors below, in us, cannot be told from that of the reference.
_LEAST_ERROR = 1e-5

VERDICTS = {"right": "#009E73", "wrong count": "#E69F00", "inaccurate": "#CC79A7", "unstable": "#D55E00",
            "failed": "#7A0019", "refused": "#56B4E9", "not run": "#D0D0D0"}
_WORDS = {"failed": "solver failed", "not run": "left out"}


def _unique(names: Any) -> list[str]:
    """In the order of the table."""
    return list(dict.fromkeys(names))


def _line(k: int) -> tuple[str, str]:
    """Colour and dashes of the k-th of many lines."""
    return COLOURS[k % len(COLOURS)], ("-", "--", ":")[k // len(COLOURS) % 3]


def _one_per_label(table: Table) -> tuple[Any, dict[str, Any]]:
    n = len(_unique(table["label"]))
    return [[*range(n)]], {"figsize": (2.2 + 2.6 * n, 4.4), "sharex": True, "sharey": True}


@figure(_one_per_label)
def work_precision(points: Table, axes: Any, cost: str = "wall_s") -> None:
    """Cost against the largest error of an event time. Filled: every sub-impact found; hollow: some lost or
    invented, and the error is at least the duration of the first of these; crosses at the right: unstable,
    or gave up."""
    methods = _unique(points["method"])
    panels = np.ravel(axes)
    longest = np.fmax(points["max_error_s"], points["odd_duration_s"])
    error = np.maximum(1e6 * longest, _LEAST_ERROR)
    scale, words = {"wall_s": (1e3, "wall time, ms")}.get(cost, (1.0, "evaluations of the right-hand side"))
    verdict = points["verdict"]
    finished = (verdict == "right") | (verdict == "wrong count")
    broken = ~finished & (verdict != "refused") & (verdict != "not run")
    edge = 10.0 ** np.ceil(np.log10(error[finished].max(initial=1.0)))
    for panel, label in zip(panels, _unique(points["label"])):
        panel.axvspan(edge, 50 * edge, color="#F0F0F0", linewidth=0)
        panel.text(18 * edge, 0.5, "failed", transform=panel.get_xaxis_transform(), rotation=90, va="center",
                   color="#606060")
        for k, method in enumerate(methods):
            of_line = (points["label"] == label) & (points["method"] == method) & (points[cost] > 0)
            colour, dashes = _line(k)
            for which, mark, face in ((finished, "", colour), (verdict == "right", "o", colour),
                                      (verdict == "wrong count", "o", "white"), (broken, "x", colour)):
                x, y = error[of_line & which], scale * points[cost][of_line & which]
                panel.plot(x if which is not broken else np.full(len(y), 3 * edge), y, color=colour, marker=mark,
                           linestyle="none" if mark else dashes, markerfacecolor=face,
                           label=None if mark else method)
        panel.set(xscale="log", yscale="log", title=label, xlabel="largest error of an event time, µs")
        panel.set_xlim(right=50 * edge)
        panel.minorticks_off()
    panels[0].set_ylabel(words)
    panels[-1].legend(loc="upper left", bbox_to_anchor=(1, 1))


@figure([[0, 1]], height=3.8)
def outcomes(table: Table, axes: Any) -> None:
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


@figure([[0]], height=3.8)
def missed_pairs(table: Table, axes: Any) -> None:
    """Strikes wholly found, over the step: sub-impacts and separations that begin and end within one
    step."""
    step, n, shortest = 1e6 * table["step_s"], table["runs"][0], 1e6 * table["shortest_s"][0]
    axes.semilogx(step, table["right_with_search"], "o-", label="pairs within a step looked for")
    axes.semilogx(step, table["right_without"], "s-", label="ends of steps only")
    axes.axvline(shortest, color=GREY, linestyle="--")
    axes.annotate("shortest sub-impact or separation", (shortest, 0.03), (-4, 0), rotation=90, ha="right",
                  xycoords=("data", "axes fraction"), textcoords="offset points", color="#606060", fontsize=8)
    axes.set(xlabel="step, µs", ylabel=f"strikes (of {n:g}) wholly found", ylim=(0, 1.1 * n))
    axes.xaxis.set_major_formatter("{x:g}")
    legend_above(axes)


@figure([[0]], height=3.8)
def layers(table: Table, axes: Any) -> None:
    """Event times with layers compared with those of the exact section law. Hollow: some sub-impacts lost
    or invented."""
    n = table["layers"]
    whole = (table["corresponding"] == table["sub_impacts"]) & (table["corresponding"] == table["exact_sub_impacts"])
    axes.loglog(n, 1e6 * table["max_difference_s"][-1] * (n[-1] / n) ** 2, "--", color=GREY,
                label="falling as 1/layers²")
    for name, label, mark, colour in (("max_difference_s", "largest", "o", COLOURS[0]),
                                      ("median_difference_s", "median", "s", COLOURS[1])):
        axes.loglog(n[whole], 1e6 * table[name][whole], mark, color=colour, label=label)
        axes.loglog(n[~whole], 1e6 * table[name][~whole], mark, color=colour, markerfacecolor="white")
    axes.set(xlabel="layers", ylabel="event times, layers − exact, µs")
    axes.set_xticks(n, [f"{k:g}" for k in n])
    axes.minorticks_off()
    legend_above(axes)
