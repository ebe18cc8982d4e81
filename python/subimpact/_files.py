"""The files of a finished run or sweep, each as the manifest of its directory lists it. Needs neither NumPy nor the
module of C++."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import os
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO

from ._errors import ResultsError
from ._text import path_text

#: The version of the layout of summary.json and of report.json.
LAYOUTS = {"summary.json": 6, "report.json": 1}

MANIFEST = "manifest.json"
_MANIFEST_LAYOUT = 1
_AGAIN = "run the case again"

def fingerprint(file: BinaryIO) -> dict[str, Any]:
    """Of the whole of a file, as a manifest has it; the file is then at its beginning."""
    digest, n = hashlib.sha256(), 0
    while block := file.read(1 << 20):
        digest.update(block)
        n += len(block)
    file.seek(0)
    return {"bytes": n, "sha256": digest.hexdigest()}


def parsed(path: str | os.PathLike[str], text: bytes, what: str, remedy: str = _AGAIN) -> dict[str, Any]:
    """The object that a JSON file holds. Raises ResultsError."""
    try:
        json_object: dict[str, Any] = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ResultsError(f"{path}: is not {what} ({error}); {remedy}") from None
    if not isinstance(json_object, dict):
        raise ResultsError(f"{path}: is not {what}; {remedy}")
    return json_object


def read_manifest(directory: Path) -> dict[str, Any] | None:
    """manifest.json of a directory, None if there is none. Raises ResultsError."""
    path = directory / MANIFEST
    if not os.path.lexists(path):
        return None
    what = "a manifest of this program"
    with _opened(path) as file:
        manifest = parsed(path, file.read(), what)
    layout, files, commit = (manifest.get(name) for name in ("subimpact_manifest", "files", "commit"))
    if isinstance(layout, int) and layout > _MANIFEST_LAYOUT:
        raise ResultsError(f"{path}: a later version of this program wrote it; use that version")
    is_one = isinstance(layout, int) and isinstance(files, dict) and isinstance(commit, str) and commit.isalnum()
    if not is_one or not all(isinstance(manifest.get(name), str) for name in ("kind", "identity")):
        raise ResultsError(f"{path}: is not {what}; {_AGAIN}")
    return manifest


def _opened(path: Path) -> BinaryIO:
    cause: object = "it is no regular file"
    try:
        if path.is_file() or not path.exists():  # a pipe or a device may never end
            return open(path, "rb")
    except OSError as error:
        cause = error.strerror
    raise ResultsError(f"{path}: cannot be read ({cause}); give the output directory of `subimpact run`")


class Files:
    """The files of a directory. Raises ResultsError for what is no directory of results."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = Path(path_text(directory, ResultsError))
        if not self.directory.is_dir():
            raise ResultsError(f"{self.directory}: is not a directory; give the output directory of `subimpact run` (--out)")
        self.manifest = read_manifest(self.directory)

    @property
    def identity(self) -> str:
        return str(self.manifest["identity"]) if self.manifest else ""

    @property
    def listed(self) -> dict[str, Any]:
        """Fingerprints of the files, by their names."""
        return self.manifest["files"] if self.manifest else {}

    @property
    def again(self) -> str:
        """What to do about files that are damaged."""
        return "run the sweep again; it keeps the runs in its store" if "runs.csv" in self.listed else _AGAIN

    @property
    def holds_sweep(self) -> bool:
        return (self.directory / "runs.csv").exists() and not (self.directory / "summary.json").exists()

    def open(self, name: str) -> BinaryIO:
        """A file with the length and the checksum of the manifest. Raises ResultsError."""
        path = self.directory / name
        if self.manifest is None or self.manifest["kind"] in ("figures", "report"):  # of an earlier version
            return _opened(path)
        if name not in self.listed:
            raise ResultsError(f"{path}: is not among the results of `subimpact {self.manifest['kind']}` that {MANIFEST} lists"
                               + ("; a row per run is in runs.csv, for pandas.read_csv" if "runs.csv" in self.listed else ""))
        # What is not yet in its place waits under the name of its commit.
        for place in (path, self.directory / f".subimpact-{self.manifest['commit']}" / name, path):
            if not place.exists():
                continue
            file = _opened(place)
            if fingerprint(file) == self.listed[name]:
                return file
            file.close()
        raise ResultsError(f"{path}: is not the file that the run wrote (its length or checksum differs from {MANIFEST}): "
                           f"it was changed or cut short since, or a run is replacing it; read it again, or {self.again}")

    def read(self, name: str) -> bytes:
        with self.open(name) as file:
            return file.read()

    def json(self, name: str, what: str) -> dict[str, Any]:
        """An object of this version of the program. Raises ResultsError."""
        if name not in self.listed and name == "report.json" and "summary.json" in self.listed:
            raise ResultsError(f"{self.directory}: has no report.json, of which a page is made: an earlier version wrote it, or "
                               f"a program that uses the library; {_AGAIN}")
        found = parsed(self.directory / name, self.read(name), what)
        if found.get("layout") != LAYOUTS[name]:
            raise ResultsError(f"{self.directory / name}: has layout {found.get('layout')}, but this program reads layout "
                               f"{LAYOUTS[name]}; use the program that wrote it")
        return found

    @cached_property
    def of_run(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """summary.json and report.json of a run. Raises ResultsError."""
        summary = self.json("summary.json", "the summary of a run")
        self.check_run()
        return summary, self.json("report.json", "the report of a run")

    def check_run(self) -> None:
        """Raises ResultsError for a directory without the manifest of a run."""
        if not self.manifest or self.manifest["kind"] != "run":
            raise ResultsError(f"{self.directory}: has no {MANIFEST} of a run, without which nothing shows that its files belong "
                               f"together; {_AGAIN}")

    def lines(self, name: str) -> Iterator[list[str]]:
        """The heading and the rows of a table; in those of a sweep texts may be quoted."""
        with io.TextIOWrapper(self.open(name), "utf-8", "replace", newline="\n") as file:
            for line in file:
                yield next(csv.reader([line])) if '"' in line else line.rstrip("\n").split(",")

    def table(self, name: str) -> list[dict[str, str]]:
        """The rows of a short table. Raises ResultsError."""
        heading, *rows = list(self.lines(name)) or [[""]]
        for number, row in enumerate(rows, 2):
            if len(row) != len(heading):
                raise ResultsError(f"{self.directory / name}:{number}: has {len(row)} cells where the header has {len(heading)}")
        return [dict(zip(heading, row)) for row in rows]
