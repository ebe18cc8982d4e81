"""The command `python -m subimpact.plot`, which `subimpact plot` runs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

import matplotlib

from .._command import Parser
from .._errors import OutputError, ResultsError
from .._text import printable, say, show
from .directory import FORMATS, draw_directory


_EXAMPLES = """Of a run: response, first-sub-impact, indentation, energies, timeline, shapes and envelope (both unless output.shapes
= 0), bending, if the run kept sections (output.sections), and strikes, if there were several. Of a sweep: sweep_map,
histograms. Of several runs: comparison. figures.json has their captions; `subimpact report` puts the figures of a run on
its page.

Examples:
  subimpact run case.toml --out out/first --set output.sections=0.5,0.4
  subimpact plot out/first
  subimpact plot out/first --out figures --format pdf --only response,timeline

Exit status: 0 done; 2 bad command line, files that no run has written, or Python without what is needed; 3 a figure
could not be drawn or written, the others are."""


def _listed(text: str) -> list[str]:
    return [part for part in text.split(",") if part]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = Parser(prog="subimpact plot", description="Draws the figures of a run, a sweep or a study.", epilog=_EXAMPLES,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", metavar="DIR", help="what subimpact run, work-precision or stability, or "
                        "subimpact-sweep has written")
    parser.add_argument("others", metavar="DIR", nargs="*", help="runs to compare that run with; --out is needed")
    parser.add_argument("--out", metavar="DIR", help="directory for the figures; default: DIR/figures")
    parser.add_argument("--format", type=_listed, default=FORMATS, metavar="svg,png,pdf", help="file formats; default: all")
    parser.add_argument("--only", type=_listed, default=(), metavar="NAME,...", help="these figures; default: all")
    options = parser.parse_args(arguments)
    if options.others and not options.out:
        parser.error("several runs are given; --out DIR must name the directory for the figure that compares them")
    if unknown := set(options.format) - set(FORMATS):
        parser.error(f"--format: {', '.join(sorted(unknown))}; allowed: {', '.join(FORMATS)}")
    matplotlib.use("Agg")
    try:
        drawn = draw_directory(options.directory, options.out, options.format, options.only, options.others)
    except (ResultsError, OutputError) as error:
        say(str(error))
        return 2
    except ValueError as error:
        say(f"subimpact: --only {error}")
        return 2
    except KeyboardInterrupt:
        return 130
    lines = [", ".join(f"{name}.{ending}" for ending in options.format) + f"\n    {caption}\n"
             for name, caption in drawn.captions.items()]
    if lines:
        lines.append(f"\nfigures in {printable(drawn.directory)}\n")
    if not show("".join(lines)):
        return 3
    for reason in drawn.left_out:
        say(f"subimpact: note: not drawn: {reason}")
    for failure in drawn.failed:
        say(failure)
    return 3 if drawn.failed else 0


if __name__ == "__main__":
    sys.exit(main())
