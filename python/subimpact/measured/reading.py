"""Measured forces and strains, from the files of instruments and spreadsheets."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn, Union

import numpy as np

from .._errors import ResultsError
from .._checks import is_whole
from .._text import one_line, read_at_most
from .tables import Table
from .units import Sensitivity, Unit, quantity, sensitivity_of, unit_of, value_in

if TYPE_CHECKING:
    from ..result import Numbers

Column = Union[int, str]
_MOST_BYTES = 4_000_000_000
_OVERRANGE = 9.89e37  # SCPI: 9.9e37 is infinite, 9.91e37 not a number
_TIME = re.compile(r"t\b|time|zeit|x_?value", re.IGNORECASE)
_FORCE = re.compile(r"f\b|force|kraft|load|last\b|strain|dehnung", re.IGNORECASE)
_INCREMENTS = ("increment", "deltax", "deltat", "dt", "tinc", "xinc", "sampleinterval", "samplinginterval", "timeinterval",
               "sampleperiod", "samplingperiod", "timestep", "hresolution", "interval", "abtastintervall")
_RATES = ("samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "fs", "abtastrate", "abtastfrequenz")
_STARTS = ("start", "starttime", "x0", "t0", "hoffset", "xzero", "firstsample")
_COLUMNS = "columns=T,F, the numbers of that of the time and that of the force"
_MASSES = {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": 0.45359237, "lbm": 0.45359237, "oz": 0.028349523125, "slug": 14.593902937}
_GAINS = ("gain", "amplifiergain", "amplification")


@dataclass(frozen=True, repr=False, eq=False)
class Signal:
    """A measured contact force, positive where it pushes, or the strain of a gauge, positive in tension.

    times     (n,), s, increasing, 3 or more
    forces    (n,), N; of a gauge the strains, m/m
    source    where it comes from, in messages
    assumed   how a file was read, in words
    quantity  "force" or "strain"

    Raises ResultsError for anything else.
    """

    times: Numbers
    forces: Numbers
    source: str = "signal"
    assumed: tuple[str, ...] = ()
    quantity: str = "force"

    def __post_init__(self) -> None:
        for name in ("times", "forces"):
            object.__setattr__(self, name, np.ascontiguousarray(getattr(self, name), dtype=float))
        t, f = self.times, self.forces
        if self.quantity not in ("force", "strain"):
            self._fail(f"quantity is {self.quantity!r}; allowed: \"force\", \"strain\"")
        if t.ndim != 1 or t.shape != f.shape or len(t) < 3:
            self._fail(f"times and forces have the shapes {t.shape} and {f.shape}; allowed: as many of each, 3 or more")
        if not (np.isfinite(t).all() and np.isfinite(f).all()):
            self._fail("times or forces are not all finite; leave out what is not")
        if not 1e-30 < (largest := float(np.abs(f).max()) or 1.0) < 1e30:
            self._fail(f"the largest value is {largest:.3g}; allowed: 1e-30 to 1e30 N or m/m; check its unit")
        if not (np.diff(t) > 0.0).all():
            self._fail("times do not increase; sort them, and leave out what comes twice")

    def _fail(self, words: str) -> NoReturn:
        raise ResultsError(f"{self.source}: {words}")

    @property
    def interval(self) -> float:
        """The median of the times between samples, s."""
        return float(np.median(np.diff(self.times)))

    def __len__(self) -> int:
        return len(self.times)

    def __eq__(self, other: object) -> bool:
        """Whether times, values and quantity are the same, wherever they come from."""
        return (isinstance(other, Signal) and self.quantity == other.quantity
                and np.array_equal(self.times, other.times) and np.array_equal(self.forces, other.forces))

    __hash__ = None  # type: ignore[assignment]

    def to_pandas(self) -> Any:
        """A Series of pandas: forces (N) or strains (m/m) over times (s)."""
        import pandas

        name = "force_N" if self.quantity == "force" else "strain"
        return pandas.Series(self.forces, pandas.Index(self.times, name="time_s"), name=name)

    def plot(self, axes: Any = None) -> Any:
        """Draws it over time; returns the axes of Matplotlib."""
        from .drawing import draw_signal

        return draw_signal(self, axes)

    def __repr__(self) -> str:
        return (f"<Signal of {self.source}: {len(self.times)} samples {1e6 * self.interval:.6g} us apart, "
                f"{self.forces.min():.6g} to {self.forces.max():.6g} {'N' if self.quantity == 'force' else 'm/m'}; "
                f"{'; '.join(self.assumed) or 'as given'}>")


def _listed(value: Column | Sequence[Column] | None) -> list[Column]:
    """An option of one or two values; a text has them with a comma between."""
    if isinstance(value, str):
        return [int(part) if part.isdecimal() else part for part in map(str.strip, value.split(","))]
    return [] if value is None else [value] if isinstance(value, int) else list(value)


class _Reading:
    """Which columns of a table hold time and force, and in what units."""

    def __init__(self, table: Table, columns: list[Column], units: list[Column], has_times: bool, is_electrical: bool) -> None:
        self.table = table
        self.overruled: list[str] = []  #: what options say against the file
        self.is_electrical = is_electrical
        self.time: int | None = None
        given = [self._index(column) for column in columns]
        stated = dict(enumerate(table.units))
        for column, text in zip(reversed(given), reversed(units)):
            stated[column] = self._given_unit(text)
        if len(given) > 1:
            self.time = given[0]
        elif has_times:
            self.time = self._choose({"time"}, stated, _TIME, "times")
        self.force = given[-1] if given else self._find_force(stated, units)
        if not has_times or self.time == self.force:
            self.time = None
        elif self.time is None:
            self.time = self._unnamed_time()
        self.time_unit = self._unit(self.time, units[0] if len(units) > 1 else None, "time")
        self.force_unit = self._unit(self.force, units[-1] if units else None, "force")
        self.quantity = "strain" if self.force_unit and self.force_unit.kind == "strain" else "force"

    def fail(self, words: str) -> NoReturn:
        """Refuses the file, at its heading."""
        self.table.fail(self.table.heading, words)

    def _given_unit(self, text: Column) -> Unit:
        if (unit := unit_of(str(text))) is None:
            raise ResultsError(f"units has {text!r}; allowed: those of time and force, such as units=us,kN, volts, m/s^2 and g too")
        return unit

    def _label(self, j: int) -> str:
        return f"column {j + 1}" + (f" ({one_line(self.table.names[j])})" if self.table.names[j] else "")

    def _all(self, columns: Sequence[int]) -> str:
        return ", ".join(map(self._label, columns))

    def _index(self, column: Column) -> int:
        names = [re.sub(r"^/'.*?'/'(.*)'$", r"\1", name).casefold() for name in self.table.names]  # of TDMS
        bare = [re.sub(r"\s*[\[({].*|[_ ]\w+$", "", name) for name in names]
        for options in (names, bare):
            if isinstance(column, str) and options.count(column.casefold()) == 1:
                return options.index(column.casefold())
        if isinstance(column, int) and 1 <= column <= self.table.width:
            return column - 1
        self.fail(f"has no column {column!r}; allowed: {self._all(range(self.table.width))}, by number or by name")

    def _choose(self, kinds: set[str], stated: dict[int, Unit | None], name: re.Pattern[str], what: str) -> int | None:
        """The column in such a unit; of several the one that is named so."""
        found = [j for j in self.table.columns if (unit := stated[j]) is not None and unit.kind in kinds]
        named = [j for j in found if name.match(self.table.names[j])]
        if len(found) > 1 and len(named) != 1:
            self.fail(f"has several columns of {what}: {self._all(found)}; give {_COLUMNS}")
        return named[0] if named else found[0] if found else None

    def _find_force(self, stated: dict[int, Unit | None], units: list[Column]) -> int:
        table = self.table
        for kinds in ({"force"}, {"strain", "acceleration", "voltage", "charge"}):
            if (found := self._choose(kinds, stated, _FORCE, "forces")) is not None:
                return found
        others = [j for j in table.columns if j != self.time and stated[j] is None]
        named = [j for j in others if _FORCE.match(table.names[j])]
        if len(named) == 1:
            return named[0]
        others = [j for j in others if not self._is_index(j) and not _TIME.match(table.names[j])] or others
        others = others[1:] if len(others) == 2 and self.time is None and not table.names[others[0]] else others
        if len(others) != 1:
            table.fail(table.heading or table.first + 1, f"names no column of forces among {self._all(others or table.columns)}; give "
                       f"{_COLUMNS}, and units=us,N if no unit is stated")
        return others[0]

    def _is_index(self, j: int) -> bool:
        return re.match(r"(x|sample|sequence|index|nr|no|point|#)\b", self.table.names[j], re.IGNORECASE) is not None

    def _unnamed_time(self) -> int | None:
        """A column of times whose unit is not in the heading, unless the metadata have the interval."""
        rest = [j for j in self.table.columns if j < self.force and self.table.units[j] is None]
        named = [j for j in rest if _TIME.match(self.table.names[j])]
        if named:
            return named[-1]  # of LabVIEW's pairs that of the force
        if self._metadata(_INCREMENTS + _RATES) and (len(rest) != 1 or self._is_index(rest[0])):
            return None
        return rest[0] if len(rest) == 1 and not self._is_index(rest[0]) else None

    def _metadata(self, keys: tuple[str, ...], column: int | None = None) -> str | None:
        """The value of the first of these keys; of several channels that of the column."""
        for key, values in self.table.metadata.items():
            if key in keys or any(len(name) > 6 and key.startswith(name) for name in keys):
                channels = [j for j in self.table.columns if j != self.time and not self._is_index(j)
                            and not _TIME.match(self.table.names[j])]
                if column is not None and len(set(values)) > 1:
                    values = values[channels.index(column):] if len(values) == len(channels) else [""]
                return re.sub(r"^[A-Za-z]\w*:\s*", "", values[0])
        return None

    def _each(self, keys: tuple[str, ...]) -> list[str]:
        """What the metadata say of the force by each of these keys."""
        return [text for key in keys if (text := self._metadata((key,), self.force))]

    def _unit(self, column: int | None, given: Column | None, what: str) -> Unit | None:
        """The unit of a column: as given, by the heading, or by the metadata."""
        if column is None:
            return None
        if unit := self._given_unit(given) if given is not None else self.table.units[column]:
            own = self.table.units[column] or self._unit_of_metadata(column, what)
            if own and own != unit:
                self.overruled.append(f"{unit.symbol} as given, where the file says {own.symbol} in {self._label(column)}")
            if what == "time" and unit.kind != "time":
                self.fail(f"{self._label(column)} is in {unit.symbol}, no unit of time; give {_COLUMNS}, and units=us,N in this order")
            return unit
        if unit := self._unit_of_metadata(column, what):
            return unit
        if what == "time" and (self.table.maker or self.table.has_clock):
            return unit_of("s")
        if what == "force" and self.table.maker == "LECROY" and self.is_electrical:
            return unit_of("V")
        said = f"states {self.table.conflicts[column]} as unit of {what}" if column in self.table.conflicts else f"states no unit of {what}"
        self.fail(f"{said}, in {self._label(column)}; give units=us,N, those of time and force, or write them into the heading: "
                  "time_us,force_N")

    def _unit_of_metadata(self, column: int, what: str) -> Unit | None:
        keys = (("horizontalunits", "hunit", "xunit", "xunitlabel", "timeunit") if what == "time" else
                ("verticalunits", "vunit", "yunit", "yunitlabel", "forceunit", "unit"))
        text = self._metadata(keys, column if what == "force" else None)
        return unit_of(text) if text else None

    def times(self, n: int, interval: str | float | None) -> tuple[Numbers, str]:
        """Times by start and increment, and how they are known."""
        if interval is not None:
            step = value_in("time", interval) if isinstance(interval, str) else interval
            if step is None or not step > 0.0:
                raise ResultsError(f"interval is {interval!r}; allowed: a time above 0 with its unit, such as interval=1us")
            return step * np.arange(n), "interval as given"
        step = self.stated_interval()
        if parts := quantity(self._metadata(("decimation", "decimationfactor", "downsampling")) or ""):
            step = step if parts[0] == 1.0 else None
        if step is None or not step > 0.0:
            self.fail("has no column of times and states no interval between samples with its unit, or a decimation; give "
                      f"interval=1us, or {_COLUMNS}")
        start = self._seconds(_STARTS) or 0.0
        return start + step * np.arange(n), f"samples {1e6 * step:.6g} us apart from {1e6 * start:.6g} us on, by the metadata"

    def stated_interval(self) -> float | None:
        """The seconds between samples by the metadata."""
        step = self._seconds(_INCREMENTS)
        hertz = value_in("frequency", self._metadata(_RATES) or "") if step is None else None
        return 1.0 / hertz if hertz else step

    def check_interval(self, times: Numbers) -> None:
        """Says where times and metadata differ, and refuses times that can only have another unit."""
        step, known = self.stated_interval(), times[np.isfinite(times)]
        if not step or len(known) < 2:
            return
        apart = (float(np.median(np.abs(np.diff(known)))), float(np.ptp(known)) / (len(known) - 1))  # few digits; gaps
        if apart[0] and not 1 / 30 < apart[0] / step < 30:  # parts of a record are exported; units differ by more
            self.fail(f"has times {apart[0]:.3g} s apart and states {step:.3g} s between samples; give units=us,N, if the times have "
                      "another unit, or interval=1us")
        if min(abs(each / step - 1.0) for each in apart) > 0.02:
            self.overruled.append(f"times {1e6 * apart[0]:.6g} us apart as in their column, where the file states {1e6 * step:.6g} us")

    def check_factor(self) -> None:
        """Refuses a factor of the numbers in the metadata, of which instruments are not of one mind."""
        parts = quantity(self._metadata(("ymult", "ymultiplier", "yfactor", "scalefactor", "multiplier"), self.force) or "")
        if parts and parts[0] != 1.0:
            self.fail(f"states a factor of {parts[0]:g}; give scale={parts[0]:g} if its numbers are to be multiplied by it, or scale=1 "
                      "if they are not")
        if self.force_unit is None or self.force_unit.kind not in ("voltage", "charge"):
            return
        for gain in self._each(_GAINS):
            parts = quantity(gain.lstrip("xX×* "))
            if parts and parts[0] != (0.0 if parts[1].lower() == "db" else 1.0) and not sensitivity_of(gain):
                self.fail(f"states a gain of {gain}; give scale=, one over the gain if its numbers are to be divided by it, or scale=1 "
                          "if they are not")

    def _seconds(self, keys: tuple[str, ...]) -> float | None:
        parts = quantity(text) if (text := self._metadata(keys)) else None
        if not parts:
            return None
        unit = unit_of(parts[1] or self._metadata(("horizontalunits", "hunit", "xunit", "timeunit")) or "")
        if unit is None and not parts[1] and (self.table.maker or {"start", "increment"} <= self.table.metadata.keys()
                                              or "tinc" in self.table.metadata):  # LabVIEW, Rigol: in seconds
            unit = unit_of("s")
        return parts[0] * unit.factor if unit and unit.kind == "time" else None

    def newtons(self, sensitivity: str | None, mass: float | str | None) -> tuple[float, str]:
        """What the column of the force is multiplied by, and why; a strain by its unit."""
        unit, where = self.force_unit, self._label(self.force)
        assert unit is not None
        factor, kind, words = unit.factor, unit.kind, f"{self.quantity}: {where}, {unit.symbol}"
        if sensitivity is not None and kind not in ("voltage", "charge"):
            self.fail(f"sensitivity is given, and {where} is in {unit.symbol}; leave it out, or give units=us,V if that is its unit")
        if kind in ("voltage", "charge"):
            stated = self._each(("sensitivity", "empfindlichkeit", "calibrationfactor", *_GAINS))
            own = next(filter(sensitivity_of, stated), None)
            text = sensitivity or own
            known: Sensitivity | None = sensitivity_of(str(text)) if text else None
            if sensitivity and own and sensitivity_of(own) not in (None, known):
                self.overruled.append(f"{sensitivity} as given, where the file says {own}")
            if known is None or known.electrical != kind:
                said = f"sensitivity is {text!r}, and {where}" if sensitivity else where
                self.fail(f"{said} is in {unit.symbol}; give sensitivity=\"2.27 mV/N\", what the transducer makes of a newton (or of "
                          "m/s^2 or g, with a mass)")
            factor, kind, words = factor / known.per, known.mechanical, words + f" at {text}"
        if kind == "acceleration":
            text = str(mass) if mass is not None else self._metadata(("mass", "masse", "strikermass")) or ""
            parts = quantity(text)
            kilograms = parts[0] * _MASSES.get(parts[1] or ("kg" if mass is not None else ""), 0.0) if parts else 0.0
            if not kilograms > 0.0:
                self.fail(f"{where} is an acceleration; give mass=\"0.2 kg\", that of the body which it is measured on")
            factor, kind, words = factor * kilograms, "force", words + f" times {kilograms:g} kg"
        elif mass is not None:
            self.fail(f"mass is given, and {words.removeprefix(self.quantity + ': ')} is no acceleration; leave it out, or give "
                      "units=us,g if that is its unit")
        if kind != self.quantity:
            self.fail(f"{where} is in {unit.symbol}, no unit of force; give {_COLUMNS}, or units=us,N")
        return factor, words


def read(
    path: str | os.PathLike[str] | Any,
    *,
    columns: Column | Sequence[Column] | None = None,
    units: str | Sequence[str] | None = None,
    scale: float | None = None,
    sign: int | None = None,
    sensitivity: str | None = None,
    mass: float | str | None = None,
    interval: str | float | None = None,
    skip: int = 0,
    rows: int | None = None,
    separator: str | None = None,
    decimal: str | None = None,
) -> Signal:
    """The contact force, or the strain of a gauge, that an instrument or a spreadsheet has written as a table of text.

    A file that states what it holds needs no option. Raises ResultsError for any other: the message
    names the place and the option that helps.

    path         of the file; or an open file, or a DataFrame of pandas
    columns      of time and force, by number from 1 or by name: (1, 3), "Time,Force"; one: the force
    units        of both: ("us", "kN") or "us,kN"; one: of the force. Accelerations, volts and um/m are allowed
    scale        the force is multiplied by this
    sign         -1 where the file has compression negative, 1 where it is as it should be
    sensitivity  of a transducer in volts or coulombs: "2.27 mV/N", "10 mV/g"
    mass         of the body whose acceleration was measured: kg, or "201 g"
    interval     between samples, in place of a column of times: s, or "1us"
    skip, rows   how many lines not to read at the top, and how many of the table to read
    separator    of cells: "," or ";" or "\\t", " " for blanks
    decimal      "." or ","

    Cells that are empty, NaN, infinite or overrange (9.9e37) are left out; samples of one time are averaged.
    """
    if sign not in (None, 1, -1):
        raise ResultsError(f"sign is {sign!r}; allowed: 1, or -1 where the file has compression negative")
    if decimal not in (None, ".", ","):
        raise ResultsError(f"decimal is {decimal!r}; allowed: \".\", \",\"")
    for name, number, least in (("skip", skip, 0), ("rows", 3 if rows is None else rows, 3)):
        if not is_whole(number, least, 2**62):
            raise ResultsError(f"{name} is {number!r}; allowed: a whole number of lines, {least} or more")
    file, content = _content(path)
    table = Table(content, file, skip, rows, {"tab": "\t", "\\t": "\t"}.get(separator or "", separator), decimal)
    reading = _Reading(table, _listed(columns), _listed(units), interval is None, sensitivity is not None)
    factor, words = reading.newtons(sensitivity, mass)
    wanted = [reading.force] if reading.time is None else [reading.time, reading.force]
    if scale is None:
        reading.check_factor()
    numbers = table.numbers(wanted)
    numbers[np.abs(numbers) > _OVERRANGE] = np.nan
    if reading.time is None or reading.time_unit is None:
        times, how = reading.times(len(numbers), interval)
    else:
        times, where_from = _resolved(table, reading.time, numbers[:, 0])
        reading.overruled.extend(where_from)
        times = times * reading.time_unit.factor
        reading.check_interval(times)
        how = f"time: {reading._label(reading.time)}, {reading.time_unit.symbol}"
    forces = numbers[:, -1] * factor * (1.0 if scale is None else float(scale))
    if sign is None and "times" in words and np.nanmin(forces) < -np.nanmax(forces):
        forces, words = -forces, words + ", which slows the striker down: sign changed"
    if scale is not None and float(scale) != 1.0:
        words += f", times {float(scale):g}"
    return _signal(table, wanted, times, forces, [how, words, *reading.overruled], sign, reading.quantity)


def _content(path: Any) -> tuple[str, bytes]:
    """Of a file, an open one, or a DataFrame: its name and what it holds."""
    if hasattr(path, "to_csv"):
        counts = type(path.index).__name__ == "RangeIndex"
        return "DataFrame", path.to_csv(index=path.index.name is not None or not counts).encode()
    if hasattr(path, "read"):
        text = path.read()
        return str(getattr(path, "name", "text")), text if isinstance(text, bytes) else text.encode()
    file = one_line(os.fsdecode(path))
    try:
        return file, read_at_most(path, _MOST_BYTES)
    except OSError as error:
        raise ResultsError(f"{file}: cannot be read ({error.strerror}); give the path of a table of numbers, such as a CSV "
                           "file of an instrument") from None


def _resolved(table: Table, column: int, times: Numbers) -> tuple[Numbers, list[str]]:
    """Times with all their digits: counted from the first one where a float cannot hold them, such as those since 1970."""
    known = times[np.isfinite(times)]
    if len(known) < 2 or np.spacing(np.abs(known).max()) < 1e-5 * (np.ptp(known) / len(known)):
        return times, []
    exact = np.where(np.isfinite(times), table.from_first(column), np.nan)
    return exact, [f"times counted from the first, {known[0]:.10g}"]


def _signal(table: Table, wanted: list[int], times: Numbers, forces: Numbers,
            assumed: list[str], sign: int | None, quantity: str) -> Signal:
    """What was read without the gaps, of the right sign."""
    kept = np.flatnonzero(np.isfinite(times) & np.isfinite(forces))
    if n_left_out := len(times) - len(kept):
        assumed.append(f"{n_left_out} rows without a number left out")
    times, forces = times[kept], forces[kept]
    steps = np.diff(times)
    if len(steps) > 1 and (steps < 0.0).all():
        times, forces, steps = times[::-1], forces[::-1], -steps[::-1]
        assumed.append("rows from the last to the first")
    if (steps < 0.0).any():
        line = table.line_of(int(kept[int(np.argmax(steps < 0.0)) + 1]))
        n, numbers = line - 1 - table.first, ",".join(str(column + 1) for column in wanted)
        table.fail(line, f"the time is earlier than that of the row above, as where another record begins; give rows={n} for the one "
                   f"above, skip={line - 1} with columns={numbers} and units=us,N for the one from here on (and rows=N for its length), "
                   "or interval=1us if these are no times")
    if (steps == 0.0).any():
        begins = np.flatnonzero(np.r_[True, steps > 0.0])
        forces = np.add.reduceat(forces, begins) / np.diff(np.r_[begins, len(times)])
        times = times[begins]
        assumed.append("samples of one time averaged")
    if len(times) < 3:
        table.fail(table.first + 1, f"has {len(times)} rows of numbers, and 3 are the least; allowed: the record of a strike")
    if quantity == "force" and sign is None and -forces.min() > max(forces.max(), 0.0):
        table.fail(table.heading, f"the force lies between {forces.min():.4g} and {forces.max():.4g} N, and contact pushes: "
                   "give sign=-1 if the file has compression negative, sign=1 if not")
    return Signal(times, forces * (sign or 1), table.file, (*assumed, *(["sign changed"] if sign == -1 else [])), quantity)
