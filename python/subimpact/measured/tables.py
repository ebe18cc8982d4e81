"""Tables of numbers as instruments and spreadsheets write them: where rows begin, and what heads them."""

from __future__ import annotations

import codecs
import csv
import re
from collections import Counter
from collections.abc import Iterator
from decimal import Decimal
from itertools import islice
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from .._errors import ResultsError
from .._text import one_line
from .units import BRACKETS, Unit, quantity, sensitivity_of, unit_in, unit_of

if TYPE_CHECKING:
    from ..result import Numbers

_EMPTY = ("", "nan", "-nan", "inf", "-inf", "+inf", "infinity", "-infinity", "∞", "-∞", "+∞", "n/a", "#n/a", "na",
          "null", "none", "--", "-", "overflow", "over", *(sign + text for sign in ("", "-", "+") for text in
                                                                   ("1.#qnan", "1.#snan", "1.#inf", "1.#ind", "nan(ind)")))
#: A cell with a time of day, with or without a date and a time zone, or with a span of days and hours.
_CLOCK = re.compile(r"(?:(?<=[,;\t\"])|^)(?:\d{1,4}[-./]\d{1,2}[-./]\d{1,4}[ T]|(-?\d+) days?,? ?\+?)?(\d{1,2}):(\d\d):(\d\d)([.,]\d+)?"
                    r"(?:Z|[-+]\d\d:?\d\d)?(?=[,;\t\"]|$)")
_NUMBER = re.compile(r"[-+]?(?:\d+[.,]?\d*|[.,]\d+|\d{1,3}(?:[.,]\d{3})+(?:[.,]\d*)?)(?:[eEdD][-+]?\d+)?")
_NUMBERS_ONLY = re.compile(r"[-+\d.,;|\s\"edEnaif∞]*\d[-+\d.,;|\s\"edEnaif∞]*", re.IGNORECASE)
#: What ordinates of universal files are, where these say no unit: of SI.
_UNIVERSAL = {0: "", 2: "", 3: "m/m", 9: "N", 12: "m/s^2", 13: "N"}
_MARKS = [re.compile(rf"\s*(?:[#%!*{more}]+|//+)\s*") for more in ("", ";")]  #: of comments; a semicolon may part cells
_INDEX = ("sequence", "sample", "samples", "index", "point", "points", "nr", "no", "")
_BOMS = {codecs.BOM_UTF8: "utf-8-sig", codecs.BOM_UTF32_LE: "utf-32", codecs.BOM_UTF32_BE: "utf-32",
         codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}


def _is_empty(cell: str) -> bool:
    return cell.lower() in _EMPTY


def _decoded(content: bytes, file: str) -> str:
    head = content[:2000]
    codec = next((name for bom, name in _BOMS.items() if content.startswith(bom)), None)
    if codec is None and b"\0" in head:
        codec = "utf-16-le" if head[1::2].count(0) > len(head) // 4 else "utf-16-be"
    try:
        text = content.decode(codec or "utf-8")
    except UnicodeDecodeError:
        text = "\0" if codec else content.decode("cp1252", "replace")
    if "\0" in text[:2000]:
        raise ResultsError(f"{file}: is no text; allowed: CSV and other tables of numbers; export it as CSV")
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\u2212", "-")
    text = re.sub(r"(^|[,;\t\"|])( *[-+]) +(?=[.,\d])", r"\1\2", text, flags=re.MULTILINE)  # "+ 0.300"
    if "'" in text or "\u2019" in text:
        text = re.sub(r"(?<=\d)['\u2019](?=\d{3})", "", text)  # thousands
    return re.sub(r"(?<=\d)[\u00a0\u202f](?=\d)", "", text) if "\u00a0" in text or "\u202f" in text else text


def _seconds(at: re.Match[str]) -> str:
    """Those of a time of day or a span, with the mark of its decimals."""
    mark = (at[5] or ".")[0]
    whole = 86400 * int(at[1] or 0) + 3600 * int(at[2]) + 60 * int(at[3]) + int(at[4])
    return str(whole + Decimal("0." + (at[5] or ".0")[1:])).replace(".", mark)


def _is_grouped(text: str, mark: str) -> bool:
    """Whether every `mark` in the text can stand between thousands."""
    numbers = re.findall(rf"[\d.,]*\{mark}[\d.,]*[eE]?", text)
    return all(re.fullmatch(rf"[1-9]\d{{0,2}}(\{mark}\d{{3}})+([.,]\d*)?", number) for number in numbers)


class Table:
    """The numbers of a file with what its heading and its metadata say about them."""

    def __init__(self, content: bytes, file: str, skip: int, rows: int | None,
                 separator: str | None, decimal: str | None) -> None:
        self.file = file
        self.lines = _decoded(content, file).split("\n")
        if self.lines[0].rstrip() == "    -1":
            self.lines = self._of_universal("\n".join(self.lines))
        self.metadata: dict[str, list[str]] = {}  #: values by keys of small letters and digits
        if first := re.fullmatch(r'"?sep=(.)"?', self.lines[0].strip("\ufeff ")):
            separator = separator or first[1]
            self.lines[0] = ""
        self.maker = next((name for name in ("LabVIEW", "LECROY") if self.lines[0].startswith(name)), "")
        self.lines[:skip] = [""] * min(skip, len(self.lines))
        self._read_clock()
        sample = self._sample()
        self.separator = separator or self._separator_of(sample)  #: " " for blanks
        self._is_paired = self.separator == decimal == "," and not any('"' in line for line in sample)
        self.decimal = decimal or self._decimal_of(sample)
        self._find_columns(sample)
        self._find_rows(rows)
        self._read_heading()

    def _of_universal(self, text: str) -> list[str]:
        """The records of a universal file (data set 58 in text) that are real functions of the same times, as a table."""
        columns: dict[str, Any] = {}
        for found in re.findall(r"^ {4}-1 *\n +58 *\n((?:.*\n){11})((?:.*\n)*?) {4}-1 *$", text, re.MULTILINE):
            head, numbers = found[0].split("\n"), np.array(re.findall(r"[-+]?\d+\.?\d*(?:[eEdD][-+]?\d+)?", found[1]), float)
            kind, _, is_even, start, step = map(float, head[6].split()[:5])
            abscissa, ordinate = (int(line.split()[0]) for line in head[7:9])
            if abscissa != 17 or ordinate not in _UNIVERSAL or kind not in (2, 4):  # of time; real
                continue
            times, values = (start + step * np.arange(len(numbers)), numbers) if is_even else (numbers[::2], numbers[1::2])
            units = [line[47:67].replace("NONE", "").strip() or usual for line, usual in ((head[7], "s"), (head[8], _UNIVERSAL[ordinate]))]
            if not columns or np.array_equal(next(iter(columns.values())), times):
                columns.setdefault(f"time [{units[0]}]", times)
                columns[f"record {len(columns)} [{units[1]}]"] = values
        if not columns:
            self.fail(1, "is a universal file without a real function of time (data set 58, in text); export it as CSV")
        return ["\t".join(columns), *("\t".join(map(repr, row)) for row in zip(*(each.tolist() for each in columns.values())))]

    def fail(self, line: int | None, text: str) -> NoReturn:
        """Refuses the file, or one of its lines, counted from 1."""
        raise ResultsError(f"{self.file}{f':{line}' if line else ''}: {one_line(text)}")

    def _bare(self, line: str) -> str:
        """The line without marks of a comment."""
        marks = _MARKS[self.separator != ";"].match(line)
        return line[marks.end():] if marks else line

    def _read_clock(self) -> None:
        """Puts seconds in place of times of day such as 12:03:04.123456."""
        self.has_clock = sum(bool(_CLOCK.search(line)) for line in self.lines[:200]) > min(3, len(self.lines) // 4)
        if self.has_clock:
            self.lines = [_CLOCK.sub(_seconds, line) for line in self.lines]

    def _sample(self) -> list[str]:
        """Lines that hold numbers alone, or else any from the later half."""
        n = len(self.lines)
        lines = self.lines if n <= 400 else self.lines[n // 2 : n // 2 + 200]
        lines = [line for line in lines if line.strip()]
        numbers = [line for line in lines if _NUMBERS_ONLY.fullmatch(line)]
        if not (sample := numbers if len(numbers) > len(lines) // 4 else lines[len(lines) // 2 :]):
            self.fail(None, "holds no rows of numbers; allowed: a table with a column of forces")
        return sample

    @staticmethod
    def _separator_of(sample: list[str]) -> str:
        for separator, pattern in ((";", ";"), ("|", r"\|"), (",", r",[\s\",]|,$|^,"), ("\t", "\t"),
                                   (" ", r"^[^:]*[^:\s] +[^:\s][^:]*$")):
            if 2 * sum(bool(re.search(pattern, line.strip(" "))) for line in sample) > len(sample):
                return separator
        return "," if any("," in line for line in sample) else " "

    def _decimal_of(self, sample: list[str]) -> str:
        """The mark of decimals, where it can be told."""
        text = "\n".join(sample)
        if self.separator == ",":  # commas within quotes
            text = "\n".join(re.findall(r'"([^"]*)"', text))
            if "," not in text:
                return "."
        if not any(mark in text for mark in ".,"):
            text = "\n".join(filter(_NUMBERS_ONLY.fullmatch, self.lines))
        marks = [mark for mark in ".," if mark in text]
        if both := re.findall(r"\d([.,])\d+([.,])\d", text):
            return next((last for first, last in both if first != last), "," if both[0][0] == "." else ".")
        plain = [mark for mark in marks if not _is_grouped(text, mark)]
        if marks and not plain:
            body = "\n".join(filter(_NUMBERS_ONLY.fullmatch, self.lines))
            plain = [mark for mark in marks if not _is_grouped(body, mark)]
        if len(plain) > 1 or (marks and not plain):
            self.fail(None, f"cannot be told whether {' and '.join(map(repr, marks))} in its numbers begin decimals or part "
                      "thousands; give decimal=. or decimal=,")
        return plain[0] if plain else "."

    def cells(self, line: str) -> list[str]:
        if self.separator == " ":
            return re.split(r"\s+(?![\[({])", line.strip())
        if '"' in line:
            return [cell.strip() for cell in next(csv.reader([line.strip(" ")], delimiter=self.separator,
                                                             skipinitialspace=True))]
        cells = [cell.strip() for cell in line.split(self.separator)]
        if self._is_paired:
            return [",".join(cells[i : i + 2]) for i in range(0, len(cells), 2)]
        return cells

    def _find_columns(self, sample: list[str]) -> None:
        rows = [self.cells(line) for line in sample]
        self.width = Counter(map(len, rows)).most_common(1)[0][0]
        rows = [row for row in rows if len(row) == self.width]
        columns = list(zip(*rows))
        self.columns = [j for j, cells in enumerate(columns)  #: that hold numbers
                        if 2 * sum(bool(_NUMBER.fullmatch(cell)) for cell in cells) >= len(cells)]
        if not self.columns:
            self.fail(None, "holds no rows of numbers; allowed: a table with a column of forces; separator=, says what "
                      "stands between its cells")
        before = self.columns[0] - 1
        self._is_bare_before = before >= 0 and all(cell == "" for cell in columns[before])

    def _is_row(self, cells: list[str]) -> bool:
        if self._is_bare_before and len(cells) > self.columns[0] and cells[self.columns[0] - 1]:
            return False
        mine = [cells[j] for j in self.columns if j < len(cells)]
        return any(map(_NUMBER.fullmatch, mine)) and all(_NUMBER.fullmatch(c) or _is_empty(c) for c in mine)

    def _find_rows(self, rows: int | None) -> None:
        filled = (i for i, line in enumerate(self.lines) if line.strip() and self._bare(line) is line)
        last = None
        for i in filled:
            is_row = self._is_row(self.cells(self.lines[i]))
            if is_row and last is not None:
                break
            last = i if is_row else None
        if last is None:
            self.fail(None, "holds no rows of numbers; allowed: a table with a column of forces")
        self.first = last  #: index of the line with the first row
        if rows is not None:
            del self.lines[self.first + rows :]

    def _is_units(self, cells: list[str]) -> bool:
        has = [unit_of(cell) is not None for cell in cells]
        return any(has) and all(known or cell.lower() in _INDEX
                                or re.fullmatch(r"[\[(].*[\])]", cell) is not None
                                or (j not in self.columns and _NUMBER.fullmatch(cell) is not None)
                                for j, (cell, known) in enumerate(zip(cells, has)))

    def _heading_cells(self, line: str) -> list[str] | None:
        """The cells of a line that can name the columns, whatever separates them."""
        bare = self._bare(line)
        if bare is not line and re.search("[:=]", bare):
            return None
        for pattern in (None, ",", ";", "\t", r"\s{2,}", r"\s+(?![\[({])"):
            cells = self.cells(bare) if pattern is None else [c.strip() for c in re.split(pattern, bare.strip())]
            mine = [cells[j] for j in self.columns if j < len(cells)]
            if any(re.match(r"[-+]?\d", cell) for cell in mine):
                return None
            if len(mine) == len(self.columns) and any(mine):
                return cells
        return self.cells(bare) if bare is line and (len(self.cells(bare)) > 1 or unit_in(bare)) else None

    def _read_heading(self) -> None:
        self.heading = 0  #: number of its line; 0: none
        self.names = [""] * self.width
        stated: list[dict[str, Unit]] = [{} for _ in range(self.width)]
        i = self.first - 1
        taken: dict[int, list[str]] = {}
        while i >= 0:
            cells = self._heading_cells(self.lines[i]) if self.lines[i].strip() else []
            if cells is None and self._bare(self.lines[i]) is self.lines[i]:
                self._check_whole(i)
                break
            if cells:
                taken[i] = cells
                is_units = self._is_units(cells)
                for j, cell in enumerate(cells[: self.width]):
                    if unit := unit_of(cell) if is_units else unit_in(cell):
                        stated[j][unit.symbol] = unit
                if not is_units or len(taken) == 2:
                    self.names[: len(cells)] = cells[: self.width]
                    self.heading = i + 1
                    break
                self.heading = i + 1
            i -= 1
        self.conflicts = {j: " and ".join(units) for j, units in enumerate(stated) if len(units) > 1}
        self.units = [next(iter(units.values())) if len(units) == 1 else None for units in stated]
        self._check_width(taken)
        self._read_metadata(taken)

    def _check_whole(self, i: int) -> None:
        """Refuses a line above the first row that is a row with a broken number."""
        cells = self.cells(self.lines[i])
        if i == self.first - 1 and len(cells) == self.width and _NUMBER.fullmatch(cells[self.columns[0]]):
            for j in self.columns:
                self._number(cells[j], i + 1, j)

    def _check_width(self, taken: dict[int, list[str]]) -> None:
        n_named = max((len(cells) for cells in taken.values()), default=self.width)
        if n_named < self.width and self.columns[-1] >= n_named and not self._is_paired:
            self.fail(self.first + 1, f"has {self.width} cells where the heading has {n_named}; if decimals begin with a comma, "
                      "give decimal=, and otherwise skip=N, the number of lines before the rows")
        if not taken and self.separator == "," and len(self.columns) > 2 and "." not in self.lines[self.first]:
            self.fail(self.first + 1, "has commas that may part cells or begin decimals; give decimal=, or write a heading")

    def _read_metadata(self, taken: dict[int, list[str]]) -> None:
        for i in range(min(self.first + 100, len(self.lines))):
            line = self._bare(self.lines[i])
            if i in taken:
                for cell in taken[i]:
                    self._note(*cell.partition("=")[::2])
                continue
            cells = self.cells(line) if i < self.first else self.cells(line)[: self.columns[0]]
            if self.separator == " " and i < self.first and len(parts := re.split(r"\s*[,;\t]\s*", line)) > 1:
                cells = parts
            if i < self.first and (match := re.match(r"\s*([^:=,;\t]+?)\s*[:=]\s*(.*)", line)):
                self._note(match[1], *filter(None, map(str.strip, re.split(r"[;\t]|,(?!\d)", match[2]))))
            elif cells:
                self._note(*filter(None, cells))
        rows = list(taken.values())
        if len(rows) == 2:  # "Start,Increment" above two numbers
            for name, value in list(zip(rows[1], rows[0]))[self.columns[-1] + 1 :]:
                self._note(name, value)

    def _note(self, key: str = "", *values: str) -> None:
        if not (key := key.strip()) or not values or not values[0]:
            return
        unit = unit_in(key)
        stated = unit.symbol if unit else bracket[1] if (bracket := BRACKETS.search(key)) else ""  # "Sensitivity [mV/N]"

        def plain(value: str) -> str:
            """With decimals after a point, and its unit; what may be thousands remains a text that is no number."""
            if number := quantity(value, self.decimal):
                return f"{number[0]!r} {number[1] or stated}".rstrip()
            return f"~{value}" if quantity(value) or quantity(value, ",") else value

        values = tuple(map(plain, values))
        if len(values) == 2 and re.fullmatch(r"[-+\d.e]+", values[0]):  # "Sensitivity,2.27,mV/N"
            both = f"{values[0]} {values[1]}"
            values = (both,) if unit_of(values[1]) or sensitivity_of(both) else values
        self.metadata.setdefault(re.sub(r"[\[({].*|[^a-z0-9]", "", key.lower()), list(values))

    def numbers(self, wanted: list[int]) -> Numbers:
        """The numbers of some columns, a row per row; NaN where there is none."""
        return np.column_stack([self._numbers_of(column) for column in wanted])

    def _numbers_of(self, column: int) -> Numbers:
        rows = [(line, cells[column] if column < len(cells) else "") for line, cells in self._rows_of_cells()]
        if self.decimal == "." and not any("_" in cell for _, cell in rows):
            try:
                return np.array([cell or "nan" for _, cell in rows], float)
            except ValueError:  # words in place of numbers, thousands, or a cell that is to be refused
                pass
        return np.array([float(self._number(cell, line, column)) for line, cell in rows])

    def line_of(self, row: int) -> int:
        """The number of the line of a row of `numbers`."""
        return next(islice(self._rows_of_cells(), row, None))[0]

    def _rows_of_cells(self) -> Iterator[tuple[int, list[str]]]:
        last = len(self.lines)
        while not _NUMBER.search(self.lines[last - 1]) or not self._is_row(self.cells(self.lines[last - 1])):
            last -= 1  # what follows the table
        for i in range(self.first, last):
            line = self.lines[i]
            if not line.strip() or self._bare(line) is not line:
                continue
            if "#" in line:  # a comment, but not within numbers
                line = re.sub(r"(?<=[\s,;])#(?!n/?a).*", "", line, flags=re.IGNORECASE)
            cells = self.cells(line)
            if len(cells) > self.width and any(cells[self.width :]):
                self.fail(i + 1, f"has {len(cells)} cells where other rows have {self.width}; give decimal=, or separator=; "
                          "as it is, or rows=N to end before this line")
            yield i + 1, [] if self.separator == " " and len(cells) < self.width else cells

    def from_first(self, column: int) -> Numbers:
        """The numbers of a column less the first one, of which a float has not all digits."""
        def exact(cell: str) -> Decimal:
            return Decimal(self._number(cell, self.first + 1, column))

        cells = [row[column] if column < len(row) else "" for _, row in self._rows_of_cells()]
        first = next((exact(cell) for cell in cells if not _is_empty(cell)), Decimal(0))
        return np.array([float("nan") if _is_empty(cell) else float(exact(cell) - first) for cell in cells])

    def _number(self, cell: str, line: int, column: int) -> str:
        if _is_empty(cell):
            return "nan"
        other = "," if self.decimal == "." else "."
        if not _NUMBER.fullmatch(cell) or (other in cell and not _is_grouped(cell, other)):
            self.fail(line, f"column {column + 1} is \"{cell}\"; allowed: a number with decimals after \"{self.decimal}\"; give "
                      f"decimal={other} if it has them, or rows=N or skip=N to leave this line out")
        return re.sub("[dD]", "e", cell.replace(other, "").replace(self.decimal, "."))
