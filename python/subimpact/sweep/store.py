"""Where the rows of a sweep are kept: one file, to which one process adds lines. A line is a row as JSON, after its checksum. A
row is there whole or not at all, whenever the process or the machine stops: the next one writes over a last line without an end.
Damaged lines are left aside, and their cases run again."""

from __future__ import annotations

import json
import os
import stat
import zlib
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from .. import _core
from .._errors import OutputError, StoreError
from .._text import path_text
from .worker import Row

FILE = "sweep.rows"
KIND = "sweep"  # of results, in manifest.json
SECONDS_OF_THE_DYING = 2.0  # for which workers of a killed sweep may hold its lock
_HEADING = b"subimpact: rows of a sweep, layout 5\n"


def _line(row: Row) -> bytes:
    text = json.dumps(row).encode()
    return b"%08x %b\n" % (zlib.crc32(text), text)


def _row(line: bytes) -> Row | None:
    """The row of a line, if it is as it was written."""
    is_right = line[:9] == b"%08x " % zlib.crc32(line[9:-1])
    return Row(*json.loads(line[9:])) if is_right else None


class Store:
    """The rows of a sweep by identity, in a directory of their own, which no other process writes
    into meanwhile. The tables of the sweep are written into `output.staging` and put in place, as one, by
    `output.commit`; the store itself is not among the files that manifest.json lists."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        """Opens or makes the store. Raises StoreError if another process has it, if the file is no
        store, or if the directory holds other results; OutputError if it cannot be written."""
        self.directory = Path(path_text(directory, StoreError))
        self.path = self.directory / FILE
        self.notes: list[str] = []  #: messages for the user: what was damaged
        self.outcomes: dict[str, str] = {}  #: of every row, by its identity
        self.identities: dict[str, str] = {}  #: of every row, by its place
        self._starts: dict[str, int] = {}  # of lines, by identity
        self._end = 0  # of the last whole line
        try:
            self.output = _core.OutputDirectory(str(self.directory), KIND, SECONDS_OF_THE_DYING)
        except OutputError as error:
            raise StoreError(str(error)) from None
        try:
            self._read()
            if self._end == 0:
                self._write(_HEADING)
                self._end = len(_HEADING)
        except BaseException:
            self.close()
            raise

    def _read(self) -> None:
        if not os.path.lexists(self.path):
            return
        if not stat.S_ISREG(self.path.lstat().st_mode):  # a store is no way to files elsewhere
            raise StoreError(
                f"{self.path}: is a symbolic link or another thing that is no regular file, which a store "
                "has to be; move it away, or choose another directory with --out"
            )
        n_wrong = 0
        try:
            with open(self.path, "rb") as file:
                heading = file.readline(len(_HEADING))
                if not _HEADING.startswith(heading):
                    raise StoreError(
                        f"{self.path}: is no store of a sweep by this version, or its beginning is damaged; move "
                        "it away to begin anew, or choose another directory with --out"
                    )
                self._end = len(heading) if heading == _HEADING else 0
                for line in file:
                    if not line.endswith(b"\n"):
                        break
                    row = _row(line)
                    n_wrong += row is None
                    self._keep(row, len(line))
        except OSError as error:
            raise StoreError(
                f"{self.path}: cannot be read ({error.strerror}); change its permissions, or choose "
                "another directory with --out"
            ) from None
        if n_wrong:
            self.notes.append(
                f"{self.path}: is damaged, with {n_wrong} wrong rows; {len(self.outcomes)} of its rows are right "
                "and kept, cases without one are run again"
            )

    def _keep(self, row: Row | None, n: int) -> None:
        """Takes note of what the next line, of n bytes, holds."""
        if row is not None:
            self.outcomes[row.identity] = row.outcome
            self.identities[row.place] = row.identity
            self._starts[row.identity] = self._end
        self._end += n

    def _write(self, text: bytes) -> None:
        try:
            with open(self.path, "r+b" if self._end else "wb") as file:
                file.seek(self._end)
                file.truncate()
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            raise OutputError(
                f"{self.path}: cannot be written ({error.strerror}); make room, and start the sweep again: it "
                "goes on from the rows that are stored"
            ) from None

    def add(self, rows: Iterable[Row]) -> None:
        """Stores rows. Raises OutputError."""
        lines = {row: _line(row) for row in rows}
        self._write(b"".join(lines.values()))
        for row, line in lines.items():
            self._keep(row, len(line))

    def rows_of(self, identities: Sequence[str]) -> Iterator[Row | None]:
        """The rows with these identities, in their order; None for those there are not."""
        with open(self.path, "rb") as file:
            for identity in identities:
                if identity in self._starts:
                    file.seek(self._starts[identity])
                    yield _row(file.readline())
                else:
                    yield None

    def rows(self) -> Iterator[Row]:
        return filter(None, self.rows_of(list(self._starts)))

    def drop(self, outcomes: Sequence[str]) -> None:
        for identity in [identity for identity, outcome in self.outcomes.items() if outcome in outcomes]:
            del self.outcomes[identity], self._starts[identity]

    def close(self) -> None:
        """Another process may open the store then."""
        self.output.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
