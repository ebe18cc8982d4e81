"""What the commands have in common that the program `subimpact` leaves to this package."""

from __future__ import annotations

import argparse
import signal
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from . import _core
from ._errors import CaseError, OutputError
from ._text import printable, say, show
from .case import Case
from .sweep.engines import n_cores
from .sweep.interruption import Interruption


class Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, printable(f"{self.prog}: {message}; see {self.prog} --help\n"))


class Display:
    """Shows on stderr how many runs are done, if that is a terminal."""

    def __init__(self, quiet: bool, what: str) -> None:
        self._is_shown = not quiet and sys.stderr.isatty()
        self._what, self._start, self._first = what, time.monotonic(), -1

    def __call__(self, n_done: int, n_all: int) -> None:
        if not self._is_shown:
            return
        if self._first < 0:
            self._first = n_done
        seconds, n_new = time.monotonic() - self._start, n_done - self._first
        left = f", {seconds * (n_all - n_done) / n_new:.0f} s left" if n_new else ""
        print(f"\r\033[K{n_done} of {n_all} {self._what}{left}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def text_of_table(columns: Sequence[Sequence[str]], widths: Sequence[int], ends: Sequence[str]) -> str:
    """Lines of cells, flushed right in columns of at least these widths, with what stands at their ends."""
    wide = [max(width, *map(len, column)) for width, column in zip(widths, columns)]
    lines = (" ".join(cell.rjust(width) for cell, width in zip(row, wide)) for row in zip(*columns))
    return "".join(f"{line} {end}".rstrip() + "\n" for line, end in zip(lines, ends))


class Command:
    """A study of a case: what it takes, prints and writes."""

    def __init__(self, name: str, description: str, examples: str) -> None:
        self._name = name
        self._parser = Parser(prog=f"subimpact {name}", description=description, epilog=examples,
                              formatter_class=argparse.RawDescriptionHelpFormatter)
        add = self.add = self._parser.add_argument
        add("case", metavar="CASE", help="case file (TOML); `subimpact keys` lists its keys")
        add("--set", metavar="KEY=VALUE", action="append", default=[], help="instead of the value in the case file; "
            "KEY=default: as if the file did not have the key; may be repeated: the last one holds")
        add("--method", help="time integration method, instead of solver.method; see `subimpact methods`")
        add("--out", metavar="DIR", help="directory for the results; made if missing; without it nothing is written")
        add("--jobs", type=int, default=n_cores(), help="largest number of runs in parallel; results do not depend on it; "
            "default: the number of processors")
        add("--quiet", action="store_true", help="print nothing but warnings and errors")

    def run(self, arguments: Sequence[str] | None, study_of: Callable[[Case, argparse.Namespace, dict[str, Any]], Any]) -> int:
        """The exit status after a study, which has a `base` run, a `report` and files, or was `interrupted`."""
        options = self._parser.parse_args(arguments)
        display, study, number = Display(options.quiet, "runs"), None, 0
        try:
            case = Case.from_file(options.case, [_core.parsed_setting(text) for text in options.set] + (
                [("solver.method", options.method, f"--method {options.method}")] if options.method else []))
            for note in [] if options.quiet else case.notes():
                say(f"subimpact: note: {note}")
            for doubt in case.warnings():
                say(f"subimpact: warning: {doubt}")
            with Interruption():
                study = study_of(case, options, {"jobs": options.jobs, "progress": display})
        except KeyboardInterrupt as error:
            number = getattr(error, "signal", signal.SIGINT)
        except CaseError as error:
            say(str(error))
            return 2
        except ValueError as error:
            self._parser.error(str(error))
        finally:
            display.end()
        if study is None:
            say("subimpact: interrupted before there was a result; nothing is written")
            return 128 + number
        if study.base.outcome not in ("completed", "stopped"):
            say(f"subimpact: {study.base.message}")
            return 2 if study.base.outcome == "left-validity" else 3
        is_shown = options.quiet or show(printable(f"{case['title'] or 'untitled case'}\n\n{study.report()}"))
        if options.out:
            try:
                study.write(options.out)
            except OutputError as error:
                say(f"subimpact: {error}")
                return 3
            is_shown = is_shown and (options.quiet or show(f"\n{self._name}.csv in {printable(options.out)}\n"))
        if study.interrupted:
            say("subimpact: interrupted; the keys above are those whose runs had ended")
            return 128 + (number or signal.SIGINT)
        return 0 if is_shown else 3
