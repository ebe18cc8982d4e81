"""What a sweep runs."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from numbers import Integral, Real
from pathlib import Path
from typing import Any, Union

from .. import _core
from .._errors import PlanError
from .._toml import flat
from ..case import Case, as_case

Axes = Mapping[Union[str, tuple[str, ...]], Iterable[Any]]


@dataclass
class Plan:
    """A base case and the values in which the cases of a sweep differ from it.

    Every combination of the values of all axes is a case, those of the last axis changing fastest,
    times `samples` samples of the numbers that scatter. Cases are numbered from 0.

    An axis is a key with its values, or several keys that change together with tuples of values:

        Plan(case, {"striker.velocity": np.linspace(2, 16, 50),
                    ("beam.width", "beam.thickness"): [(0.016, 0.008), (0.02, 0.01)]})

    With `samples`, each combination is run so many times with numbers that scatter: p exp(s z),
    with z normal. `scatter` has the relative standard deviations s by key; left out, they are those
    of the case, its [scatter]. A sample is determined by `seed` and its number, and the same at
    every combination of the axes. Samples have no [scatter] of their own any more.
    """

    case: Case
    axes: Axes = field(default_factory=dict)
    scatter: Mapping[str, float] | None = None
    samples: int | None = None
    seed: int = 1
    error_bars: str | None = None  #: as in `subimpact.run`
    timeout: float | None = None  #: s per case; a case that takes longer has the outcome "timed_out"

    def __post_init__(self) -> None:
        self._check_numbers()
        as_case(self.case)
        points = self._points = [_points(keys, values) for keys, values in self.axes.items()]
        self.axes = {tuple(keys): values for keys, values in points}
        self._drawn = self._what_is_drawn()
        self._population.check(self.case._load())
        #: of the samples
        self._base = self.case if self.samples is None else _without_scatter(self.case)

    def _check_numbers(self) -> None:
        if self.error_bars not in (None, "off", "time", "all"):
            raise PlanError(f'error_bars is "{self.error_bars}"; allowed: "off", "time", "all"')
        for name, value, least in (("samples", self.samples, 1), ("seed", self.seed, 0)):
            if value is not None and not (isinstance(value, Integral) and value >= least):
                raise PlanError(f"{name} is {value!r}; allowed: a whole number, {least} or more")
        numbers = [("timeout", self.timeout)] if self.timeout is not None else []
        numbers += [(f"scatter of {key}", value) for key, value in (self.scatter or {}).items()]
        for name, number in numbers:
            if not (isinstance(number, Real) and number > 0):
                raise PlanError(f"{name} is {number!r}; allowed: a number above 0")

    def _what_is_drawn(self) -> dict[str, float]:
        if self.samples is None:
            if self.scatter:
                raise PlanError("scatter is given without samples; give their number, such as 1000")
            return {}
        if self.scatter is not None:
            drawn = dict(self.scatter)
        else:
            axes = _core.Population(self._points, {}, 1, 1)
            axes.check(self.case._load())
            drawn = axes.scatter_of(self.case._load())
        if not drawn:
            raise PlanError(
                "samples are to be drawn, but nothing scatters; give scatter, here or as [scatter] "
                'of the case, such as { "striker.velocity" = 0.01 }, or leave samples out'
            )
        return drawn

    @cached_property
    def _population(self) -> _core.Population:
        return _core.Population(self._points, self._drawn, int(self.samples or 1), int(self.seed))

    def __getstate__(self) -> dict[str, Any]:
        state = dict(self.__dict__)
        state.pop("_population", None)
        return state

    def __len__(self) -> int:
        return len(self._population)

    def keys(self) -> list[str]:
        """The keys in which cases differ."""
        return self._population.keys()

    def settings(self, number: int) -> list[tuple[str, Any]]:
        """The values in which a case differs from the base case."""
        return self._population.settings(self.case._load(), number)

    def case_of(self, number: int) -> Case:
        """A case of the plan, by its number from 0."""
        return self._base.changed(dict(self.settings(number)))

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
            tables = _parse(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise PlanError(f"{path}: cannot be read ({error.strerror}); give the path of a plan") from None
        except ValueError as error:
            raise PlanError(f"{path}: is no TOML: {error}") from None
        try:
            return _plan_of(tables, path.parent)
        except PlanError as error:
            raise PlanError(f"{path}: {error}") from None


def _points(keys: str | tuple[str, ...], values: Iterable[Any]) -> tuple[list[str], list[list[Any]]]:
    """An axis: its keys, and their values in each point."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise PlanError(f"the axis of {keys} is {values!r}; allowed: a list of values")
    if isinstance(keys, str):
        return [keys], [[value] for value in values]
    points = []
    for point in values:
        if isinstance(point, str) or not isinstance(point, Iterable):
            raise PlanError(
                f"the axis of {', '.join(keys)} has {point!r}; allowed: tuples of {len(keys)} values"
            )
        points.append(list(point))
    return list(keys), points


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
    return tomllib.loads(text)


_TABLES = ("case", "set", "axes", "together", "scatter", "samples", "seed", "error_bars", "timeout")


def _plan_of(tables: dict[str, Any], directory: Path) -> Plan:
    for name in tables:
        if name not in _TABLES:
            raise PlanError(f'unknown key "{name}"; allowed: {", ".join(_TABLES)}')
    if not isinstance(tables.get("case"), str):
        raise PlanError('case is missing; write case = "strike.toml", the file of the base case')
    case = Case.from_file(directory / tables["case"])
    for key, value in flat(tables.get("set", {})).items():
        case[key] = value
    axes: dict[str | tuple[str, ...], list[Any]] = {}
    for key, values in _lists(tables.get("axes", {})).items():
        axes[key] = values
    for group in tables.get("together", []):
        lists = _lists(group)
        lengths = {key: len(values) for key, values in lists.items()}
        if len(set(lengths.values())) > 1:
            raise PlanError(f"the lists of [[together]] differ in length: {lengths}")
        axes[tuple(lists)] = list(zip(*lists.values()))
    return Plan(
        case,
        axes,
        scatter=flat(tables["scatter"]) if "scatter" in tables else None,
        samples=tables.get("samples"),
        seed=tables.get("seed", 1),
        error_bars=tables.get("error_bars"),
        timeout=tables.get("timeout"),
    )


def _lists(tables: Mapping[str, Any], prefix: str = "") -> dict[str, list[Any]]:
    """The lists of values by keys with dots; {from, to, n} stands for a list."""
    lists: dict[str, list[Any]] = {}
    for name, value in tables.items():
        key = prefix + name
        if isinstance(value, list):
            lists[key] = value
        elif isinstance(value, Mapping) and "from" in value:
            lists[key] = _range(key, value)
        elif isinstance(value, Mapping):
            lists.update(_lists(value, key + "."))
        else:
            raise PlanError(f"{key} is {value!r}; allowed: a list, or {{ from, to, n }}")
    return lists


def _range(key: str, values: Mapping[str, Any]) -> list[float]:
    allowed = '{ from = 2, to = 16, n = 50 }, with spacing = "log" for equal ratios'
    try:
        first, last, n = float(values["from"]), float(values["to"]), values["n"]
    except (KeyError, TypeError, ValueError):
        raise PlanError(f"{key} is {dict(values)}; allowed: {allowed}") from None
    spacing = values.get("spacing", "linear")
    is_known = spacing in ("linear", "log") and set(values) <= {"from", "to", "n", "spacing"}
    if not is_known or type(n) is not int or n < 2 or (spacing == "log" and not first * last > 0):
        raise PlanError(f"{key} is {dict(values)}; allowed: {allowed}")
    return spaced(first, last, n, spacing)


def spaced(first: float, last: float, n: int, spacing: str = "linear") -> list[float]:
    """n values from `first` to `last`, both included, at equal distances or ("log") ratios."""
    parts: Sequence[float] = [i / (n - 1) for i in range(n)]
    if spacing == "log":
        values = [first * (last / first) ** part for part in parts]
    else:
        values = [first + (last - first) * part for part in parts]
    values[-1] = last
    return values
