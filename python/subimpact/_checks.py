"""Arguments that several functions take."""

from __future__ import annotations

import math
from numbers import Integral, Real
from typing import Any

from . import _core
from ._text import is_unicode

#: s: three years.
LONGEST = 1e8
#: Of a timeout, in words.
ALLOWED_TIMEOUT = f'seconds above 0, up to {LONGEST:g}, or a text such as "90 s"; leave it out for no limit'


def is_whole(value: object, least: int, most: int) -> bool:
    return isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) <= most


def is_positive(value: object, most: float = math.inf) -> bool:
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


def seconds(timeout: Any, kind: type[ValueError] = ValueError) -> float | None:
    """A timeout such as 60.0 or "60 s", s. Raises `kind`."""
    time = _core.value_in("s", timeout) if isinstance(timeout, str) and is_unicode(timeout) else timeout
    if timeout is not None and not is_positive(time, LONGEST):
        raise kind(f"timeout is {timeout!r}; allowed: {ALLOWED_TIMEOUT}")
    return None if time is None else float(time)


def check_progress(progress: object) -> None:
    """Raises TypeError."""
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is {progress!r}; allowed: a function, such as print, or None")
