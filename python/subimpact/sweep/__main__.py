"""The command subimpact-sweep."""

from __future__ import annotations

import argparse
import importlib
import re
import signal
import sys
from collections.abc import Sequence
from typing import Any

from .._command import Display, Parser
from .._errors import CaseError, PlanError, StoreError
from .._text import printable, say, show
from .plan import Plan
from .running import sweep

_EXAMPLES = """examples:
  subimpact-sweep plan.toml
  subimpact-sweep plan.toml --workers 8 --out out/map
  subimpact-sweep plan.toml --dask tcp://host:8786
  mpiexec -n 64 python3 -m mpi4py.futures -m subimpact.sweep plan.toml --mpi
  subimpact-sweep plan.toml --only 0:1000 --out part-1      (one of several jobs)
  subimpact-sweep plan.toml --merge part-1 part-2           (and then their tables)

exit status: 0 done; 2 bad command line, plan, case or directory; 3 cases are missing or crashed,
most did not complete, or files cannot be written; 130, 143, 129 stopped by Ctrl-C, SIGTERM, SIGHUP, with all rows so far
stored and in the tables. A sweep that was stopped goes on where it was: give the same command again."""


def _say(text: str) -> None:
    say(f"subimpact-sweep: {text}")


def _part(text: str) -> tuple[int, int]:
    pair = re.fullmatch(r"(\d{0,18}):(\d{0,18})", text)
    first, end = (int(pair[1] or 0), int(pair[2] or sys.maxsize)) if pair else (0, 0)
    if first >= end:
        raise argparse.ArgumentTypeError(
            f"is {text!r}; allowed: a number from 0 and a larger one, such as 0:1000"
        )
    return first, end


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="subimpact-sweep",
        description="Runs the cases of a plan and writes runs.csv and sub_impacts.csv.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("plan", metavar="PLAN", help="plan (TOML); see docs/populations.md")
    parser.add_argument("--out", metavar="DIR", help="directory of the results; default: the plan's "
                        "name without its ending, and -sweep")
    engine = parser.add_mutually_exclusive_group()
    engine.add_argument("--workers", type=int, metavar="N",
                        help="processes; default: one per core; 0: all in one process")
    engine.add_argument("--dask", metavar="ADDRESS", help="scheduler of Dask")
    engine.add_argument("--mpi", action="store_true", help="the ranks of mpi4py.futures")
    parser.add_argument("--memory", type=float, metavar="GIB", help="most memory of a process")
    parser.add_argument("--only", type=_part, metavar="FIRST:END", help="the cases FIRST to END - 1")
    parser.add_argument("--merge", nargs="+", default=[], metavar="DIR",
                        help="take the rows of other directories first; run what is missing then")
    parser.add_argument("--retry", action="store_true",
                        help="run cases again that were timed out, crashed or ran out of memory")
    parser.add_argument("--hdf5", action="store_true", help="write the tables into sweep.h5 too")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return parser


def _run(options: argparse.Namespace, executor: Any) -> int:
    plan = Plan.from_file(options.plan)
    out = options.out or options.plan.rsplit("/", 1)[-1].removesuffix(".toml") + "-sweep"
    display = Display(options.quiet, "cases")
    chosen = {name: getattr(options, name) for name in ("workers", "memory", "only", "retry", "merge")}
    try:
        done = sweep(plan, out=out, executor=executor, progress=display, **chosen)
    finally:
        display.end()
    if options.hdf5:
        done.write_hdf5()
    for note in done.notes:
        _say(note)
    counts = ", ".join(f"{count} {name}" for name, count in sorted(done.outcomes.items())) or "none run"
    missing = f", {done.n_missing} missing" if done.n_missing else ""
    is_shown = options.quiet or show(f"{len(plan)} cases: {counts}{missing}\nfiles in {printable(str(done.directory))}\n")
    is_whole = not done.n_missing or options.only is not None
    most = 2 * done.outcomes.get("completed", 0) >= sum(done.outcomes.values())
    return 0 if is_shown and is_whole and most and "crashed" not in done.outcomes else 3


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    try:
        if options.dask is not None:
            distributed: Any = importlib.import_module("dask.distributed")
            with distributed.Client(options.dask) as client:
                return _run(options, client)
        if options.mpi:
            futures: Any = importlib.import_module("mpi4py.futures")
            n = max(importlib.import_module("mpi4py.MPI").COMM_WORLD.Get_size() - 1, 1)
            if not options.quiet:
                _say(f"{n} of the ranks run cases, and one hands them out; mpiexec -n {n + 2} has {n + 1} that run cases")
            with futures.MPIPoolExecutor() as executor:
                return _run(options, executor)
        return _run(options, None)
    except (CaseError, PlanError, StoreError) as error:
        _say(str(error))
        return 2
    except OSError as error:  # a full disk, a scheduler out of reach
        _say(str(error))
        return 3
    except MemoryError:
        _say("the memory does not suffice; take fewer cases, or give more memory")
        return 3
    except ImportError as error:
        _say(f"{error}; Debian's packages are python3-distributed, python3-mpi4py and python3-h5py")
        return 2
    except KeyboardInterrupt as error:
        number: int = getattr(error, "signal", signal.SIGINT)
        _say(f"stopped by {signal.Signals(number).name}; the same command goes on from here")
        return 128 + number


if __name__ == "__main__":
    sys.exit(main())
