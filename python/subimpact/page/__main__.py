"""The command `python -m subimpact.page`, which `subimpact report` runs."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence

from .._errors import ResultsError
from .._files import Files
from .._text import say
from . import markup


def _page(options: argparse.Namespace) -> tuple[str, str, list[str]]:
    """The name of a page, its text, and what there is to say. Raises ResultsError."""
    if len(options.directories) > 1:
        from . import several  # draws figures

        return "comparison.html", several.comparison_page(options.directories), []
    files = Files(options.directories[0])
    if files.holds_sweep:
        from . import several

        return "sweep.html", several.sweep_page(files), []
    from . import run

    text = run.page(files, options.dygraphs, options.measured)
    notes = (("warning", files.of_run[1]["caveat"]), ("note: no zoomable charts", markup.charts(options.dygraphs)[2]))
    return "report.html", text, [f"{kind}: {words}" for kind, words in notes if words]


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status: 0 done; 2 files that no run has written, or a page that cannot be written."""
    parser = argparse.ArgumentParser(prog="subimpact.page", description="Writes finished runs, or a sweep, as a page of HTML.")
    parser.add_argument("directories", metavar="DIR", nargs="+", help="output directory of subimpact run or subimpact-sweep")
    parser.add_argument("--out", metavar="DIR", required=True, help="directory of the page")
    parser.add_argument("--dygraphs", metavar="DIR", default=markup.DYGRAPHS, help="directory of dygraph.min.js and dygraph.css")
    parser.add_argument("--measured", metavar="DIR", default="", help="directory of what subimpact.measured has written")
    options = parser.parse_args(arguments)
    try:
        name, text, notes = _page(options)
        with open(os.path.join(options.out, name), "w", encoding="utf-8", errors="replace", newline="\n") as file:
            file.write(text)
    except (ResultsError, OSError) as error:
        say(f"subimpact: {error}")
        return 2
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:  # well-formed files that no run writes
        say(f"subimpact: {', '.join(options.directories)}: holds files that no run of this version has written "
            f"({type(error).__name__}: {error}); run the case again")
        return 2
    except KeyboardInterrupt:
        return 130
    for note in notes:
        say(f"subimpact: {note}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
