"""The numbers that the scripts of a page draw, packed as web/data.js reads them: base64 of little-endian floating-point
numbers, named by their kind (f64, f32). Of long histories the rows with the extremes of equal spans are kept, of many or fine
shapes those at events and every n-th."""

from __future__ import annotations

import base64
import sys
from array import array
from bisect import bisect
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any

from .._files import Files

# Sizes that keep a page below 5 MB.
_MOST_HISTORY_ROWS = 22_000
_MOST_POINTS = 600  # of a shape
_MOST_SHAPE_ROWS = 180_000  # of all shapes

Row = list[str]
Events = list[dict[str, Any]]


def number(cell: str) -> float | None:
    return float(cell) if cell else None


def packed(kind: str, values: Iterable[float]) -> dict[str, str]:
    """As "f64" or "f32"."""
    numbers = array("d" if kind == "f64" else "f", values)
    if sys.byteorder == "big":
        numbers.byteswap()
    return {kind: base64.b64encode(numbers.tobytes()).decode()}


def thinned(rows: Iterator[Row], n_rows: int, most: int = _MOST_HISTORY_ROWS) -> Iterator[Row]:
    """All of the rows, or of a table with more than `most` those that a chart needs: it is cut into spans, and each leaves
    its first row and, for every column but the time, the rows where it is smallest and largest. The last row is kept."""
    if n_rows <= most:
        yield from rows
        return
    first = next(rows, None)
    if first is None:
        return
    span = n_rows // max(most // (2 * len(first) - 1), 1) + 1
    block = [first, *islice(rows, span - 1)]
    while block:
        kept = {0}
        for cells in list(zip(*block))[1:]:
            if cells.count(cells[0]) < len(cells) and "" not in cells:  # it changes
                values = list(map(float, cells))
                kept.update((values.index(min(values)), values.index(max(values))))
        yield from (block[i] for i in sorted(kept))
        last, last_kept = block[-1], max(kept) == len(block) - 1
        block = list(islice(rows, span))
    if not last_kept:
        yield last


def history(files: Files, n_rows: int) -> tuple[dict[str, Any], int]:
    """The columns of history.csv, and how many rows they have; none of a run that kept none."""
    rows = files.lines("history.csv")
    heading: Row = next(rows, [])
    kept = list(thinned(rows, n_rows))
    return {name: packed("f64" if name == "time_s" else "f32", [float(cell or "nan") for cell in cells])
            for name, cells in zip(heading, zip(*kept))}, len(kept)


def _every_nth(n: int, most: int) -> list[int]:
    """Every n-th index so that some `most` are left, and the last."""
    return sorted({*range(0, n, -(-n // most)), n - 1})


def shapes(files: Files, n_points: int, n_rows: int, struck_at: float, events: Events) -> tuple[dict[str, Any], list[int], int]:
    """The fields along the beam at the instants that a page has; the points it has of each, and how many shapes."""
    lines = files.lines("shapes.csv")
    heading = next(lines)
    time, *wanted = (heading.index(name) for name in (
        "time_s", "position_m", "displacement_m", "moment_Nm", "plastic_curvature_per_m"))
    n = n_rows // n_points
    points: list[int] = []
    times, fields = [], [[], [], []]  # type: ignore[var-annotated]
    n_events, event_times = 0, [event["time"] for event in events]
    for k, block in enumerate(iter(lambda: list(islice(lines, n_points)), [])):
        if k == 0:
            positions = [float(row[wanted[0]]) for row in block]
            nearest = min(range(len(block)), key=lambda i: abs(positions[i] - struck_at))
            points = sorted({*_every_nth(len(block), _MOST_POINTS), nearest})
            most = max(_MOST_SHAPE_ROWS // len(points), 2)
            regular = set(_every_nth(n, most // 2 if n > most else n))
            spare = most - len(regular)
        now = float(block[0][time])
        n_before, n_events = n_events, bisect(event_times, now)
        if k not in regular:
            if n_events == n_before or spare <= 0:
                continue
            spare -= 1
        times.append(now)
        for field, column in zip(fields, wanted[1:]):
            field.extend([float(block[i][column]) for i in points])
    width, plastic = len(points), fields[2]
    at = [i for i in range(width) if any(plastic[i::width])]
    return {"times": packed("f64", times), "positions": packed("f64", [positions[i] for i in points]),
            "displacement": packed("f32", fields[0]), "moment": packed("f32", fields[1]), "plastic_points": at,
            "plastic": packed("f32", [plastic[k + i] for k in range(0, len(plastic), width) for i in at])}, points, len(times)


def envelope(files: Files, points: Sequence[int]) -> dict[str, Any]:
    rows = files.table("envelope.csv")

    def column(name: str) -> list[float]:
        return [float(rows[i][name]) for i in points]

    def extremes(name: str) -> dict[str, list[float]]:
        return {"largest": column(f"max_{name}"), "smallest": column(f"min_{name}")}

    return {"positions": column("position_m"), "displacement": extremes("displacement_m"), "moment": extremes("moment_Nm"),
            "permanent_set": column("set_against_supports_m")}
