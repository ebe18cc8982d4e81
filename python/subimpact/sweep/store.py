"""Where the rows of a sweep are kept: one SQLite file, written by one process.

A row is there whole or not at all, whenever the process or the machine stops. Each has a checksum of
its own. A damaged file is replaced by one with the rows that are still right; the others are run
again.
"""

from __future__ import annotations

import csv
import os
import sqlite3
import stat
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from .. import _core
from .._errors import OutputError, StoreError
from .._text import path_text
from .worker import COLUMNS, Row

FILE = "sweep.sqlite"
KIND = "sweep"  # of results, in manifest.json
SECONDS_OF_THE_DYING = 2.0  # for which workers of a killed sweep may hold its lock
_LAYOUT = 4
_READ_AT_ONCE = 500  # rows; SQLite allows a query at least 999 values
_APPLICATION = 0x53554249  # "SUBI"
_MAGIC = b"SQLite format 3\0"
_ALL = "SELECT identity, outcome, cells, sub_impacts, place, checksum FROM rows"
_TABLE = (
    "CREATE TABLE rows (identity TEXT PRIMARY KEY, outcome TEXT NOT NULL, cells TEXT NOT NULL, "
    "sub_impacts TEXT NOT NULL, place TEXT NOT NULL, checksum INTEGER NOT NULL)"
)


def checksum(row: Row) -> int:
    """Of all that is stored of a row."""
    return zlib.crc32("\n".join(row).encode())


def _checked(values: tuple[str, str, str, str, str, int]) -> Row | None:
    """The row, if it is as it was written."""
    try:
        row = Row(*values[:5])
        is_right = checksum(row) == values[5] and len(next(csv.reader([row.cells]))) == len(COLUMNS)
    except (AttributeError, TypeError, UnicodeError, csv.Error, StopIteration):
        return None
    return row if is_right else None


class Store:
    """The rows of a sweep by identity, in a directory of their own, which no other process writes
    into meanwhile. The tables of the sweep are written into `staging` and put in place, as one, by
    `commit`; the store itself is not among the files that manifest.json lists."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        """Opens or makes the store. Raises StoreError if another process has it, if the file is no
        store, or if the directory holds other results; OutputError if it cannot be written."""
        self.directory = Path(path_text(directory, StoreError))
        self.path = self.directory / FILE
        self.notes: list[str] = []  #: messages for the user: what was damaged
        self._output = self._locked()
        try:
            self._refuse_links()
            self._connection = self._opened()
        except BaseException:
            self._output.close()
            raise

    @property
    def staging(self) -> Path:
        """The hidden directory for new files."""
        return Path(self._output.staging)

    def commit(self) -> None:
        """Puts the files of `staging` in place, and removes those of the sweep before. Raises
        OutputError."""
        self._output.commit()

    def _locked(self) -> _core.OutputDirectory:
        try:
            return _core.OutputDirectory(str(self.directory), KIND, SECONDS_OF_THE_DYING)
        except OutputError as error:
            raise StoreError(str(error)) from None

    def _refuse_links(self) -> None:
        """A store is no way to files elsewhere."""
        for path in (self.path, Path(f"{self.path}-journal")):
            if os.path.lexists(path) and not stat.S_ISREG(path.lstat().st_mode):
                raise StoreError(
                    f"{path}: is a symbolic link or another thing that is no regular file, which a store "
                    "has to be; move it away, or choose another directory with --out"
                )

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            raise OutputError(
                f"{self.path}: cannot be written ({error}); make room, and start the sweep again: it "
                "goes on from the rows that are stored"
            ) from None

    def _opened(self) -> sqlite3.Connection:
        if not self.path.exists() or self.path.stat().st_size == 0:
            return self._made()
        try:
            with open(self.path, "rb") as file:
                is_sqlite = file.read(len(_MAGIC)) == _MAGIC
        except OSError as error:
            raise StoreError(
                f"{self.path}: cannot be read ({error.strerror}); change its permissions, or choose "
                "another directory with --out"
            ) from None
        if not is_sqlite:
            raise StoreError(
                f"{self.path}: is no store of a sweep, or its beginning is damaged; move it away to "
                "begin anew, or choose another directory with --out"
            )
        connection = self._connected()
        try:
            self._check_layout(connection)
            damage = connection.execute("PRAGMA integrity_check(1)").fetchone()[0]
            wrong = sum(_checked(values) is None for values in connection.execute(_ALL))
            if damage == "ok" and not wrong:
                return connection
            damage = f"{wrong} wrong rows" if damage == "ok" else damage
        except (sqlite3.DatabaseError, OverflowError) as error:
            damage = str(error)
            if "locked" in damage:
                connection.close()
                raise StoreError(f"{self.path}: is in use by another program; wait for its end") from None
        except (StoreError, OutputError):
            connection.close()
            raise
        rows = self._readable_rows(connection)
        connection.close()
        return self._salvaged(rows, damage)

    def _connected(self) -> sqlite3.Connection:
        connection = sqlite3.connect(self.path)
        connection.text_factory = lambda text: text.decode(errors="replace")
        return connection

    def _made(self) -> sqlite3.Connection:
        with self._writing():
            connection = self._connected()
            try:
                self._fill(connection)
            except BaseException:
                connection.close()
                raise
        return connection

    def _fill(self, connection: sqlite3.Connection) -> None:
        with self._writing():
            connection.isolation_level = None
            connection.execute("BEGIN IMMEDIATE")
            connection.execute(f"PRAGMA application_id = {_APPLICATION}")
            connection.execute(f"PRAGMA user_version = {_LAYOUT}")
            connection.execute(_TABLE)
            connection.execute("COMMIT")
            connection.isolation_level = ""

    def _check_layout(self, connection: sqlite3.Connection) -> None:
        application = connection.execute("PRAGMA application_id").fetchone()[0]
        layout = connection.execute("PRAGMA user_version").fetchone()[0]
        tables = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        if tables == 0:  # stopped before the first commit
            self._fill(connection)
        elif application != _APPLICATION:
            raise StoreError(f"{self.path}: is the database of another program; choose another directory")
        elif layout != _LAYOUT:
            raise StoreError(
                f"{self.path}: has layout {layout}, and this version reads {_LAYOUT}; use the version "
                "that wrote it, or choose another directory"
            )

    @staticmethod
    def _readable_rows(connection: sqlite3.Connection) -> list[Row]:
        """Those that can still be read, from either end of the table, each as it was written."""
        found: dict[str, Row] = {}
        for order in ("ASC", "DESC"):
            try:
                for values in connection.execute(f"{_ALL} ORDER BY rowid {order}"):
                    row = _checked(values)
                    if row is not None:
                        found[row.identity] = row
            except (sqlite3.DatabaseError, OverflowError):
                continue
        return list(found.values())

    def _salvaged(self, rows: list[Row], damage: str) -> sqlite3.Connection:
        kept = self.path.with_suffix(".damaged")
        number = 1
        while os.path.lexists(kept):
            number += 1
            kept = self.path.with_suffix(f".damaged-{number}")
        os.replace(self.path, kept)
        journal = Path(f"{self.path}-journal")
        if journal.exists():
            journal.unlink()
        connection = self._made()
        with self._writing():
            self._insert(connection, rows)
        self.notes.append(
            f"{self.path}: was damaged ({damage}); {len(rows)} of its rows could be read and are kept, "
            f"the others will be run again; the damaged file is {kept.name}"
        )
        return connection

    @staticmethod
    def _insert(connection: sqlite3.Connection, rows: Iterable[Row]) -> None:
        with connection:
            connection.executemany(
                "INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?, ?, ?)",
                [(*row, checksum(row)) for row in rows],
            )

    def add(self, rows: Iterable[Row]) -> None:
        """Stores rows, all at once. Raises OutputError."""
        with self._writing():
            self._insert(self._connection, rows)

    def take(self, other: Store) -> None:
        """Stores all rows of another store. Raises OutputError."""
        self.add(list(other.rows()))
        self.notes += other.notes

    def outcomes(self) -> dict[str, str]:
        """The outcome of every row by its identity."""
        return dict(self._connection.execute("SELECT identity, outcome FROM rows"))

    def places(self) -> dict[str, str]:
        """The identity of every row by its place."""
        return dict(self._connection.execute("SELECT place, identity FROM rows"))

    def rows_of(self, identities: Sequence[str]) -> Iterator[Row | None]:
        """The rows with these identities, in their order; None for those there are not."""
        for start in range(0, len(identities), _READ_AT_ONCE):
            part = identities[start : start + _READ_AT_ONCE]
            marks = ",".join("?" * len(part))
            found = self._connection.execute(f"{_ALL} WHERE identity IN ({marks})", part)
            rows = {values[0]: Row(*values[:5]) for values in found}
            yield from map(rows.get, part)

    def drop(self, outcomes: Iterable[str]) -> None:
        """Removes the rows with these outcomes. Raises OutputError."""
        with self._writing(), self._connection:
            self._connection.executemany(
                "DELETE FROM rows WHERE outcome = ?", [(outcome,) for outcome in outcomes]
            )

    def rows(self) -> Iterator[Row]:
        """All rows."""
        for values in self._connection.execute(_ALL):
            yield Row(*values[:5])

    def close(self) -> None:
        """Closes the file; another process may open it then. What was not committed is dropped."""
        self._connection.close()
        self._output.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

