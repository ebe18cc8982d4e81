"""What a sweep runs."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import Any, Union

import numpy as np

from .. import _core
from .._checks import is_positive, is_whole, seconds
from .._errors import CaseError, PlanError
from .._text import is_unicode, read_text
from .._toml import DEEPEST, flat, has_deep_key
from ..case import Case, as_case, checked, key_of

Axes = Mapping[Union[str, tuple[str, ...]], Iterable[Any]]

#: Of a plan, and values of one of its axes.
MOST_CASES = 10_000_000
MOST_VALUES = 1_000_000
_MOST_DRAWS = 1000
_MOST_SCATTER = 0.5
_SPLIT = "take fewer values, or make several plans of it"


@dataclass
class Plan:
    """A base case and the values in which the cases of a sweep differ from it.

    Every combination of the values of all axes is a case, those of the last axis changing fastest, times `samples` samples of
    the numbers that scatter. Cases are numbered from 0. An axis is a key with its values, or several keys that change together:

        Plan(case, {"striker.velocity": np.linspace(2, 16, 50),
                    ("beam.width", "beam.thickness"): [(0.016, 0.008), (0.02, 0.01)]})

    With `samples`, each combination is run so many times with numbers that scatter: p exp(s z), with z normal or, with
    distribution="uniform", uniform from -sqrt(3) to sqrt(3). `scatter` has the relative standard deviations s by key; left out,
    they are those of the case, its [scatter], which samples have no more. A sample is determined by `seed` and its number, and
    the same at every combination of the axes.
    """

    case: Case
    axes: Axes = field(default_factory=dict)
    scatter: Mapping[str, float] | None = None
    samples: int | None = None
    seed: int = 1
    error_bars: str | None = None  #: as in `subimpact.run`
    timeout: float | None = None  #: s per case; a case that takes longer has the outcome "timed_out"
    distribution: str = "normal"  #: of samples; or "uniform"

    def __post_init__(self) -> None:
        self._check_numbers()
        as_case(self.case)
        self._points: list[tuple[list[str], list[list[Any]]]] = []
        for keys, values in self.axes.items():
            self._points.append(_points(keys, values))
            self._check_size()
        self.axes = {tuple(keys): values for keys, values in self._points}
        self._check_axes()
        self._drawn = self._what_is_drawn()
        #: the case that the settings of each run change, with the model that is chosen once for all
        self.base = self.case if self.samples is None else _without_scatter(self.case)
        self.base = self.base.changed(self._chosen())

    def _chosen(self) -> dict[str, Any]:
        """The model that the base case's scene needs, so that it is the same in all cases. Where the
        sweep changes the contact or the theory itself, these stay open."""
        tables = {key.split(".")[0] for key in self.keys() if key.startswith(("contact.", "beam.theory"))}
        return {key: self.case[key] for key in self.case._load().chosen() if key.split(".")[0] not in tables}

    def _check_numbers(self) -> None:
        if self.error_bars not in (None, "off", "all"):
            raise PlanError(f'error_bars is "{self.error_bars}"; allowed: "off", "all"')
        for name, value, least, most in (
            ("samples", 1 if self.samples is None else self.samples, 1, MOST_CASES),
            ("seed", self.seed, 0, 2**64 - 1),
        ):
            if not is_whole(value, least, most):
                raise PlanError(f"{name} is {value!r}; allowed: a whole number, {least} to {most}; take one")
        if self.distribution not in ("normal", "uniform"):
            raise PlanError(f"distribution is {self.distribution!r}; allowed: \"normal\", \"uniform\"")
        self.timeout = seconds(self.timeout, PlanError)
        if not isinstance(self.axes, Mapping):
            raise PlanError(f"axes is {self.axes!r}; allowed: lists of values by key")
        self._check_scatter()

    def _check_scatter(self) -> None:
        allowed = 'relative standard deviations by key, such as { "striker.velocity" = 0.01 }'
        if self.scatter is None:
            return
        if not isinstance(self.scatter, Mapping):
            raise PlanError(f"scatter is {self.scatter!r}; allowed: {allowed}")
        for key, number in self.scatter.items():
            if not isinstance(key, str) or not is_unicode(key):
                raise PlanError(f"scatter has {key!r} in place of a key; allowed: {allowed}")
            if not is_positive(number):
                raise PlanError(f"scatter of {key} is {number!r}; allowed: a number above 0")

    def _check_size(self) -> None:
        """Before the next axis takes memory, or the cases do."""
        sizes = [(", ".join(keys), len(values)) for keys, values in self._points]
        name, n = sizes[-1]
        if n > MOST_VALUES:
            raise PlanError(f"{name} has more than {MOST_VALUES} values; allowed: up to as many; {_SPLIT}")
        if self.samples is not None:
            sizes.append(("samples", int(self.samples)))
        n_cases = math.prod(n for _, n in sizes)
        if n_cases > MOST_CASES:
            product = " times ".join(f"{n} of {name}" for name, n in sizes)
            raise PlanError(f"there are {n_cases} cases, {product}; allowed: up to {MOST_CASES}; {_SPLIT}")

    def _check_axes(self) -> None:
        seen: set[str] = set()
        for keys, points in self._points:
            for k, key in enumerate(keys):
                if key in seen:
                    raise CaseError(f"{key} is on two axes; give its values on one of them", key)
                seen.add(key)
                if not points:
                    raise CaseError(f"{key} has no values on its axis", key)
                for point in points:
                    if len(point) != len(keys):
                        raise CaseError(f"{key} changes together with others: every point of the axis needs {len(keys)} values, "
                                        f"and one has {len(point)}", key)
                    point[k] = _core.in_si(key, checked(key, point[k]))

    def _first(self, key: str) -> Any:
        """The value about which a number scatters, at the first combination of the axes."""
        for keys, points in self._points:
            if key in keys:
                return points[0][keys.index(key)]
        return self.case[key]

    def _what_is_drawn(self) -> dict[str, float]:
        if self.samples is None:
            if self.scatter:
                raise PlanError("scatter is given without samples; give their number, such as 1000")
            return {}
        if self.scatter is not None:
            drawn = {key: float(deviation) for key, deviation in sorted(self.scatter.items())}
            for key, deviation in drawn.items():
                self._check_drawn(key, deviation)
        else:
            given = ((key[len("scatter."):], value) for key, value in self.case.given().items() if key.startswith("scatter."))
            drawn = {key: deviation for key, deviation in sorted(given) if deviation > 0 and is_number(self._first(key))
                     and self._first(key) != 0}
        if not drawn:
            raise PlanError(
                "samples are to be drawn, but nothing scatters; give scatter, here or as [scatter] "
                'of the case, such as { "striker.velocity" = 0.01 }, or leave samples out'
            )
        return drawn

    def _check_drawn(self, key: str, deviation: float) -> None:
        if key_of(key).type != "number":
            raise CaseError(f"{key} is no number, and cannot scatter", key)
        if not is_number(self._first(key)):
            raise CaseError(f"{key} has no finite value in the base case about which to scatter", key)
        if deviation > _MOST_SCATTER:
            raise CaseError(f"{key} has a scatter of {deviation:g}; allowed: a relative standard deviation above 0, up to "
                            f"{_MOST_SCATTER}, such as 0.01", key)

    def __len__(self) -> int:
        return math.prod(len(points) for _, points in self._points) * int(self.samples or 1)

    def keys(self) -> list[str]:
        """The keys in which cases differ."""
        return list(dict.fromkeys([key for keys, _ in self._points for key in keys] + list(self._drawn)))

    def settings(self, number: int) -> list[tuple[str, Any]]:
        """The values in which a case differs from the base case."""
        if not 0 <= number < len(self):
            raise IndexError("number of a case")
        *places, sample = np.unravel_index(number, [*(len(points) for _, points in self._points), int(self.samples or 1)])
        settings = {key: value for (keys, points), place in zip(self._points, places) for key, value in zip(keys, points[place])}
        random = np.random.default_rng((int(self.seed), int(sample)))
        for key, deviation in self._drawn.items():
            draw: Callable[[], float] = random.standard_normal
            if self.distribution == "uniform":
                draw = partial(random.uniform, -math.sqrt(3), math.sqrt(3))
            settings[key] = _drawn(draw, key, settings[key] if key in settings else self.case[key], deviation)
        return list(settings.items())

    def case_of(self, number: int) -> Case:
        """A case of the plan, by its number from 0."""
        return self.base.changed(dict(self.settings(number)))

    def place(self, number: int) -> str:
        """A hash of the base case and of what a case changes in it: cases of one place have one identity."""
        return sha256(f"{self._base_identity} {self.settings(number)!r}".encode()).hexdigest()

    @cached_property
    def _base_identity(self) -> str:
        return self.base.identity(self.how)

    @property
    def how(self) -> str:
        """What beside the case determines results."""
        return f"error_bars={self.error_bars}"

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Plan:
        """Reads a plan (TOML); docs/populations.md has its keys. The case file is named relative to
        the plan."""
        path = Path(path)
        try:
            tables = _parse(_read(path))
            return _plan_of(tables, path.parent)
        except PlanError as error:
            raise PlanError(f"{path}: {error}") from None
        except RecursionError:
            raise PlanError(f"{path}: {_TOO_DEEP}") from None


_TOO_DEEP = (
    f"keys, tables or lists are nested deeper than {DEEPEST}; allowed: tables of keys, such as [axes] with "
    "striker.mass = [0.1, 0.2]"
)


def _read(path: Path) -> str:
    """The text of a plan: of a file, or of standard input by its name."""
    if os.path.lexists(path) and not (path.is_file() or str(path).startswith(("/dev/stdin", "/dev/fd/"))):
        raise PlanError("is no regular file; give the path of a plan (TOML)")
    return read_text(path, "a plan", PlanError)


def _points(keys: str | tuple[str, ...], values: Iterable[Any]) -> tuple[list[str], list[list[Any]]]:
    """An axis: its keys, and their values in each point."""
    names = [keys] if isinstance(keys, str) else list(keys) if isinstance(keys, tuple) else []
    if not names or not all(isinstance(name, str) and is_unicode(name) for name in names):
        raise PlanError(f"axes have {keys!r} in place of a key; allowed: a key, or a tuple of keys")
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise PlanError(f"the axis of {keys} is {values!r}; allowed: a list of values")
    values = islice(values, MOST_VALUES + 1)
    if isinstance(keys, str):
        return names, [[value] for value in values]
    points = []
    for point in values:
        if isinstance(point, str) or not isinstance(point, Iterable):
            raise PlanError(
                f"the axis of {', '.join(names)} has {point!r}; allowed: tuples of {len(names)} values"
            )
        points.append(list(islice(point, len(names) + 1)))
    return names, points


def is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _drawn(draw: Callable[[], float], key: str, value: float, deviation: float) -> float:
    """A number that scatters; values that the key refuses are drawn again."""
    for _ in range(_MOST_DRAWS):
        try:
            return float(checked(key, value * math.exp(deviation * draw())))
        except CaseError:
            pass
    raise CaseError(f"{key} scatters out of its range: no value of {_MOST_DRAWS} draws about {value:g} is allowed; make its scatter "
                    "smaller", key)


def _without_scatter(case: Case) -> Case:
    base = case.copy()
    for key in case.given():
        if key.startswith("scatter."):
            del base[key]
    return base


def _parse(text: str) -> dict[str, Any]:
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    if has_deep_key(text):
        raise PlanError(_TOO_DEEP)
    try:
        return tomllib.loads(text)
    except ValueError as error:
        raise PlanError(f"is no TOML: {error}") from None


_OTHERS = ("samples", "seed", "error_bars", "timeout", "distribution")
_TABLES = ("case", "set", "axes", "together", "scatter", *_OTHERS)


def _plan_of(tables: dict[str, Any], directory: Path) -> Plan:
    for name in tables:
        if name not in _TABLES:
            raise PlanError(f'unknown key "{name}"; allowed: {", ".join(_TABLES)}')
    if not isinstance(tables.get("case"), str):
        raise PlanError('case is missing; write case = "strike.toml", the file of the base case')
    case = Case.from_file(directory / tables["case"])
    for key, value in flat(_table(tables, "set")).items():
        case[key] = value
    axes: dict[Any, Iterable[Any]] = {**_lists(_table(tables, "axes"))}
    for group in _groups(tables):
        lists = _lists(group)
        lengths = {key: len(values) for key, values in lists.items()}
        if len(set(lengths.values())) != 1:
            raise PlanError(f"the lists of [[together]] differ in length: {lengths}; allowed: equal ones")
        if tuple(lists) in axes:
            raise PlanError(f"two [[together]] have {', '.join(lists)}; give their values in one of them")
        axes[tuple(lists)] = zip(*lists.values())
    others = {name: tables[name] for name in _OTHERS if name in tables}
    if "scatter" in tables:
        others["scatter"] = flat(_table(tables, "scatter"))
    return Plan(case, axes, **others)


def _table(tables: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    table = tables.get(name, {})
    if not isinstance(table, Mapping):
        raise PlanError(f"{name} is {table!r}; allowed: a table, which begins with [{name}]")
    return table


def _groups(tables: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    groups = tables.get("together", [])
    if not isinstance(groups, list) or not all(isinstance(group, Mapping) for group in groups):
        raise PlanError(f"together is {groups!r}; allowed: tables, each of which begins with [[together]]")
    return groups


def _lists(tables: Mapping[str, Any]) -> dict[str, list[Any]]:
    """The lists of values by keys with dots; {from, to, n} stands for a list."""
    lists = {}
    for key, value in flat(tables, value_with="from").items():
        lists[key] = _range(key, value) if isinstance(value, Mapping) else value
        if not isinstance(value, (list, Mapping)):
            raise PlanError(f"{key} is {value!r}; allowed: a list, or {{ from, to, n }}")
    return lists


def _range(key: str, values: Mapping[str, Any]) -> list[float]:
    allowed = '{ from = 2, to = 16, n = 50 }, with spacing = "log" for equal ratios'
    try:
        first, last, n = float(values["from"]), float(values["to"]), values["n"]
    except (KeyError, TypeError, ValueError, OverflowError):
        raise PlanError(f"{key} is {dict(values)}; allowed: {allowed}") from None
    spacing = values.get("spacing", "linear")
    is_known = spacing in ("linear", "log") and set(values) <= {"from", "to", "n", "spacing"}
    is_known = is_known and math.isfinite(first) and math.isfinite(last)
    if not is_known or type(n) is not int or n < 2 or (spacing == "log" and not first * last > 0):
        raise PlanError(f"{key} is {dict(values)}; allowed: {allowed}")
    if n > MOST_VALUES:
        raise PlanError(f"{key} has n = {n}; allowed: up to {MOST_VALUES} values; {_SPLIT}")
    spaced: Any = np.geomspace if spacing == "log" else np.linspace
    return [float(value) for value in spaced(first, last, n)]
