"""The comparison of a run with a measured force, as `subimpact report DIR --measured FILE` calls it."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from contextlib import closing
from pathlib import Path

import matplotlib

from .. import _core
from .._command import Parser
from .._errors import OutputError, ResultsError
from .._text import path_text, printable, say, show
from ..plot.directory import identity_of, save
from ..result import read_results
from . import Alignment, align, read
from .drawing import draw_all, packed
from .units import value_in

_DESCRIPTION = """Lays a measured force beside that of a run, prints how they differ, and writes measured.svg and
measured.json. A file that states what it holds needs no option; for others the message names one."""


def _time(text: str) -> float:
    if (seconds := value_in("time", text)) is None or not math.isfinite(seconds):
        raise argparse.ArgumentTypeError(f"is {text!r}; allowed: a time with its unit, such as 12.5us or -3ms")
    return seconds


def _cutoff(text: str) -> float | str:
    hertz = value_in("frequency", text)
    if text != "find" and (hertz is None or not 0.0 < hertz < math.inf):
        raise argparse.ArgumentTypeError(f"is {text!r}; allowed: a frequency above 0 with its unit, such as 20kHz, or find")
    return "find" if hertz is None else hertz


def _factor(text: str) -> float:
    try:
        if math.isfinite(factor := float(text)) and factor != 0.0:
            return factor
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"is {text!r}; allowed: a number other than 0")


def _gain(text: str) -> float | str:
    return text if text == "find" else _factor(text)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(prog="subimpact report", description=_DESCRIPTION)
    parser.add_argument("run", metavar="DIR", help="output directory of `subimpact run`")
    parser.add_argument("--measured", metavar="FILE", required=True, help="table of a measured force")
    parser.add_argument("--out", metavar="DIR", help="directory of measured.svg and measured.json; default: DIR/figures")
    parser.add_argument("--shift", type=_time, help="by how much the measured time is later than that of the run; default: found")
    parser.add_argument("--low-pass", type=_cutoff, help="cut-off of the transducer, such as 20kHz, or find; default: no filter")
    parser.add_argument("--gain", type=_gain, default=1.0, help="measured over true force, or find; default: 1")
    parser.add_argument("--gauge", type=int, default=1, help="of a measured strain: the gauge in output.gauges; default: 1")
    reading = parser.add_argument_group("how the file is read")
    reading.add_argument("--columns", metavar="T,F", help="columns of time and force, by number or name")
    reading.add_argument("--units", metavar="us,kN", help="units of both; m/s^2, g and volts are allowed")
    reading.add_argument("--scale", type=_factor, help="the force is multiplied by this")
    reading.add_argument("--sign", type=int, choices=(1, -1), help="-1: the file has compression negative")
    reading.add_argument("--sensitivity", metavar='"2.27 mV/N"', help="of a transducer in volts or coulombs")
    reading.add_argument("--mass", metavar='"201 g"', help="of the body whose acceleration was measured")
    reading.add_argument("--interval", metavar="1us", help="between samples, in place of a column of times")
    reading.add_argument("--skip", type=int, default=0, help="lines at the top that are not read")
    reading.add_argument("--rows", type=int, help="rows that are read; default: all")
    reading.add_argument("--separator", help="of cells; tab and \" \" are allowed")
    reading.add_argument("--decimal", choices=(".", ","))
    return parser


def _write(run: str, directory: str, alignment: Alignment) -> None:
    """Writes what the page shows. Raises OutputError."""
    page = {"quantity": alignment.quantity, "answers": alignment.answers(), "doubt": alignment.doubt,
            "caption": " ".join((draw_all.__doc__ or "").split()),
            "overlay": [packed(side.times, side.forces) for side in (alignment.measured, alignment.computed)]}
    with closing(_core.OutputDirectory(path_text(directory, OutputError), "figures", 0.0, identity_of(Path(run)))) as output:
        save(draw_all(alignment), Path(output.staging) / "measured", ("svg",))
        (Path(output.staging) / "measured.json").write_text(json.dumps(page) + "\n", encoding="utf-8")
        output.commit()


def main(arguments: list[str] | None = None) -> int:
    """Exit status: 0 done; 2 bad command line or files; 3 files or answers cannot be written."""
    matplotlib.use("Agg")
    options = vars(_parser().parse_args(arguments))
    how = {name: options.pop(name) for name in ("shift", "gain", "low_pass", "gauge")}
    run, measured, out = (options.pop(name) for name in ("run", "measured", "out"))
    try:
        signal = read(measured, **options)
        alignment = align(read_results(run), signal, **how)
    except ResultsError as error:
        say(f"subimpact: {error}")
        return 2
    answers = "".join(f"  {answer['name']:<18}  {answer['value']}\n{'':22}{answer['note']}\n" for answer in alignment.answers())
    is_shown = show(f"  {'read as':<18}  {printable('; '.join(signal.assumed))}\n{answers}")
    try:
        _write(run, out or os.path.join(run, "figures"), alignment)
    except OSError as error:  # OutputError is one
        say(str(error))
        return 3
    if alignment.doubt:
        say(f"subimpact: warning: {alignment.doubt}")
    return 0 if is_shown else 3


if __name__ == "__main__":
    sys.exit(main())
