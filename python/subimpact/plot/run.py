"""Figures of a run over time."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..result import Result
from .style import COLOURS, CONTACT, DOUBT, bands, figure, legend_above, present, unit

_MOST_INSETS = 3
_MOST_ZONES = 4


def _history(result: Result) -> Any:
    return present(result.history, "the run kept no history; run it again with output.interval above 0")


def _ends(result: Result) -> Any:
    """When sub-impacts end, s: in contact to the last, at the end of the run."""
    return np.nan_to_num(result.sub_impacts["end_s"], nan=result.time)


def _shade(axes: Any, result: Result, scale: float) -> None:
    """The sub-impacts as bands, hatched where they are not certain."""
    hits, ends = result.sub_impacts, _ends(result)
    doubtful = hits["certain"] == 0
    if not doubtful.all():
        bands(axes, scale * hits["start_s"][~doubtful], scale * ends[~doubtful], CONTACT,
              label="sub-impacts, certain" if doubtful.any() else "sub-impacts")
    if doubtful.any():
        bands(axes, scale * hits["start_s"][doubtful], scale * ends[doubtful], "none", hatch="//////",
              edgecolor=DOUBT, label="not certain")


@figure([[0]], height=2.8)
def force(result: Result, axes: Any = None) -> Any:
    """Contact force over time. Shaded: sub-impacts, hatched where they are not certain."""
    history = _history(result)
    time_unit, t = unit("time", result.time)
    force_unit, f = unit("force", history["force_N"])
    _shade(axes, result, t)
    axes.plot(t * history["time_s"], f * history["force_N"], linewidth=0.8)
    axes.set(xlabel=f"time, {time_unit}", ylabel=f"contact force, {force_unit}", xlim=(0, t * result.time))
    axes.set_ylim(bottom=0)
    if len(result.sub_impacts):
        legend_above(axes)


@figure([[0]], height=2.8)
def gauges(result: Result, axes: Any = None) -> Any:
    """Strain of every gauge over time, positive in tension. Shaded: sub-impacts, hatched where they are not certain."""
    history = _history(result)
    places = present(result["output.gauges"], "the run has no gauge; run it again with output.gauges, such as "
                     "[{ position = 0.3, face = \"back\" }]")
    time_unit, t = unit("time", result.time)
    _shade(axes, result, t)
    lines = [axes.plot(t * history["time_s"], 1e6 * history[f"gauge_{k}_strain"], linewidth=0.8,
                       label=f"{place['face']}, {place['position'] * result['beam.length']:.4g} m")[0]
             for k, place in enumerate(places, 1)]
    axes.set(xlabel=f"time, {time_unit}", ylabel="strain, µm/m", xlim=(0, t * result.time))
    legend_above(axes, lines)


@figure([[0], [1]], height=5.2, sharex=True)
def response(result: Result, axes: Any = None) -> Any:
    """Contact force and displacements over the strike: w_c of the struck point, w_m of the striker or
    stop, f_c = w_c − w(0) the beam's deflection at the struck point. Shaded: sub-impacts, hatched where
    they are not certain."""
    top, bottom = axes
    force(result, top)
    top.set_xlabel("")
    history = result.history
    time_unit, t = unit("time", result.time)
    length_unit, d = unit("length", history["w_c_m"], history["w_m_m"])
    body = "stop" if result["striker.fixed"] else "striker"
    _shade(bottom, result, t)
    for name, label, line, width in (("w_c_m", "struck point $w_c$", "-", 2.4), ("w_m_m", f"{body} $w_m$", "--", 1.2),
                                     ("f_c_m", "deflection $f_c$", "-", 1.0)):
        bottom.plot(t * history["time_s"], d * history[name], line, label=label, linewidth=width)
    bottom.set(xlabel=f"time, {time_unit}", ylabel=f"displacement, {length_unit}")
    legend_above(bottom, bottom.lines)


@figure([[0], [1]], height=5.0, sharex=True)
def first_sub_impact(result: Result, axes: Any = None) -> Any:
    """Contact force, and stress in the outermost fibre behind the struck point, in the first sub-impact
    (shaded). Broken lines: the yield stress and the instant at which a fibre of the beam first yields."""
    history = _history(result)
    end = float(_ends(result)[0]) if len(result.sub_impacts) else result.time
    shown = min(1.08 * end, result.time)
    part = history[history["time_s"] <= shown]
    time_unit, t = unit("time", shown)
    force_unit, f = unit("force", part["force_N"])
    top, bottom = axes
    top.plot(t * part["time_s"], f * part["force_N"])
    top.set(ylabel=f"contact force, {force_unit}", xlim=(0, t * shown))
    top.set_ylim(bottom=0)
    stress = 1e-6 * part["stress_back_Pa"]
    bottom.plot(t * part["time_s"], stress, color=COLOURS[1])
    bottom.set(xlabel=f"time, {time_unit}", ylabel="back stress, MPa")
    for panel in axes:
        bands(panel, [0.0], [t * end], CONTACT)
    limit = 1e-6 * (result["beam.yield_stress"] or np.inf)
    for bound in (limit, -limit):
        if np.max(stress / bound, initial=0.0) > 0.5:
            bottom.axhline(bound, color="#404040", linestyle="--", linewidth=0.8)
            bottom.annotate(f"yield stress, {bound:.4g} MPa", (1, bound), (-2, np.copysign(3, bound)),
                            xycoords=("axes fraction", "data"), textcoords="offset points", ha="right",
                            va="bottom" if bound > 0 else "top")
    bottom.margins(y=0.16)
    first = result.summary["first_yield"]["section_s"]
    if first is not None and first <= shown:
        for panel in axes:
            panel.axvline(t * first, color="#404040", linestyle=":")
        top.annotate(f"first fibre yields, {t * first:.3g} {time_unit}", (t * first, 0.05), (4, 0),
                     xycoords=("data", "axes fraction"), textcoords="offset points")


def _yielding_again(result: Result) -> Any:
    """Indices of the later sub-impacts that deepen the dent most, in order of time."""
    growth = np.diff(result.sub_impacts["residual_indentation_m"])
    deepest = np.argsort(-growth, kind="stable")[:_MOST_INSETS]
    return np.sort(deepest[growth[deepest] > 0.0]) + 1


def _with_insets(result: Result) -> tuple[Any, dict[str, Any]]:
    n = len(_yielding_again(result))
    if not n:
        return [[0]], {}
    return [[0, 1 + k] for k in range(n)], {"gridspec_kw": {"width_ratios": [2.2, 1]}}


@figure(_with_insets, height=4.4)
def indentation(result: Result, axes: Any = None) -> Any:
    """Contact force against indentation: the whole strike, with the first yield of the contact (A) and
    the beginning of unloading (B) in the first sub-impact; beside it the later sub-impacts, three at
    most, that deepen the dent most."""
    history, hits, ends = _history(result), result.sub_impacts, _ends(result)
    force_unit, f = unit("force", history["force_N"])
    length_unit, d = unit("length", hits["max_indentation_m"])
    main, *insets = axes if isinstance(axes, (list, np.ndarray)) else [axes]

    def part(from_hit: int, to_hit: int) -> tuple[Any, Any]:
        times = history["time_s"]
        rows = history[(times >= hits["start_s"][from_hit]) & (times <= ends[to_hit])]
        return d * rows["indentation_m"], f * rows["force_N"]

    if len(hits) > 1:
        main.plot(*part(1, -1), color="#A0A0A0", linewidth=0.7, label="later sub-impacts")
    if len(hits):
        main.plot(*part(0, 0), label="first sub-impact")
        legend_above(main)
    for kind, words, offset, side in (("contact_yields", "A: contact yields", (7, -3), "left"),
                                      ("contact_unloads", "B: unloading begins", (-7, 5), "right")):
        found = result.transitions[result.transitions["kind"] == kind]
        if len(hits) and len(found) and found["time_s"][0] <= ends[0]:
            row = history[np.searchsorted(history["time_s"], found["time_s"][0])]
            at = d * found["value"][0], f * row["force_N"]
            main.plot(*at, "ko")
            main.annotate(words, at, offset, textcoords="offset points", ha=side)
    main.set(xlabel=f"indentation, {length_unit}", ylabel=f"contact force, {force_unit}")
    main.set_xlim(0, 1.06 * d * np.max(hits["max_indentation_m"], initial=1e-9))
    main.set_ylim(bottom=0)
    for k, (hit, inset) in enumerate(zip(_yielding_again(result), insets)):
        inset.plot(*part(hit, hit), color=COLOURS[1 + k])
        low, high = hits["residual_indentation_m"][hit - 1], hits["max_indentation_m"][hit]
        inset.set_xlim(d * low - 0.1 * d * (high - low), d * high + 0.1 * d * (high - low))
        inset.set_title(f"no. {hit + 1}, at {1e3 * hits['start_s'][hit]:.4g} ms")
        inset.set(ylabel=force_unit, xlabel=f"indentation, {length_unit}" if k + 1 == len(insets) else "")


@figure([[0], [1], [2]], height=6.2, sharex=True, gridspec_kw={"height_ratios": [0.22, 1, 0.75]})
def energies(result: Result, axes: Any = None) -> Any:
    """Energies, and the motion of striker or stop (u_mf = w_m − w(0)) and struck point (f_c = w_c − w(0))
    relative to the beam's end. Above: zones, sub-zones and sub-impacts, pale where they are not certain;
    zones are shaded."""
    history, hits, ends = _history(result), result.sub_impacts, _ends(result)
    time_unit, t = unit("time", result.time)
    strip, top, bottom = axes
    for level, colour, keys in ((2, "#E3E3E3", ("zone",)), (1, "#BDBDBD", ("zone", "subzone"))):
        _, first, last = np.unique(hits[list(keys)], return_index=True, return_inverse=True)
        for k, begin in enumerate(first):
            span = hits["start_s"][begin], ends[last == k][-1]
            bands(strip, [t * span[0]], [t * span[1]], colour, level / 3 + 0.02, 0.29)
            if span[1] - span[0] > 0.012 * result.time:
                strip.text(t * sum(span) / 2, level + 0.5, hits[keys[-1]][begin], ha="center", va="center")
            for panel in (top, bottom) if level == 2 else ():
                bands(panel, [t * span[0]], [t * span[1]], "#F0F0F0")
    for doubtful, colour in ((False, COLOURS[4]), (True, "#F6DDAA")):
        which = (hits["certain"] == 0) == doubtful
        bands(strip, t * hits["start_s"][which], t * ends[which], colour, 0.02, 0.29)
    strip.set_ylim(0, 3)
    strip.set_yticks([2.5, 1.5, 0.5], ["zones", "sub-zones", "sub-impacts"])
    strip.tick_params(length=0)
    strip.grid(False)
    strip.spines[:].set_visible(False)
    striker = "stop" if result["striker.fixed"] else "striker"
    energy_unit, e = unit("energy", result.summary["used"]["initial_energy_J"])
    for name, label in (("U_m_J", f"{striker} $U_m$"), ("U_k_J", "beam, kinetic $U_k$"),
                        ("U_e_J", "bending, elastic $U_e$"), ("U_p_J", "bending, plastic $U_p$"),
                        ("D_c_J", "contact, plastic $D_c$"), ("D_b_J", "damping $D_b$")):
        if name != "D_b_J" or np.any(history[name] > 0.0):
            top.plot(t * history["time_s"], e * history[name], label=label)
    top.set(ylabel=f"energy, {energy_unit}", xlim=(0, t * result.time))
    top.set_ylim(bottom=0)
    legend_above(top, columns=3)
    length_unit, d = unit("length", history["f_c_m"], history["u_mf_m"])
    bottom.plot(t * history["time_s"], d * history["f_c_m"], label="struck point $f_c$")
    bottom.plot(t * history["time_s"], d * history["u_mf_m"], "--", label=f"{striker} $u_{{mf}}$")
    bottom.set(ylabel=f"deformation, {length_unit}", xlabel=f"time, {time_unit}")
    legend_above(bottom)


def _zones(result: Result) -> list[tuple[str, Any]]:
    """Titles and sub-impacts of the columns of the timeline: one a zone, or one for all of many."""
    hits = result.sub_impacts
    numbers = np.unique(hits["zone"])
    if not 0 < len(numbers) <= _MOST_ZONES:
        return [(f"zones 1 to {numbers[-1]}" if len(numbers) else "no sub-impact", hits["zone"] > 0)]
    return [(f"zone {number}", hits["zone"] == number) for number in numbers]


def _span(result: Result, which: Any) -> tuple[float, float]:
    if not which.any():
        return 0.0, result.time
    return float(result.sub_impacts["start_s"][which][0]), float(_ends(result)[which][-1])


def _columns(result: Result) -> tuple[Any, dict[str, Any]]:
    n = len(_zones(result))
    return [[*range(n)], [*range(n, 2 * n)]], {"gridspec_kw": {"width_ratios": _widths(result)}}


def _widths(result: Result) -> Any:
    lengths = np.array([np.subtract(*_span(result, which)[::-1]) for _, which in _zones(result)])
    shares = np.maximum(lengths / lengths.sum(), 0.15)
    return shares / shares.sum()


@figure(_columns, height=5.0)
def timeline(result: Result, axes: Any = None) -> Any:
    """Every sub-impact at the time it begins: duration and impulse, on logarithmic axes; numbers count
    the sub-impacts. Pale with open circles: not certain. Black bars: numerical errors of those that are
    certain."""
    hits, ends, zones = result.sub_impacts, _ends(result), _zones(result)
    time_unit, t = unit("time", result.time)
    axes, widths = np.reshape(axes, (2, len(zones))), _widths(result)
    duration = 1e6 * (ends - hits["start_s"])
    rows = ((duration, 1e6 * (hits["start_error_s"] + hits["end_error_s"]), COLOURS[0], "#8CBEDF", "duration, µs"),
            (1e3 * hits["impulse_Ns"], 1e3 * hits["impulse_error_Ns"], COLOURS[1], "#EFB58C", "impulse, mN s"))
    for row, (values, errors, dark, pale, label) in enumerate(rows):
        shown = values[values > 0]
        limits = (0.5 * shown.min(), 3 * shown.max()) if len(shown) else (0.1, 10)
        decades = np.floor(np.log10(limits))
        if decades[0] == decades[1] or decades[0] + 1 == decades[1]:  # fewer than two labelled ticks
            limits = (10.0 ** decades[0], 10.0 ** (decades[1] + 1))
        for column, (title, of_zone) in enumerate(zones):
            panel = axes[row, column]
            start, end = _span(result, of_zone)
            panel.set(yscale="log", ylim=limits, xlim=(t * (start - 0.03 * (end - start)), t * (end + 0.03 * (end - start))))
            for doubtful, colour, face in ((False, dark, dark), (True, pale, "white")):
                which = of_zone & ((hits["certain"] == 0) == doubtful) & (values > 0)
                x, y = t * hits["start_s"][which], values[which]
                _bars(panel, x, x, limits[0], y, color=colour, linewidth=1)
                if not doubtful:
                    error, height = np.nan_to_num(t * hits["start_error_s"][which]), np.nan_to_num(errors[which])
                    _bars(panel, x - error, x + error, y, y, color="black", linewidth=0.8)
                    _bars(panel, x, x, np.maximum(y - height, limits[0]), y + height, color="black", linewidth=0.8)
                panel.plot(x, y, "o", color=colour, markerfacecolor=face)
            tops = values + np.where(hits["certain"] == 1, np.nan_to_num(errors), 0.0)
            _number(panel, hits[of_zone], tops[of_zone], t, 0.02 / widths[column])
            panel.set(title=title if row == 0 else "", ylabel=label if column == 0 else "",
                      xlabel=f"start, {time_unit}" if row == 1 else "")
            if column > 0:
                panel.tick_params(labelleft=False)
            if row == 0:
                panel.tick_params(labelbottom=False)


def _bars(panel: Any, x0: Any, x1: Any, y0: Any, y1: Any, **options: Any) -> None:
    """Straight lines, all in one."""
    ends = np.broadcast_arrays(x0, x1, np.nan, y0, y1, np.nan)
    panel.plot(np.ravel(ends[:3], "F"), np.ravel(ends[3:], "F"), **options)


def _number(panel: Any, hits: Any, values: Any, t: float, share: float) -> None:
    """The numbers of sub-impacts above their marks, where there is room: a share of the width."""
    room, last = share * np.ptp(panel.get_xlim()), -np.inf
    for hit, value in zip(hits, values):
        x = t * hit["start_s"]
        near = np.abs(t * hits["start_s"] - x) < 0.5 * room
        if value > 0 and x - last >= room and value >= values[near].max():
            panel.annotate(hit["index"], (x, value), (0, 4), textcoords="offset points", ha="center", fontsize=7)
            last = x
