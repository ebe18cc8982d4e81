"""What the package raises."""

from __future__ import annotations

import re

# "strike.toml:12:8: solver.step is ..." and "case["solver.step"]: solver.step is ..."
_PLACE = re.compile(r"^.*?:(\d+):\d+: ")
_KEY = re.compile(r'(?:^|: )(?:unknown key "([^"]+)"|([a-z_]+(?:\.[a-z_]+)*) (?:is|are|cannot|has|have|and) )')


class CaseError(ValueError):
    """A case that cannot be read or run.

    The message has one line per problem: where it is, what is wrong, what is allowed and what to
    do. `problems` holds these lines; `key` is the key of the first one ("" if it has none) and
    `line` its line in the file or text (None if it is not from there).
    """

    def __init__(self, message: str, key: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.problems = tuple(message.splitlines())
        place = _PLACE.match(message)
        self.line = int(place.group(1)) if place else None
        self.key = key
        if not key:
            found = _KEY.search(message)
            self.key = (found.group(1) or found.group(2)) if found else ""

    def __reduce__(self) -> tuple[type[CaseError], tuple[str, str]]:
        return type(self), (self.message, self.key)


class OutputError(OSError):
    """Files that cannot be written; the message names them, the cause and what to do."""


class PlanError(ValueError):
    """The plan of a sweep that cannot be read; the message has what is wrong and what is allowed."""


class StoreError(RuntimeError):
    """The store of a sweep that cannot be used."""


class ResultsError(ValueError):
    """Files of a run that cannot be read back."""
