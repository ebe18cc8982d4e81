"""Runs of several cases beside one another, in threads of this process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Optional

from . import _core
from ._errors import CaseError
from .case import Case

Progress = Optional[Callable[[int, int], object]]


class Runs:
    """Runs cases, `jobs` at a time, and counts those that end, of `n_all`, for a callback that may end all; so does
    Ctrl-C."""

    def __init__(self, jobs: int, progress: Progress, n_all: int) -> None:
        self._jobs, self._progress, self._n_all, self._n_done = jobs, progress, n_all, 0
        self.interrupted = False  #: by Ctrl-C or the callback
        self.by_signal = False

    def of(self, cases: Sequence[Callable[[], Case]]) -> list[_core.Finished | CaseError]:
        """The runs of cases that are made as they are needed, or why a case cannot be run; those that were ended have the
        outcome "stopped"."""
        with ThreadPoolExecutor(self._jobs) as pool:
            futures = [pool.submit(self._run, case) for case in cases]
            left = set(futures)
            while left:
                try:
                    done, left = wait(left, return_when=FIRST_COMPLETED)
                    for future in done:
                        self._count(future.result())
                except KeyboardInterrupt:
                    self.interrupted = self.by_signal = True
                except BaseException:
                    self.interrupted = True
                    raise
        return [future.result() for future in futures]

    def _run(self, case: Callable[[], Case]) -> _core.Finished | CaseError:
        try:
            return _core.run(case()._load(), "off", 1, lambda _: not self.interrupted, None, False)
        except CaseError as error:
            return error

    def _count(self, run: _core.Finished | CaseError) -> None:
        if isinstance(run, _core.Finished) and run.outcome == "stopped":
            self.interrupted = True
            return
        self._n_done += 1
        if self._progress is not None and self._progress(self._n_done, self._n_all) is False:
            self.interrupted = True
