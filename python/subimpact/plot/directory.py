"""The figures of a directory: what it holds, drawn into files."""

from __future__ import annotations

import functools
import io
import json
import os
import re
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np

from .. import _core
from .._errors import OutputError, ResultsError
from .._tables import read_table
from .._text import one_line, path_text
from ..result import read_results
from . import beam, run, studies, sweeps
from .comparison import comparison
from .style import Absent, style

FORMATS = ("svg", "png", "pdf")
LIST = "figures.json"

_METADATA: dict[str, dict[str, None]] = {"svg": {"Date": None}, "png": {"Software": None}, "pdf": {"CreationDate": None}}
_ROOT_STYLE = "stroke-linejoin: round; stroke-linecap: butt; font-family: DejaVu Sans, Arial, Helvetica, sans-serif"
_OF_RUN = {draw.__name__.replace("_", "-"): draw for draw in (
    run.response, run.first_sub_impact, run.indentation, run.energies, run.timeline, beam.bending, beam.shapes, beam.envelope)}


class Figure(NamedTuple):
    """A figure that can be drawn."""

    draw: Callable[[], Any]
    caption: str


class Drawn(NamedTuple):
    """What came of the figures of a directory."""

    directory: str
    captions: dict[str, str]  #: of the figures drawn now, by their names
    left_out: list[str]  #: with their reasons
    failed: list[str]


def caption_of(draw: Callable[..., Any]) -> str:
    return " ".join((draw.__doc__ or "").split())


def figure_of(draw: Callable[..., Any], *sources: Any, **named: Any) -> Figure:
    return Figure(functools.partial(draw, *sources, **named), caption_of(draw))


def letters(n: int) -> list[str]:
    """What the runs of a comparison are called: A, B ..."""
    return [chr(ord("A") + k) if k < 26 else f"run {k + 1}" for k in range(n)]


def figures_of(directory: Path, *others: Path) -> dict[str, Figure]:
    """The figures of a run, a sweep or a study, or of several runs, by their names. Raises ResultsError."""
    if others:
        runs = dict(zip(letters(1 + len(others)), (directory, *others)))
        drawn = figure_of(comparison, {letter: read_results(run) for letter, run in runs.items()})
        named = "; ".join(f"{letter}: {one_line(str(run))}" for letter, run in runs.items())
        return {"comparison": Figure(drawn.draw, f"{drawn.caption} {named}.")}

    def table(name: str) -> dict[str, Any]:
        return read_table(directory / f"{name}.csv")

    def has(name: str) -> bool:
        return (directory / name).exists()

    if has("runs.csv") and not has("summary.json"):
        runs = table("runs")
        return {name: figure_of(getattr(sweeps, name), runs) for name in ("sweep_map", "histograms")}
    if has("work_precision.csv"):
        points = table("work_precision")
        return {"work_precision": figure_of(studies.work_precision, points),
                "work_precision_evaluations": figure_of(studies.work_precision, points, cost="right_hand_sides")}
    if has("outcomes.csv"):
        return {"outcomes": figure_of(studies.outcomes, table("outcomes"))}
    if has("matches.csv"):
        floor = table("comparison")["reference_error_s"][0]
        return {"differences": figure_of(studies.differences, table("matches"), reference_error=floor)}
    if has("sensitivity.csv"):
        return {"sensitivity": figure_of(studies.sensitivity, table("sensitivity"))}
    result = read_results(directory)
    figures = {name: figure_of(draw, result) for name, draw in _OF_RUN.items()}
    if result["output.gauges"]:
        figures["gauges"] = figure_of(run.gauges, result)
    if len(result.strikes):
        figures["strikes"] = figure_of(beam.strikes, result)
    return figures


def save(axes: Any, path: str | os.PathLike[str], formats: Sequence[str] = FORMATS) -> None:
    """Writes the figure of these axes as path.svg, path.png and path.pdf, alike whenever it is drawn, and
    closes it."""
    made = np.ravel(axes)[0].figure
    try:
        with style():
            made.draw_without_rendering()
            made.set_layout_engine("none")  # as it is now, in every format
            for ending in formats:
                Path(f"{os.fspath(path)}.{ending}").write_bytes(_content(made, ending))
    finally:
        plt.close(made)


def svg_of(axes: Any) -> str:
    """The figure of these axes as an SVG file, and closes it."""
    made = np.ravel(axes)[0].figure
    try:
        with style():
            return _content(made, "svg").decode()
    finally:
        plt.close(made)


def _content(made: Any, ending: str) -> bytes:
    content = io.BytesIO()
    made.savefig(content, format=ending, metadata=_METADATA[ending])
    return _compact(content.getvalue().decode()).encode() if ending == "svg" else content.getvalue()


def _compact(svg: str) -> str:
    """An SVG file of Matplotlib with hundredths of a point, and no names that nothing refers to."""

    def short(attribute: re.Match[str]) -> str:
        numbers = re.sub(r"-?\d+\.\d+", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), attribute[0])
        return re.sub(r"\s*([MLQCz])\s*", r"\1", numbers)

    svg = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<g id="[^"]*"', "<g", svg)
    svg = re.sub(r'\b(?:d|x|y|transform)="[^"]*"', short, svg)
    svg = re.sub(r"font: ([\d.]+px) '[^;\"]*", r"font-size: \1", svg)
    svg = svg.replace("<svg ", f'<svg style="{_ROOT_STYLE}" ', 1)
    svg = re.sub(r"\s*\n\s*", "\n", svg)
    for _ in range(4):  # groups in each other that mean nothing
        svg = re.sub(r"<g>\n((?:(?!</?g\b).*\n)*?)</g>\n", r"\1", svg)
    alike = r'<g((?: clip-path="[^"]*")?)>\n((?:<use [^>]*? style="([^"]*)"/>\n)(?:<use [^>]*? style="\3"/>\n)*)</g>'
    return re.sub(alike, lambda marks: f'<g{marks[1]} style="{marks[3]}">\n'
                  + marks[2].replace(f' style="{marks[3]}"', "") + "</g>", svg)


def _read_member(file: Path, name: str) -> Any:
    """Of an object in a file of JSON; None if it cannot be read."""
    try:
        return json.loads(file.read_text(encoding="utf-8"))[name]
    except (OSError, ValueError, KeyError, TypeError):
        return None


def identity_of(directory: Path) -> str:
    """Of the results in a directory; empty if there is none."""
    return str(_read_member(directory / "manifest.json", "identity") or "")


def _earlier(directory: Path) -> dict[str, str]:
    return {figure["name"]: figure["caption"] for figure in _read_member(directory / LIST, "figures") or []}


def draw_directory(directory: str | os.PathLike[str], out: str | os.PathLike[str] | None = None,
                   formats: Sequence[str] = FORMATS, only: Sequence[str] = (), others: Sequence[str] = ()) -> Drawn:
    """Draws the figures of a run, a sweep or a study into the directory `out`, by default the folder
    `figures` in it, with their captions in figures.json; figures of other results that were drawn there
    are removed. `others`: runs to compare the run with. Raises ResultsError for a directory that holds
    neither, ValueError for a figure that it has not, OutputError."""
    source = Path(path_text(directory, ResultsError))
    figures = figures_of(source, *map(Path, others))
    if unknown := [name for name in only if name not in figures]:
        raise ValueError(f"{', '.join(unknown)}: no figure of {source}; allowed: {', '.join(figures)}")
    target = Path(path_text(out if out is not None else source / "figures", OutputError))
    identity = "" if others else identity_of(source)
    with closing(_core.OutputDirectory(str(target), "figures", 0.0, identity)) as output:
        known = _earlier(target) if identity and identity == identity_of(target) else {}
        captions: dict[str, str] = {}
        left_out: list[str] = []
        failed: list[str] = []
        for name in only or figures:
            try:
                save(figures[name].draw(), Path(output.staging) / name, formats)
                captions[name] = figures[name].caption
            except Absent as reason:
                left_out.append(f"{name}: {reason}")
            except Exception as error:  # the others are drawn all the same
                for file in Path(output.staging).glob(f"{name}.*"):
                    file.unlink()
                what = f"cannot be written ({error.strerror})" if isinstance(error, OSError) else f"cannot be drawn ({error!r})"
                failed.append(f"{name}: {what}")
        known.update(captions)
        listed = [{"name": name, "caption": known[name]} for name in figures if name in known]
        text = json.dumps({"figures": listed, "left_out": left_out, "failed": failed}, indent=1, ensure_ascii=False)
        (Path(output.staging) / LIST).write_text(text + "\n", encoding="utf-8")
        output.commit()
        return Drawn(str(target), captions, left_out, failed)
