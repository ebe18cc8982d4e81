"""The page of a run. With scripts it shows the moving beam and panels that share one time; without, or printed, it is a still
report, with the figures that `subimpact plot` has drawn."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .._errors import ResultsError
from .._files import Files, fingerprint, parsed, read_manifest
from . import numbers
from .markup import (charts, data_element, escaped, figures, filled, headlines, in_print, is_still, paragraphs, table, tiles, web,
                     whole)

_SCRIPTS = ("data.js", "axes.js", "surroundings.js", "motion.js", "panels.js", "report.js")
# Answers of the first screen.
_FIRST = ("sub_impacts", "largest_force", "first_parting", "contact_end", "permanent_set")
_MOST_ZONES = _MOST_FLIGHTS = 8


def drawn_figures(directory: Path, identity: str) -> tuple[list[tuple[str, str, str]], list[str]]:
    """The figures of the run of that identity, as figures.json lists them: names, captions, SVG files; and why others are left
    out, such as those that were changed since."""
    manifest = read_manifest(directory)
    drawn: list[tuple[str, str, str]] = []
    if not manifest or manifest["identity"] != identity:
        return drawn, []
    listed_files = manifest["files"]

    def as_drawn(name: str) -> bytes:
        try:
            with open(directory / name, "rb") as file:
                return file.read() if fingerprint(file) == listed_files.get(name) else b""
        except OSError:
            return b""

    text = as_drawn("figures.json")
    if not text:
        return drawn, []
    listed, left_out = parsed(directory / "figures.json", text, "a list of figures", "draw them again"), []
    for figure in listed["figures"]:
        svg = as_drawn(f"{figure['name']}.svg").decode(errors="replace")
        if is_still(svg):
            drawn.append((figure["name"], figure["caption"], svg))
        else:
            left_out.append(f"{figure['name']}: has no SVG file, or one that was changed")
    return drawn, left_out + listed["left_out"]


def counted(n: int, noun: str) -> str:
    return f"{n} {noun}" + ("" if n == 1 else "s")


def _rows(report: Mapping[str, Any], hits: list[dict[str, str]]) -> Iterator[str]:
    """Of the table of sub-impacts."""
    n_columns, before = len(report["sub_impacts"]["columns"]), ("", "")
    for index, (row, hit) in enumerate(zip(report["sub_impacts"]["rows"], hits)):
        place = hit["zone"], hit["subzone"]
        if place != before:
            yield (f'<tr class="zone"><td colspan="{n_columns}">zone {escaped(place[0])}, sub-zone {escaped(place[1])}</td></tr>\n')
        before = place
        kind = "" if row["certain"] else ' class="uncertain"'
        cells = "".join(f"<td>{escaped(cell)}</td>" for cell in row["cells"])
        yield f'<tr data-hit="{index}"{kind} title="{in_print(hit["doubt"])}">{cells}</tr>\n'


def _sub_impacts(hits: list[dict[str, str]], end: float) -> list[dict[str, Any]]:
    number = numbers.number
    return [{"start": float(hit["start_s"]), "end": float(hit["end_s"] or end), "ongoing": not hit["end_s"],
             "peak_force": float(hit["peak_force_N"]), "peak_time": float(hit["peak_time_s"]),
             "residual": float(hit["residual_indentation_m"]), "start_error": number(hit["start_error_s"]),
             "end_error": number(hit["end_error_s"]), "certain": hit["certain"] != "0"} for hit in hits]


def _data(files: Files, summary: Mapping[str, Any], report: Mapping[str, Any], hits: list[dict[str, str]],
          overlay: Any) -> tuple[dict[str, Any], str, str]:
    """What the scripts draw; notes on what they have of the history and of the shapes."""
    scene, counts, end = report["scene"], summary["counts"], summary["outcome"]["time_s"]
    scene["time_unit"]["name"] = scene["time_unit"]["name"].replace("us", "µs")
    events = [{"time": float(event["time_s"]), "kind": event["kind"]} for event in files.table("transitions.csv")
              if event["kind"].startswith("contact")]
    history, n_rows = numbers.history(files, counts["history_rows"])
    history_note = shapes_note = ""
    if n_rows < counts["history_rows"]:
        history_note = f"Of {counts['history_rows']} rows the charts have {n_rows}, with the largest and smallest values of each span."
    meanings = dict(report["columns"])
    del meanings["time_s"]
    is_result = summary["verdict"]["beam"] != "turned_too_far"
    zones = (summary["rest"] or {}).get("plastic_zones", []) if is_result else []
    data: dict[str, Any] = {
        "end": end, **scene, "yields": bool(zones), "max_force": summary["maxima"]["force_N"],
        "max_indentation": summary["maxima"]["indentation_m"], "sub_impacts": _sub_impacts(hits, end),
        "events": events,
        "plastic_zones": [{"from": zone["from_m"], "to": zone["to_m"]} for zone in zones],
        "overlay": overlay, "history": history, "meanings": meanings, "shapes": None, "envelope": None}
    n_points = summary["used"]["n_shape_points"]
    if counts["shape_rows"] and n_points > 1:
        data["shapes"], points, n_kept = numbers.shapes(files, n_points, counts["shape_rows"], scene["struck_at"], events)
        if "envelope.csv" in files.listed:
            data["envelope"] = numbers.envelope(files, points)
        n_shapes = counts["shape_rows"] // n_points
        shapes_note = (f"Between {n_kept} stored shapes ({report['shape_interval']} apart, and at every event of the contact) the "
                       "picture is interpolated by straight lines; the striker follows the rows of the history.")
        if n_kept < n_shapes or len(points) < n_points:
            shapes_note += (f" To keep the page small it has {n_kept} of {n_shapes} shapes and {len(points)} of {n_points} points "
                            "of each.")
    return data, history_note, in_print(shapes_note)


def _measured(directory: str) -> tuple[str, Any, list[tuple[str, str, str]]]:
    """The section about a measured force that subimpact.measured has left in a directory, what its chart draws, its figure."""
    if not directory:
        return "", None, []
    path = Path(directory, "measured.json")
    try:
        found = parsed(path, path.read_bytes(), "a comparison with a measurement", "report again")
        svg = Path(directory, "measured.svg").read_text(encoding="utf-8")
    except OSError as error:
        raise ResultsError(f"{error.filename}: cannot be read ({error.strerror}); report again") from None
    is_strain = found["quantity"] == "strain"
    fields = {"answers": tiles((each["name"], each["value"], each["note"]) for each in found["answers"]),
              "doubt": paragraphs([found["doubt"]], "warning", "Warning: "),
              "strain": ' data-strain=""' if is_strain else "", "what": "strain" if is_strain else "contact force"}
    return filled("measured.html", fields), found["overlay"], [("measured", found["caption"], svg)]


def _numbers(summary: Mapping[str, Any], meanings: Mapping[str, str]) -> Iterator[str]:
    """The members of summary.json that are no lists, with their meanings."""
    for name, meaning in meanings.items():
        value: Any = summary
        for part in name.split("."):
            value = value.get(part) if isinstance(value, dict) else None
        if value is not None and not isinstance(value, (dict, list)):
            text = value if isinstance(value, str) else json.dumps(value)
            yield f"<tr><td><code>{escaped(name)}</code></td><td>{escaped(text)}</td><td>{escaped(meaning)}</td></tr>\n"


def _section(heading: str, content: str) -> str:
    return f"<h2>{heading}</h2>\n{content}" if content else ""


def _certainty(summary: Mapping[str, Any], report: Mapping[str, Any]) -> dict[str, str]:
    """The verdict and what opens below it."""
    lines = [(line["certain"], "Certain:" if line["certain"] else "Not certain:", line["text"]) for line in report["headlines"]]
    n_doubts, n_warnings = sum(not certain for certain, *_ in lines), len(summary["warnings"])
    opens = ", ".join(counted(n, noun) for n, noun in ((n_doubts, "doubt"), (n_warnings, "warning")) if n)
    return {"verdict": in_print(summary["verdict"]["text"]), "verdict_class": "not" if opens else "certain",
            "verdict_opens": opens or "Why", "headlines": headlines(lines),
            "tolerance": paragraphs([report["tolerance"]], "met" if summary["wish_met"] else "warning", "Tolerance: "),
            "warnings": paragraphs(summary["warnings"], "warning", "Warning: ")}


def errors_of(answer: Mapping[str, Any]) -> str:
    """How far the answer may be from the real beam, and from the exact solution of the model, in the unit of its text."""
    computed, body = answer["error_text"], answer["total_text"] or answer["body_text"]
    if not computed:
        return ""
    mostly = f", mostly {answer['parts'][0]['label']}" if answer["parts"] and answer["parts"][0]["change"] else ""
    return f"real beam: {'+- ' if answer['total_text'] else ''}{body}{mostly}; computed: +- {computed}"


def _begin_error(error: float | None) -> str:
    if error == 0.0:
        return ""
    return "real beam: its begin is not known" if error is None else f"real beam: begins +- {1e6 * error:.3g} us"


def _tile(answer: Mapping[str, Any]) -> tuple[str, str, str]:
    note = "; ".join(part for part in (errors_of(answer) if answer["known"] else "", answer["note"] or "") if part)
    return answer["label"], answer["text"] if answer["known"] else "none", note


_OF_STRIKES = (("sub_impacts", "", "sub-impacts", 1.0), ("restitution", "", "restitution", 1.0), ("peak_force", "_N", "peak force, N", 1.0),
               ("permanent_set", "_m", "permanent set, mm", 1e3), ("dent", "_m", "dent, µm", 1e6),
               ("bending", "_J", "lost by bending, J", 1.0), ("contact", "_J", "lost by the contact, J", 1.0))


def _strikes(files: Files) -> tuple[str, str, list[list[float | None]]]:
    """Of a beam that was struck several times: a note at the top, the section on all strikes, what its chart draws."""
    rows = files.table("strikes.csv") if "strikes.csv" in files.listed else []
    lines, number, place = "", numbers.number, shlex.quote(str(files.directory))
    for k, row in enumerate(rows, 1):
        command = f"subimpact run {place}/case.toml --set repeat.strikes={k} --out {place}-strike-{k} && subimpact report {place}-strike-{k}"
        cells = [f"<td><button>{k}</button></td>"]
        for name, unit, _, factor in _OF_STRIKES:
            value, error = number(row[name + unit]), number(row.get(f"{name}_error{unit}", ""))
            cells.append("<td>" + ("" if value is None else f"{factor * value:.5g}") + (f" ± {factor * error:.2g}" if error else "") + "</td>")
        lines += f'<tr data-strike="{escaped(command)}">{"".join(cells)}</tr>\n'
    names = "".join(f"<th>{words}</th>" for words in ("strike", *(words for _, _, words, _ in _OF_STRIKES)))
    note = f'<p>Of {len(rows)} strikes this page shows the last; the others are under <a href="#all-strikes">All strikes</a>.</p>\n'
    drawn = [[k, number(row["peak_force_N"]), 1e3 * float(row["permanent_set_m"] or 0)] for k, row in enumerate(rows, 1)]
    return (note, filled("strikes.html", {"names": names, "rows": lines}), drawn) if rows else ("", "", [])


def body_of(answers: list[dict[str, Any]]) -> str:
    """How far a real body may be from the model: what each error is made of, and what to do about that."""
    parts = [(answer["label"], answer["text"], "+- " + answer["error_text"], "+- " + answer["body_text"],
              ", ".join(f"{part['label']} {part['text']}" for part in answer["parts"])) for answer in answers if answer["parts"]]
    remedies = {part["label"]: part["remedy"] for answer in answers for part in answer["parts"] if part["remedy"]}
    listed = "".join(f"<dt>{escaped(label)}</dt><dd>{in_print(remedy)}</dd>\n" for label, remedy in remedies.items())
    return table(["", "", "computed", "body", "of which"], parts, "model") + f'<dl class="steps remedies">\n{listed}</dl>\n' if parts else ""


def _answers(summary: Mapping[str, Any]) -> dict[str, str]:
    """Those of the first screen, all others, and what the body's errors are made of."""
    answers = [answer for answer in summary["answers"] if answer["known"] or answer["key"] in (*_FIRST, "restitution")]
    further = [_tile(answer) for answer in answers if answer["key"] not in _FIRST and answer["key"] != "zones"]
    zones = [item for answer in answers for item in answer["items"]]
    further += [(f"zone {zone['number']}", zone["text"], _begin_error(zone["start_body_error_s"])) for zone in zones[:_MOST_ZONES]]
    return {"first": tiles(_tile(answer) for answer in answers if answer["key"] in _FIRST), "further": tiles(further),
            "model": _section("How far a real body may be from this model", body_of(summary["answers"]))}


def page(files: Files, dygraphs: str, measured: str = "") -> str:
    """The page of the run in a directory; `measured`: where subimpact.measured has written, or empty. Raises ResultsError."""
    summary, report = files.of_run
    section, overlay, more_figures = _measured(measured)
    drawn, left_out = drawn_figures(files.directory / "figures", files.identity)
    drawn += more_figures
    hits = files.table("events.csv")
    data, history_note, shapes_note = _data(files, summary, report, hits, overlay)
    script, style, missing = charts(dygraphs)
    outcome, libraries = summary["outcome"], summary["libraries"]
    strikes_note, strikes, data["strikes"] = _strikes(files)
    flights = (summary["error_bars"] or {}).get("uncertain_flights", [])
    columns = report["sub_impacts"]["columns"]
    steps = "".join(f"<dt><code>{escaped(step['command'])}</code></dt><dd>{in_print(step['gain'])}</dd>\n"
                    for step in summary["next"])
    none = ('<p class="unprinted">None: <code>subimpact plot</code> draws them, and <code>subimpact report</code> then puts '
            "them on this page.</p>\n")
    body = filled("report.html", {
        "scene": in_print(report["scene_text"]),
        "failure": strikes_note + paragraphs([report["caveat"], "" if outcome["kind"] == "completed" else outcome["message"]], "failed"),
        **_certainty(summary, report),
        **_answers(summary),
        "no_charts": paragraphs([missing], "warning", "Zoomable charts are missing: "),
        "columns": "".join(f"<th>{in_print(each['name'])}<small>{escaped(re.sub('^u', 'µ', each['unit']))}</small></th>" for each in columns),
        "sub_impacts": "".join(_rows(report, hits)),
        "flights": "".join(f"<p>After sub-impact {each['after_index']} there may be another one: {in_print(each['reason'])}.</p>\n"
                           for each in flights[:_MOST_FLIGHTS])
        + paragraphs([f"So it is after {counted(len(flights) - _MOST_FLIGHTS, 'more sub-impact')}"] if len(flights) > _MOST_FLIGHTS else []),
        "strikes": strikes,
        "next": _section("What next", f'<dl class="steps">\n{steps}</dl>\n' if steps else ""),
        "measured": section,
        "history_note": history_note, "shapes_note": shapes_note,
        "figures_heading": "<h2>Figures</h2>\n" if drawn else f'<h2 class="unprinted">Figures</h2>\n{none}',
        "figures": figures(drawn),
        "left_out": paragraphs(left_out, before="Not drawn: "),
        "summary": in_print(report["verbose"]),
        "toml": escaped(report["case"]),
        "numbers": "".join(_numbers(summary, report["meanings"])),
        "versions": escaped(", ".join([summary["program"]["version"], *(f"{name} {version}" for name, version in libraries.items())]))})
    return whole(summary["case"]["title"] or "A strike", body, style, data_element(data),
                 [*([script] if script else []), *map(web, _SCRIPTS)])

