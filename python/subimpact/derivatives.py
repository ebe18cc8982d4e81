"""Derivatives of event times, forces and velocities."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, get_args

from . import _core
from ._checks import check_jobs, check_progress
from ._errors import OutputError
from ._text import path_text
from .case import Case, as_case
from .result import Result

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from .result import Table

Quantity = Literal[
    "start_s",
    "end_s",
    "peak_force_N",
    "impulse_Ns",
    "max_indentation_m",
    "striker_velocity_m_per_s",
]


class Sensitivity:
    """The derivatives of the numbers of every sub-impact by the logarithms of keys."""

    def __init__(self, study: _core.Study) -> None:
        self._study = study

    @property
    def keys(self) -> list[str]:
        """The keys p by which there are derivatives df/d ln p."""
        return self._study.keys

    @cached_property
    def table(self) -> Table:
        """sensitivity.csv as a structured array. A row per number of a sub-impact: "quantity" (its
        name with the unit), "sub_impact" (from 1), "value", for each key "d_<key>", the derivative
        by its logarithm, and "error_<key>", the error of that, both in the unit of the quantity;
        "flag": why they are not reliable, in words. NaN: a contact merges, splits or vanishes."""
        return self._study.table()

    def jacobian(self, quantity: Quantity) -> npt.NDArray[np.float64]:
        """The derivatives of one quantity by the logarithms of `keys`, of shape (sub-impacts that
        have it, keys), in its own unit, with which its name ends: "start_s", "end_s",
        "peak_force_N", "impulse_Ns", "max_indentation_m" or "striker_velocity_m_per_s". The change
        by one per cent of a key is a hundredth of its column. Raises ValueError for other names."""
        import numpy as np

        if quantity not in get_args(Quantity):
            raise ValueError(f"quantity is {quantity!r}; allowed: {', '.join(get_args(Quantity))}")
        rows = self.table[self.table["quantity"] == quantity]
        columns = [rows[f"d_{key}"] for key in self.keys]
        return np.stack(columns, axis=1) if columns else np.empty((len(rows), 0))

    @cached_property
    def base(self) -> Result:
        """The run about which the derivatives are taken, at a tolerance of 1e-13 or less, without
        history. If its case has [scatter], and the study all keys that scatter, it has standard
        deviations of event times and the horizon up to which they can be predicted."""
        return Result(self._study.base())

    @property
    def remarks(self) -> list[str]:
        """What differs from the case, and keys without derivatives, in sentences."""
        return self._study.remarks

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the study; `keys` are those whose runs had ended."""
        return self._study.interrupted

    def report(self) -> str:
        """The table that `subimpact sensitivity` prints: changes of event times per 1 %."""
        return self._study.report()

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes sensitivity.csv. Raises OutputError."""
        self._study.write(path_text(directory, OutputError))

    def __repr__(self) -> str:
        return f"<Sensitivity of {self.base!r} by {', '.join(self.keys) or 'no key'}>"


def sensitivity(
    case: Case,
    by: str | Sequence[str] = (),
    *,
    jobs: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> Sensitivity:
    """Derivatives of start, end, peak force, impulse, indentation and striker velocity of every
    sub-impact by the logarithms of keys, as `subimpact sensitivity` computes them: from two pairs
    of runs per key, whose mismatch gives the error of each derivative.

    by        keys; none: all numbers of beam, striker and contact that take effect
    jobs      threads; results do not depend on it
    progress  called with the number of runs that ended, and of all; False ends the study

    Other Python threads go on meanwhile. After Ctrl-C there are the keys whose runs had ended; if
    there are none, KeyboardInterrupt is raised. A base run that fails leaves no derivatives: see
    `base`. Raises CaseError for a case that cannot be run, and for a key without a derivative.
    """
    check_jobs(jobs)
    check_progress(progress)
    keys = [by] if isinstance(by, str) else list(by)
    return Sensitivity(_core.sensitivity(as_case(case)._load(), keys, jobs, progress))
