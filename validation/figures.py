#!/usr/bin/env python3
"""Draws the figures of studies from their tables, with the Python package of the build.

    validation/figures.py NAME TABLE [FILE]     mesh, grazes, scatter or peers; FILE: without its ending
    validation/figures.py stability DIR         critical_steps, stiff_contact, damping, missed_pairs and layers of a
                                                directory, in it
    validation/figures.py hysteresis FILE       the law of bending of docs/theory.md
"""

import sys
from pathlib import Path

import matplotlib.ticker
import numpy as np

matplotlib.use("Agg")

from subimpact import plot  # noqa: E402
from subimpact.plot.style import COLOURS, GREY, legend_above  # noqa: E402

KINDS = {"cells": "cells", "without_hinges": "elements without hinges", "elements": "elements",
         "graded": "graded elements"}


def lines(axes, table, key, x, y, names, of_panel=True):
    """A line for each of these values of a column; those of this program are thick."""
    for k, name in enumerate(names):
        rows = (table[key] == name) & of_panel
        ours = "ours" in table and table["ours"][table[key] == name][0] > 0
        axes.plot(table[x][rows], table[y][rows], "osv^D"[k % 5] + ("-", "--", ":")[k // len(COLOURS) % 3],
                  color=COLOURS[k % len(COLOURS)], linewidth=2 if ours else 0.9, label=KINDS.get(name, name))


@plot.figure([[0, 1]], height=3.6, sharex=True, sharey=True)
def mesh(table, axes):
    for panel, section, title in zip(axes, ("elastic", "exact"), ("elastic sections", "sections that yield (exact)")):
        lines(panel, table, "mesh", "unknowns", "max_error_us", KINDS, table["section"] == section)
        for bound in (1, 0.1):
            panel.axhline(bound, color=GREY, linestyle="--", linewidth=0.8)
        panel.set(xscale="log", yscale="log", title=title, xlabel="unknowns of the half model")
        panel.set_xticks([100, 200, 500, 1000, 2000], ["100", "200", "500", "1000", "2000"])
        panel.minorticks_off()
    axes[0].set_ylabel("largest error of a start or end, µs")
    axes[1].legend(loc="lower left")


@plot.figure([[0]], height=3.6)
def grazes(table, axes):
    lines(axes, table, "finder", "depth", "percent", dict.fromkeys(table["finder"]))
    axes.set(xscale="log", xlabel="depth of the graze over the amplitude", ylabel="grazes found with both events, %")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))


def panels_of(column):
    return lambda table: ([[*range(len(set(table[column])))]], {"figsize": (11, 4.6), "sharex": True, "sharey": True})


@plot.figure(panels_of("scene"))
def peers(table, axes):
    axes = np.ravel(axes)
    for panel, scene in zip(axes, dict.fromkeys(table["scene"])):
        lines(panel, table, "contestant", "error_us", "seconds", dict.fromkeys(table["contestant"]),
              table["scene"] == scene)
        panel.set(xscale="log", yscale="log", title=scene.replace("-", " "))
        panel.xaxis.set_major_locator(matplotlib.ticker.LogLocator(numticks=4))
        panel.minorticks_off()
    axes[0].set_ylabel("processor time, s")
    axes[len(axes) // 2].set_xlabel("largest error of an event time, µs")
    axes[-1].legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=7)


@plot.figure(lambda table: ([[k] for k in range(len(set(table["title"])))], {"figsize": (7.2, 7.6), "sharex": True}))
def scatter(table, axes):
    for panel, title in zip(axes, dict.fromkeys(table["title"])):
        def of(what):
            rows = (table["title"] == title) & (table["what"] == what)
            return table["x"][rows], table["y"][rows]

        panel.fill_between(*of("share"), color=COLOURS[5], linewidth=0, label="share of the runs that are in contact")
        starts, ends = of("contact")
        panel.broken_barh(list(zip(starts, ends - starts)), (103, 8), color="#404040", clip_on=False,
                          label="contacts of the strike as given")
        (horizon,), (number,) = of("horizon")
        panel.axvline(horizon, color=COLOURS[1], label=f"predictable one by one up to here: {number:g} contacts")
        panel.set_title(title, pad=14)
        panel.set(ylabel="in contact, %", ylim=(0, 100))
        panel.legend(loc="upper right")
    axes[-1].set_xlabel("time, ms")


def line(k):
    """Colour and dashes of the k-th of many lines."""
    return COLOURS[k % len(COLOURS)], ("-", "--", ":")[k // len(COLOURS) % 3]


@plot.figure([[0, 1, 2]], height=4.0, sharey=True)
def critical_steps(table, axes):
    """The largest stable step of explicit methods over the number of cells: lines predicted, points
    measured."""
    methods = dict.fromkeys(table["method"])
    for panel, theory, title in zip(axes, ("rayleigh", "euler-bernoulli", "timoshenko"),
                                    ("Rayleigh", "without rotary inertia", "with shear")):
        for k, method in enumerate(methods):
            rows = (table["theory"] == theory) & (table["method"] == method)
            colour, dashes = line(k)
            cells = table["segments"][rows]
            panel.plot(cells, 1e6 * table["predicted_s"][rows], dashes, color=colour, label=method)
            panel.plot(cells, 1e6 * table["measured_s"][rows], "o", color=colour)
        panel.set(xscale="log", yscale="log", title=title, xlabel="cells")
        sizes = np.unique(table["segments"])
        panel.set_xticks(sizes, [f"{n:g}" for n in sizes])
        panel.minorticks_off()
    axes[0].set_ylabel("largest stable step, µs")
    axes[2].legend(loc="upper left", bbox_to_anchor=(1, 1))


@plot.figure([[0]], height=3.8)
def stiff_contact(table, axes):
    """The largest stable step of central differences while a spring holds the striker in contact."""
    x = table["stiffness_N_per_m"]
    axes.semilogx(x, 1e6 * table["beam_only_s"], "--", color=COLOURS[6], label="beam alone")
    axes.semilogx(x, 1e6 * table["predicted_s"], label="beam, contact and striker: predicted")
    axes.semilogx(x, 1e6 * table["measured_s"], "o", label="measured")
    axes.set(xlabel="contact stiffness, N/m", ylabel="largest stable step, µs")
    axes.set_ylim(bottom=0)
    legend_above(axes)


@plot.figure([[0, 1]], height=3.8)
def damping(tables, axes):
    """What methods leave of an oscillation in one step: implicit tables, and the growth by backward
    differentiation, above 1 where an oscillation grows."""
    left, growth = tables
    for k, method in enumerate(dict.fromkeys(left["method"])):
        rows = left["method"] == method
        colour, dashes = line(k)
        axes[0].semilogx(left["omega_h"][rows], left["predicted"][rows], dashes, color=colour,
                         label=method.partition(":")[2] or method)
        axes[0].semilogx(left["omega_h"][rows], left["measured"][rows], "o", color=colour, markersize=3)
    axes[0].set(title="implicit tables: lines predicted, points measured", ylabel="amplitude left by one step",
                ylim=(0, 1.05))
    axes[1].axhline(1, color=GREY, linestyle="--", linewidth=0.8)
    for order in np.unique(growth["order"]):
        rows = growth["order"] == order
        axes[1].semilogx(growth["omega_h"][rows], growth["growth"][rows], label=f"order {order:g}")
    axes[1].set(title="BDF: above 1 an oscillation grows", ylabel="growth per step", ylim=(0.7, 1.15))
    for panel in axes:
        panel.set(xlabel="$ω h$", xlim=(0.1, 100))
        panel.legend()


@plot.figure([[0]], height=3.8)
def missed_pairs(table, axes):
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


@plot.figure([[0]], height=3.8)
def layers(table, axes):
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


def virgin(x):
    """Moment over that of first yield, of the curvature over that of first yield, in a rectangle."""
    return np.where(np.abs(x) <= 1, x, np.sign(x) * (1.5 - 0.5 / np.maximum(np.abs(x), 1) ** 2))


@plot.figure([[0]], height=4.2)
def hysteresis(_, axes):
    def branch(start, end, at=(0.0, 0.0), scale=2.0, **options):
        x = np.linspace(start, end, 200)
        y = at[1] + scale * virgin((x - at[0]) / scale)
        axes.plot(x, y, **options)
        return end, float(y[-1])

    blue, red, green = COLOURS[:3]
    one = branch(0, 3, scale=1.0, color=blue)
    two = branch(3, -0.8, one, color=red)
    branch(-0.8, -1.7, one, color=red, linestyle="--")
    three = branch(-0.8, 2.1, two, color=green)
    branch(2.1, -0.8, three, color=green, linestyle="--")
    for point, name, offset in ((one, "1", (6, 4)), (two, "2", (-10, -10)), (three, "3", (6, -8)),
                                ((1, 1), "first yield", (-52, 3))):
        axes.plot(*point, "ko")
        axes.annotate(name, point, offset, textcoords="offset points")
    axes.text(1.2, 1.48, "virgin curve $f$")
    axes.text(1.15, -0.55, "branch from 1")
    axes.annotate("", (1, 0.12), (3, 0.12), arrowprops={"arrowstyle": "<->", "color": GREY})
    axes.text(2.75, 0.18, "$2\\,κ_y$: nothing flows", color="#606060", fontsize=8)
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.axvline(0, color=GREY, linewidth=0.6)
    axes.set(xlabel="curvature, $κ/κ_y$", ylabel="moment, $M/M_y$", xlim=(-2, 4.2), ylim=(-1.45, 1.9))


def main(name, source, target=None):
    if name == "stability":
        table = {file.stem: plot.read_table(file) for file in Path(source).glob("*.csv")}
        for draw in (critical_steps, stiff_contact, missed_pairs, layers):
            plot.save(draw(table[draw.__name__]), Path(source) / draw.__name__, ("svg",))
        plot.save(damping((table["damping"], table["bdf_growth"])), Path(source) / "damping", ("svg",))
        return
    if name == "hysteresis":
        plot.save(hysteresis(None), source, ("svg",))
        return
    draw = {"mesh": mesh, "grazes": grazes, "peers": peers, "scatter": scatter}[name]
    target = Path(target or Path(source).with_suffix(""))
    plot.save(draw(plot.read_table(source)), target, ("png",) if name == "scatter" else ("svg",))


if __name__ == "__main__":
    main(*sys.argv[1:])
