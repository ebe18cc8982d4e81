"""Arguments that several functions take."""

from __future__ import annotations

import math
from numbers import Integral, Real

#: s: three years.
LONGEST = 1e8
#: Of a timeout, in words.
ALLOWED_TIMEOUT = f"seconds above 0, up to {LONGEST:g}; leave it out for no limit"


def is_whole(value: object, least: int, most: int) -> bool:
    """Whether this is a whole number within bounds."""
    return isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) <= most


def is_positive(value: object, most: float = math.inf) -> bool:
    """Whether this is a finite number above 0, up to `most`."""
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        return 0 < float(value) <= most and math.isfinite(value)
    except OverflowError:
        return False


def check_jobs(jobs: object) -> None:
    """Raises ValueError."""
    if not is_whole(jobs, 1, 2**31):
        raise ValueError(f"jobs is {jobs!r}; allowed: a whole number of threads, 1 or more")


def check_timeout(timeout: object) -> None:
    """Raises ValueError."""
    if timeout is not None and not is_positive(timeout, LONGEST):
        raise ValueError(f"timeout is {timeout!r}; allowed: {ALLOWED_TIMEOUT}")


def check_progress(progress: object) -> None:
    """Raises TypeError."""
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is {progress!r}; allowed: a function, such as print, or None")
