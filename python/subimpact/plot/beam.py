"""Figures along the beam, of its sections, and of repeated strikes."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np

from ..result import Result
from .style import COLOURS, GREY, Absent, figure, grid_of, legend_above, present, unit

_MOST_SECTIONS = 24
_N_SHAPES = 7
_NO_SHAPES = "the run kept no shapes; run it again with output.shapes above 0, or without it"


def _bending_stiffness(table: Any) -> float:
    """E I, from the row of the largest moment: M = E I (kappa - plastic part)."""
    row = table[np.argmax(np.abs(table["moment_Nm"]))]
    elastic = row["curvature_per_m"] - row["plastic_curvature_per_m"]
    return float(row["moment_Nm"] / elastic) if elastic else 0.0


def _sections(result: Result) -> Any:
    return present(result.sections, "the run kept the bending of no section; run it again with --set output.sections=0.5 "
                   "(or more positions, as fractions of the length)")


def _panels(result: Result) -> tuple[Any, dict[str, Any]]:
    _sections(result)
    n = min(len(result["output.sections"]), _MOST_SECTIONS)
    return grid_of(n, 3 if n > 4 else min(n, 2), 2.6, 3.8)


@figure(_panels)
def bending(result: Result, axes: Any = None) -> Any:
    """Bending moment against curvature of the sections kept over the whole run, in units of first yield
    where the beam can yield. Dots: end of the run."""
    table, n = _sections(result), len(result["output.sections"])
    limit = result.summary["used"]["yield_curvature_per_m"]
    moment = _bending_stiffness(table) * limit if limit else 1.0
    panels = np.ravel(axes)
    columns = 3 if len(panels) > 4 else 2
    for k, panel in enumerate(panels):
        line = table[k::n]
        x, y = line["curvature_per_m"] / (limit or 1.0), line["moment_Nm"] / moment
        panel.plot(x, y, color=COLOURS[k % len(COLOURS)], linewidth=0.8)
        panel.plot(x[-1], y[-1], "ko")
        panel.set_title(f"$x = {line['position_m'][0] / result['beam.length']:.3g}\\,l$")
        panel.set(xlabel="curvature, $κ/κ_y$" if limit else "curvature, 1/m")
        if k % columns == 0:
            panel.set_ylabel("moment, $M/M_y$" if limit else "moment, N m")
    if n > len(panels):
        panels[-1].figure.text(0, 0, f"not shown: sections {len(panels) + 1} to {n}", color=GREY)


def _along_beam(result: Result, table: Any) -> Any:
    if result["beam.fixed"]:
        raise Absent("the plane does not move")
    return present(table, _NO_SHAPES)


@figure([[0], [1]], height=5.6, sharex=True)
def shapes(result: Result, axes: Any = None) -> Any:
    """Displacement and bending moment along the whole beam at some instants of the run, from dark to
    light."""
    table = _along_beam(result, result.shapes)
    rows = table.reshape(-1, result.summary["used"]["n_shape_points"])
    times = rows["time_s"][:, 0]
    wanted = times[-1] * np.arange(1, _N_SHAPES + 1) / _N_SHAPES
    shown = np.unique([np.argmin(np.abs(times - time)) for time in wanted])
    time_unit, t = unit("time", result.time)
    length_unit, d = unit("length", table["displacement_m"])
    top, bottom = axes
    colours = matplotlib.colormaps["viridis"](np.linspace(0, 0.88, len(shown)))
    for row, colour in zip(rows[shown], colours):
        top.plot(row["position_m"], d * row["displacement_m"], color=colour,
                 label=f"{t * row['time_s'][0]:.3g} {time_unit}")
        bottom.plot(row["position_m"], row["moment_Nm"], color=colour)
    top.set(ylabel=f"displacement, {length_unit}", xlim=(0, result["beam.length"]))
    bottom.set(ylabel="bending moment, N m", xlabel="position along the beam, m")
    for panel in axes:
        panel.axhline(0, color=GREY, linewidth=0.6)
    legend_above(top)


@figure([[0], [1], [2]], height=7.2, sharex=True)
def envelope(result: Result, axes: Any = None) -> Any:
    """Envelope of the run along the beam: largest and smallest bending moment (dashed: first yield),
    strain of the outer fibre (cut off at six times first yield) and displacement; of a beam that has
    yielded, in its place the permanent set, its displacement at rest against its supports, of a free one
    against its chord. Shaded: plastic zones."""
    table = _along_beam(result, result.envelope)
    x, zones = table["position_m"], result.summary["rest"]["plastic_zones"]
    if result.summary["verdict"]["beam"] == "turned_too_far":  # its numbers are no result
        zones = []
    limit = result.summary["used"]["yield_curvature_per_m"]
    strain = 1e3 * (result["beam.yield_stress"] or np.nan) / result["beam.youngs_modulus"] if zones else np.nan
    moment = _bending_stiffness(result.shapes) * limit if zones and limit else np.nan
    length_unit, d = unit("length", *([table["set_against_supports_m"]] if zones else
                                      [table["max_displacement_m"], table["min_displacement_m"]]))
    rows = [("moment_Nm", 1.0, "bending moment, N m", moment), ("strain", 1e3, "outer strain, $10^{-3}$", strain),
            ("displacement_m", d, f"displacement, {length_unit}", np.nan)]
    for panel, (name, factor, label, bound) in zip(axes, rows):
        for zone in zones:
            panel.axvspan(zone["from_m"], zone["to_m"], color="#FBE6BE", linewidth=0, zorder=0,
                          label="plastic zones" if zone is zones[0] else None)
        if zones and name == "displacement_m":
            panel.plot(x, d * table["set_against_supports_m"], color=COLOURS[2])
            label = f"permanent set, {length_unit}"
        else:
            panel.plot(x, factor * table["max_" + name], label="largest")
            panel.plot(x, factor * table["min_" + name], label="smallest")
        for sign in (1, -1) if np.isfinite(bound) else ():
            panel.axhline(sign * bound, color="#606060", linestyle="--", linewidth=0.8,
                          label="first yield" if sign > 0 else None)
        panel.axhline(0, color=GREY, linewidth=0.6)
        panel.set(ylabel=label)
    if zones:
        low, high = axes[1].get_ylim()
        axes[1].set_ylim(max(low, -6 * strain), min(high, 6 * strain))
        if (largest := 1e3 * np.nanmax(np.abs([table["max_strain"], table["min_strain"]]))) > 6 * strain:
            axes[1].set_title(f"cut off: up to {largest:.2g}", loc="right")
    axes[0].set_xlim(0, result["beam.length"])
    axes[2].set_xlabel("position along the beam, m")
    legend_above(axes[0])


@figure([[0], [1], [2]], height=6.4, sharex=True)
def strikes(result: Result, axes: Any = None) -> Any:
    """Strike after strike, at the end of each: restitution; dent and permanent set of all strikes so far;
    energy that the strike has dissipated in bending and in the contact. Bars: errors, where they are
    known, cut off where they are larger than the values."""
    table = present(result.strikes, "the beam was struck once; run it again with repeat.strikes above 1")
    top, middle, bottom = axes
    n = table["strike"]
    if np.isfinite(table["restitution"]).any():
        top.errorbar(n, table["restitution"], np.nan_to_num(table["restitution_error"]), fmt="o-", elinewidth=0.8)
        top.set_ylim(min(0.0, np.nanmin(table["restitution"])), 1.2 * np.nanmax(table["restitution"]))
    else:
        top.text(0.5, 0.5, "in contact at the end of every strike", ha="center", transform=top.transAxes)
        top.set_yticks([])
    top.set_ylabel("restitution")
    dent_unit, d = unit("length", table["dent_m"])
    set_unit, w = unit("length", table["permanent_set_m"])
    right = middle.twinx()
    middle.plot(n, d * table["dent_m"], "o-", color=COLOURS[0])
    right.errorbar(n, w * table["permanent_set_m"], np.nan_to_num(w * table["permanent_set_error_m"]),
                   fmt="s-", color=COLOURS[1], elinewidth=0.8, markerfacecolor="white")
    for panel, label, colour, largest in ((middle, f"dent, {dent_unit}", COLOURS[0], d * table["dent_m"].max()),
                                          (right, f"permanent set, {set_unit}", COLOURS[1],
                                           w * table["permanent_set_m"].max())):
        panel.set_ylabel(label, color=colour)
        panel.set_ylim(0, 1.1 * largest or 1.0)
    right.grid(False)
    bottom.plot(n, table["bending_J"], "o-", color=COLOURS[2], label="bending")
    bottom.plot(n, table["contact_J"], "s-", color=COLOURS[3], label="contact", markerfacecolor="white")
    bottom.set(xlabel="strike", ylabel="dissipated, J", xlim=(0.5, len(n) + 0.5))
    bottom.set_ylim(bottom=0)
    bottom.xaxis.get_major_locator().set_params(integer=True)
    legend_above(bottom)
