"""A finished run in its files."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from ._errors import OutputError, ResultsError
from ._files import Files
from ._text import path_text

if TYPE_CHECKING:
    import numpy.typing as npt

_WHOLE = {"index", "zone", "subzone", "certain", "section", "spring", "strike", "sub_impacts"}
_WORDS = {"kind", "doubt"}


class Stored:
    """What `_core.Finished` is for a run that was just made: `files` are the bytes of its files by their names."""

    interrupted = timed_out = False

    def __init__(self, files: dict[str, bytes]) -> None:
        self.files = files

    @classmethod
    def read(cls, directory: str | os.PathLike[str]) -> Stored:
        """Raises ResultsError."""
        files = Files(directory)
        files.json("summary.json", "the summary of a run")
        files.check_run()
        return cls({name: files.read(name) for name in files.listed if name.endswith((".csv", ".json", ".toml"))})

    def table(self, name: str) -> npt.NDArray[np.void]:
        """A structured array, read-only. Empty cells: NaN, -1, ""."""
        file = f"{'events' if name == 'sub_impacts' else name}.csv"
        if file not in self.files:
            return _core.no_rows(name)
        heading, _, body = self.files[file].partition(b"\n")
        names = heading.decode().split(",")
        if _WORDS.isdisjoint(names):
            columns = list(_numbers(body, len(names), file).T)
        else:
            rows = list(csv.reader(body.decode(errors="replace").splitlines()))
            if any(len(row) != len(names) for row in rows):
                raise ResultsError(f"{file}: has rows of other than {len(names)} cells; run the case again")
            cells = list(zip(*rows)) or [()] * len(names)
            columns = [np.array(column) if each in _WORDS else np.array([float(cell or "nan") for cell in column])
                       for each, column in zip(names, cells)]
        formats = [f"U{max(16, *map(len, column.tolist()), 0)}" if each in _WORDS else "i8" if each in _WHOLE else "f8"
                   for each, column in zip(names, columns)]
        table = np.empty(len(columns[0]), dtype=np.dtype(list(zip(names, formats))))
        for each, column in zip(names, columns):
            table[each] = np.nan_to_num(column, nan=-1) if each in _WHOLE else column
        table.flags.writeable = False
        return table

    def write(self, directory: str) -> None:
        """Raises OutputError."""
        write_files(directory, "run", self.files)

    def summary(self) -> str:
        return self.files["summary.json"].decode(errors="replace")

    def report_json(self) -> str:
        if "report.json" not in self.files:
            raise ResultsError("the results have no report.json: a program that uses the library wrote them; run the case with "
                               "`subimpact run` or `subimpact.run`")
        return self.files["report.json"].decode(errors="replace")


def write_files(directory: str | os.PathLike[str], kind: str, files: Mapping[str, bytes]) -> None:
    """Writes files into a directory of results of this kind, all as one. Raises OutputError."""
    with closing(_core.OutputDirectory(path_text(directory, OutputError), kind)) as output:
        try:
            for name, content in files.items():
                Path(output.staging, name).write_bytes(content)
        except OSError as error:
            raise OutputError(f"{os.fsdecode(directory)}: cannot be written ({error.strerror})") from None
        output.commit()


def _numbers(body: bytes, n_columns: int, file: str) -> npt.NDArray[np.float64]:
    if not body:
        return np.empty((0, n_columns))
    text = body.replace(b",,", b",nan,").replace(b",,", b",nan,").replace(b",\n", b",nan\n").replace(b"\n,", b"\nnan,")
    values = np.fromstring(text.replace(b"\n", b",").rstrip(b",").decode(), sep=",")
    if len(values) % n_columns:
        raise ResultsError(f"{file}: has rows of other than {n_columns} cells; run the case again")
    return values.reshape(-1, n_columns)
