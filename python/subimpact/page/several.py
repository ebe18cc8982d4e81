"""Pages of a sweep and of several runs: plain, with the figures of `subimpact.plot`, drawn here."""

from __future__ import annotations

import math
import os
import shlex
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Optional

import matplotlib
import numpy as np

from .. import _core
from .._errors import CaseError, ResultsError
from .._files import Files
from .._toml import flat
from ..case import Case, keys
from ..plot import Absent, comparison, histograms, sweep_map
from ..plot.sweeps import CHIEF, error_column, known_numbers
from .._tables import arrays_of
from ..plot.directory import Figure, figure_of, letters, svg_of
from ..result import read_results
from ..running import run
from .markup import escaped, figures, headlines, in_print, paragraphs, table, tiles, whole
from .run import body_of, counted, errors_of

_MAPPED = ("n_sub_impacts", "max_force_N", "restitution", "permanent_set_m")
_SHOWN = ("outcome", "n_sub_impacts", "n_certain", "max_force_N", "impulse_Ns", "restitution", "permanent_set_m", "warnings", "message")
_MOST_ROWS = 2000
_MOST_SECONDS = 60.0  # of the run of the base case

Pair = tuple[Optional[int], Optional[int]]  # of sub-impacts of two runs that correspond


def _figures(drawings: Mapping[str, Figure]) -> str:
    """The figures that can be drawn, and why others cannot."""
    matplotlib.use("Agg")
    drawn, left_out = [], []
    for name, figure in drawings.items():
        try:
            drawn.append((name, figure.caption, svg_of(figure.draw())))
        except Absent as reason:
            left_out.append(f"{name}: {reason}")
    return f'<div class="stills open" id="stills">\n{figures(drawn)}</div>\n' + paragraphs(left_out, before="Not drawn: ")


def _certainty(columns: Mapping[str, Any], outcomes: Counter[str], n: int) -> str:
    lines = [(False, "Not certain:", "counts, times and order of sub-impacts: the sweep was made without error bars, so that no run "
              "states how far they can be trusted.")]
    if "all_certain" in columns:
        certain = columns["all_certain"]
        n_certain, n_doubtful = int((certain == 1).sum()), int((certain == 0).sum())
        lines = [(True, "Certain:", f"count and order of the sub-impacts in {n_certain} of {counted(n, 'run')}.")] if n_certain else []
        if n_doubtful:
            lines.append((False, "Not certain:", f"the counts of {counted(n_doubtful, 'run')}, which the map hatches; a pattern among "
                          "them may be that of their errors."))
    return headlines([*lines, *((False, "Not certain:", f'{counted(k, "run")} with the outcome "{kind}".')
                                for kind, k in sorted(outcomes.items()) if kind != "completed"), *_warnings(columns, n)])


def _warnings(columns: Mapping[str, Any], n: int) -> list[tuple[bool, str, str]]:
    kinds = Counter(kind for cell in columns.get("warnings", ()) if isinstance(cell, str) and cell for kind in cell.split(";"))
    return [(False, "Not certain:", f"{', '.join(f'{kind} in {k}' for kind, k in kinds.most_common())} of {counted(n, 'run')}: warnings, "
             "whose sentences a run of its own has (the command below); the maps hatch them.")] if kinds else []


def _values(columns: Mapping[str, Any], key: str, unit: str) -> str:
    if columns[key].dtype.kind == "U":
        return f"{len(set(columns[key].tolist()))} different texts"
    known = known_numbers(columns, key)
    return f"{len(np.unique(known))} different, {known.min():.6g} to {known.max():.6g} {unit}" if len(known) else ""


def _statistics(columns: Mapping[str, Any]) -> str:
    """Mean, deviation, quantiles and errors of the chief numbers over all runs."""
    rows = []
    for name in CHIEF:
        values, known = known_numbers(columns, name), known_numbers(columns, error_column(columns, name) or "")
        if len(values) < 2 or np.ptp(values) == 0.0:
            continue
        deviation = np.std(values, ddof=1)
        rows.append([name, str(len(values)), f"{np.mean(values):.6g} +- {deviation / np.sqrt(len(values)):.2g}", f"{deviation:.4g}",
                     "{:.5g} to {:.5g}".format(*np.quantile(values, (0.05, 0.95))),
                     f"{np.median(known):.2g}, {np.max(known):.2g}, of {len(known)} runs" if len(known) else "not known"])
    heading = ["number", "runs", "mean, its standard error", "standard deviation", "5 % to 95 %", "error of a run: median, largest"]
    return "<h2>Over all runs</h2>\n" + table(heading, rows, "statistics") if rows else ""


def _base_case(files: Files) -> str:
    """How far a real body may be from the base case, which is run for that."""
    try:
        base = run(Case.from_text(files.read("base.toml").decode()), timeout=_MOST_SECONDS) if "base.toml" in files.listed else None
    except CaseError:  # without a key that the sweep varies it may be none that can be run
        base = None
    model = body_of(base.summary["answers"]) if base and base.outcome == "completed" else ""
    return f"<h2>How far a real body may be from this model: the base case</h2>\n{model}" if model else ""


def sweep_page(files: Files) -> str:
    """A map of the runs of a sweep over two of their keys, how their numbers are distributed, and a table. Raises ResultsError."""
    path = files.directory / "runs.csv"
    rows = files.table("runs.csv")
    files.open("sub_impacts.csv").close()
    for name in ("run", "outcome"):
        if rows and name not in rows[0]:
            raise ResultsError(f"{path}: has no column {name}; its columns are {', '.join(rows[0])}; run the sweep again")
    if not rows:
        raise ResultsError(f"{path}: has no run yet; run the sweep again")
    names = list(rows[0])
    columns = arrays_of({name: [row[name] for row in rows] for name in names})
    all_keys, known = names[names.index("run") + 1 : names.index("outcome")], keys()
    outcomes = Counter(row["outcome"] for row in rows)
    counts = known_numbers(columns, "n_sub_impacts")
    shown = [("runs", str(len(rows)), ""), ("completed", str(outcomes["completed"]), "")]
    if len(counts):
        shown.append(("sub-impacts per run", f"{counts.min():.0f} to {counts.max():.0f}", ""))
    drawings = {f"map-{name}": figure_of(sweep_map, columns, column=name) for name in _MAPPED if len(known_numbers(columns, name))}
    drawings["histograms"] = figure_of(histograms, columns)
    units = {key: known[key].unit if key in known else "" for key in all_keys}
    base = files.directory / "base.toml"
    command = " ".join(["subimpact run", shlex.quote(str(base) if base.exists() else "CASE.toml"), f"--out run-{rows[0]['run']}",
                        *(f"--set {shlex.quote(f'{key}={rows[0][key]}')}" for key in all_keys)])
    listed = ["run", *all_keys, *(name for name in _SHOWN if name in names)]
    body = (f'<ul class="headline">\n{_certainty(columns, outcomes, len(rows))}</ul>\n<div class="tiles">\n{tiles(shown)}</div>\n'
            "<h2>Keys that differ</h2>\n"
            + table(["key", "meaning", "values"], [(key, known[key].meaning if key in known else "", _values(columns, key, units[key]))
                                                   for key in all_keys])
            + _statistics(columns) + _base_case(files) + "<h2>Figures</h2>\n" + _figures(drawings)
            + "<h2>Runs</h2>\n" + table(listed, [[row[name] for name in listed] for row in rows[:_MOST_ROWS]], "runs")
            + paragraphs([f"The first {_MOST_ROWS} of {len(rows)} runs are shown; runs.csv has all"] if len(rows) > _MOST_ROWS else [])
            + f"<p>To make one of them alone, with the errors of its mesh too; the first, for example:</p>\n<pre>{escaped(command)}</pre>\n")
    return whole(f"Sweep: {files.directory}", body)


def _signed(x: float, decimals: int) -> str:
    return f"{x:+.{decimals}f}".replace("-", "−")


def n_leading(pairs: Sequence[Pair]) -> int:
    """How many pairs from the first on have both."""
    return next((n for n, pair in enumerate(pairs) if None in pair), len(pairs))


def _pair_row(pair: Pair, first: Any, second: Any) -> list[str]:
    a, b = (None if k is None else hits[k] for k, hits in zip(pair, (first, second)))
    cells = ["none" if k is None else str(k + 1) for k in pair]
    cells.append(f"{1e6 * (b if a is None else a)['start_s']:.3f}")
    if a is None or b is None:
        return cells + [""] * 5
    later = 1e6 * (b["end_s"] - a["end_s"])
    errors = 1e6 * (a["start_error_s"] + b["start_error_s"])
    return [*cells, _signed(1e6 * (b["start_s"] - a["start_s"]), 4), "" if math.isnan(later) else _signed(later, 4),
            "not known" if math.isnan(errors) else f"± {errors:.4f}",
            *(_signed(100 * (b[name] / a[name] - 1), 3) if a[name] else "" for name in ("peak_force_N", "impulse_Ns"))]


def _pair_words(pairs: Sequence[Pair], first: Any, second: Any, letter: str) -> str:
    n = n_leading(pairs)
    largest = np.abs(first["start_s"][:n] - second["start_s"][:n]).max(initial=0.0)
    words = "The first sub-impacts correspond" if n == 1 else f"The first {counted(n, 'sub-impact')} correspond one to one"
    if n:
        words += f"; their starts differ by {1e6 * largest:.2g} us at most"
    if n < len(pairs):
        i, k = pairs[n]
        odd = first[i] if i is not None else second[k]
        length = np.nan_to_num(odd["end_s"], nan=math.inf) - odd["start_s"]
        words += f"; from {1e6 * odd['start_s']:.6g} us on they differ: a contact of {1e6 * length:.4g} us is in only one of A and {letter}"
    return words + "."


def _differing(summaries: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    cases = [flat(summary["case"]) for summary in summaries]
    units = summaries[0]["case_units"]
    return [[key, *("–" if case.get(key) is None else f"{case[key]} {units.get(key, '')}" for case in cases)]
            for key in cases[0] if any(case.get(key) != cases[0][key] for case in cases)]


def _answers(reports: Sequence[Mapping[str, Any]], summaries: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    """What is asked of each run first, and how it was computed."""
    lists = [{answer["label"]: f"{answer['text']} ({errors_of(answer)})".replace(" ()", "") for answer in summary["answers"] if answer["known"]}
             for summary in summaries]
    for of_run, report, summary in zip(lists, reports, summaries):
        of_run.update({"outcome": summary["outcome"]["kind"], "mesh": summary["used"]["mesh"], "method": summary["used"]["method"],
                       "time to compute": report["computed_in"]})
    labels = list(dict.fromkeys(label for of_run in lists for label in of_run))
    return [[label, *(of_run.get(label, "–") for of_run in lists)] for label in labels]


def comparison_page(directories: Sequence[str]) -> str:
    """The curves of several runs in one figure, the keys in which their cases differ, and the sub-impacts of each matched with
    those of the first. Raises ResultsError."""
    results = [read_results(directory) for directory in directories]
    summaries, reports = [result.summary for result in results], [result.report_data for result in results]
    names = letters(len(results))
    hits = [result.sub_impacts for result in results]
    heading = ["no. in A", "", "start in A, µs", "starts later, µs", "ends later, µs", "error bars, µs", "peak force, %", "impulse, %"]
    lines, pairs_of = [], []
    for letter, of_run in list(zip(names, hits))[1:]:
        pairs = _core.matched(hits[0], of_run)
        words = _pair_words(pairs, hits[0], of_run, letter)
        lines.append((n_leading(pairs) == len(pairs), f"{letter} compared with A:", words))
        heading[1] = f"no. in {letter}"
        pairs_of.append(f"<h2>Sub-impacts of {letter} compared with those of A</h2>\n<p>{in_print(words)}</p>\n"
                        + table(heading, [_pair_row(pair, hits[0], of_run) for pair in pairs]))
    lines += [(False, "Not certain:", f"{letter}: {report['caveat']}.") for letter, report in zip(names, reports) if report["caveat"]]
    different = _differing(summaries)
    runs = table(["", *(f"{letter}: {os.fspath(directory)}" for letter, directory in zip(names, directories))], _answers(reports, summaries))
    body = (f'<ul class="headline">\n{headlines(lines)}</ul>\n<h2>Runs</h2>\n{runs}<h3>Keys of the cases that differ</h3>\n'
            + (table(["key", *names], different) if different else "<p>None: the cases are the same.</p>\n") + "<h2>Curves</h2>\n"
            + _figures({"comparison": figure_of(comparison, dict(zip(names, results)))})
            + "".join(pairs_of) + f'<p class="sub">subimpact {escaped(summaries[0]["program"]["version"])}</p>\n')
    return whole(f"Comparison: {summaries[0]['case']['title'] or 'a strike'}", body)
