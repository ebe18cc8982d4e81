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

_EMPTY = {"f": "nan", "i": "-1", "U": ""}  # by the kind of a column


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
        empty = _core.no_rows(name)
        if file not in self.files:
            return empty
        heading, *rows = csv.reader(self.files[file].decode(errors="replace").splitlines())
        if any(len(row) != len(heading) for row in rows):
            raise ResultsError(f"{file}: has rows of other than {len(heading)} cells; run the case again")
        known = empty.dtype.names or ()  # not of gauges
        kinds = [empty.dtype[column].kind if column in known else "f" for column in heading]
        types = [f"U{max([16, *(len(row[k]) for row in rows)])}" if kind == "U" else f"{kind}8" for k, kind in enumerate(kinds)]
        cells = [tuple(cell or _EMPTY[kind] for cell, kind in zip(row, kinds)) for row in rows]
        table = np.array(cells, list(zip(heading, types)))
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
