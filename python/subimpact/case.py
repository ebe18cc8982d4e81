"""Cases: what is simulated, and how."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._errors import CaseError
from ._text import is_unicode, printable, read_text
from ._toml import dotted, flat, text_of

if TYPE_CHECKING:
    from .result import Result


@dataclass(frozen=True)
class Key:
    """One key of a case."""

    name: str  #: with its table: "beam.length"
    type: str  #: "number", "count", "flag", "text", "choice", "pair", "numbers" or "placed"
    unit: str  #: "" for none
    allowed: str  #: in words: "a number, above 0 (m)"
    least: float | None  #: of a number, or the limit above which it lies; None: any
    most: float | None
    choices: tuple[str, ...]  #: of "choice" and "pair"; words for a "number"
    required: bool  #: has no default
    default: str  #: in words or as a case file has it
    meaning: str


_KEYS = {key["name"]: Key(**key) for key in _core.keys()}


def keys(part: str = "") -> dict[str, Key]:
    """The keys of a case by their names, as `subimpact keys` lists them; those with `part` in name or meaning."""
    part = part.lower()
    return {name: key for name, key in _KEYS.items() if part in name or part in key.meaning.lower()}


@dataclass(frozen=True)
class Material:
    """What `beam.material` stands for, where the case does not give these values."""

    name: str
    density: float  #: kg/m3
    youngs_modulus: float  #: Pa
    poisson: float
    yield_stress: float  #: Pa: the least of a standard, or typical
    source: str


#: The materials of `beam.material` by their names.
materials = {values[0]: Material(*values) for values in _core.materials()}


def _check_name(key: object) -> None:
    if not isinstance(key, str) or not is_unicode(key):
        raise CaseError(f"unknown key {key!r}; subimpact.keys() lists those there are")


def key_of(name: str) -> Key:
    """Raises CaseError."""
    _check_name(name)
    if name not in _KEYS:
        _core.checked(name, 0)  # raises, with the name that is meant
    return _KEYS[name]


def checked(key: str, value: object) -> Any:
    """A value as its key takes it. Raises CaseError."""
    _check_name(key)
    try:
        return _core.checked(key, value)
    except (OverflowError, RuntimeError):  # numbers beyond any double; lone surrogates
        raise CaseError(f"{key} is {value!r}; allowed: {_KEYS[key].allowed}", key) from None


class Case:
    """A case: a scene and how it is modelled, as values of keys such as "striker.velocity".

    It begins as a file, as a text or as tables:

        Case.from_file("strike.toml")
        Case(beam={"length": 0.7112, ...}, striker={"mass": 0.201, ...}, time={"end": 8e-3})
        Case({"beam.length": 0.7112, ...})

    `case[key] = value` then changes a key, as `--set` does. A value that its key does not allow raises CaseError at once; what
    keys must have together is checked by `check`, and before every run. `case[key]` is the value of a key or its default, None
    if the key is left open. Cases may be copied, compared and pickled.
    """

    def __init__(self, tables: Mapping[str, Any] | None = None, /, **more: Any) -> None:
        if tables is not None and not isinstance(tables, Mapping):
            raise TypeError(
                f"Case() has {tables!r}; allowed: tables of values by key; Case.from_file(path) reads a file"
            )
        values = flat({**(tables or {}), **more})
        lines = []
        for key, value in values.items():
            if key in _KEYS:
                value = checked(key, value)
            elif not isinstance(value, (bool, int, float, str)):
                value = str(value)
            lines.append(f"{dotted(key)} = {text_of(value)}\n")
        self._begin("".join(lines), "Case")

    def _begin(self, text: str, name: str, overrides: Sequence[tuple[str, str, str]] = ()) -> None:
        self._text = text
        self._name = name
        self._overrides = tuple(overrides)
        self._settings: dict[str, Any] = {}
        self._loaded: _core.LoadedCase | None = None

    @classmethod
    def from_text(cls, text: str, name: str = "text", overrides: Sequence[tuple[str, str, str]] = ()) -> Case:
        """The case of a TOML text. `name` stands for a file in messages; `overrides`: as of a file."""
        case = cls.__new__(cls)
        case._begin(text, name, overrides)
        case.check()
        return case

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], overrides: Sequence[tuple[str, str, str]] = ()) -> Case:
        """The case of a TOML file, of at most 1,000,000 bytes. `overrides`: keys, values as texts, and where these are from."""
        name = printable(os.fsdecode(path))
        return cls.from_text(read_text(path, "a case file", CaseError, f"{name}: "), name, overrides)

    def _load(self) -> _core.LoadedCase:
        if self._loaded is None:
            if not is_unicode(self._text):
                raise CaseError(f"{self._name}: is no UTF-8 text; allowed: TOML without lone surrogates")
            settings = [*self._overrides] + [
                (key, "default" if value is None else text_of(value), f'case["{key}"]')
                for key, value in self._settings.items()
            ]
            self._loaded = _core.load(self._text, self._name, settings)
        return self._loaded

    def __getitem__(self, key: str) -> Any:
        value = self._settings.get(key)
        kind = _KEYS[key].type if value is not None else ""
        has_unit = isinstance(value, str) and kind == "number"
        has_unit |= kind == "placed" and any(isinstance(entry["position"], str) for entry in value or ())
        if value is not None and not has_unit:
            return value
        _check_name(key)
        return self._load().value(key)

    def __setitem__(self, key: str, value: Any) -> None:
        self._settings[key] = checked(key, value)
        self._loaded = None

    def __delitem__(self, key: str) -> None:
        """As if the key had never been given: its default counts."""
        self._settings[key] = "" if key_of(key).type == "text" else None
        self._loaded = None

    def __contains__(self, key: object) -> bool:
        return key in _KEYS

    def __iter__(self) -> Iterator[str]:
        return iter(_KEYS)

    def get(self, key: str, otherwise: Any = None) -> Any:
        """The value of a key, or `otherwise` where it has none."""
        value = self[key]
        return otherwise if value is None else value

    def keys(self) -> list[str]:
        """The names of all keys, so that dict(case) has their values."""
        return list(_KEYS)

    def run(self, **options: Any) -> Result:
        """The results of `subimpact.run(case, ...)`, with its options."""
        return import_module(".running", __package__).run(self, **options)

    def given(self) -> dict[str, Any]:
        """The keys that the case gives, with their values; all others have their defaults."""
        return {key: self[key] for key in self._load().given()}

    def chosen(self) -> dict[str, Any]:
        """Theory and contact law where the case leaves them open: the model that the scene needs."""
        return {key: self[key] for key in self._load().chosen()}

    def why_chosen(self) -> str:
        """In words; empty if nothing was chosen."""
        return self._load().why_chosen()

    def as_dict(self) -> dict[str, Any]:
        """The values of all keys; None for those left open."""
        return {key: self[key] for key in _KEYS}

    def changed(self, values: Mapping[str, Any] | None = None, /, **tables: Any) -> Case:
        """A copy with other values: case.changed({"striker.velocity": 12.0})."""
        case = self.copy()
        for key, value in flat({**(values or {}), **tables}).items():
            case[key] = value
        return case

    def copy(self) -> Case:
        """A copy that changes by itself."""
        case = Case.__new__(Case)
        vars(case).update(vars(self), _settings=dict(self._settings))
        return case

    __copy__ = copy

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_loaded": None}

    def __eq__(self, other: object) -> bool:
        """Whether both cases have the same results."""
        return isinstance(other, Case) and self.identity() == other.identity()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        try:
            values = self.given()
        except CaseError as error:
            return f"<Case, not whole: {error.problems[0]}>"
        return "<Case " + ", ".join(f"{key}={value!r}" for key, value in values.items()) + ">"

    def _repr_html_(self) -> str:
        """A table of the keys that the case gives, for notebooks."""
        rows = "".join(
            f"<tr><td>{key}</td><td>{escape(text_of(value))}</td><td>{escape(_KEYS[key].unit)}</td></tr>"
            for key, value in self.given().items()
        )
        return f"<table><tr><th>key</th><th>value</th><th>unit</th></tr>{rows}</table>"

    def check(self) -> None:
        """Raises CaseError unless the whole case is allowed."""
        self._load()

    def to_toml(self) -> str:
        """The case as a file: the keys that it gives."""
        return "".join(f"{dotted(key)} = {text_of(value)}\n" for key, value in self.given().items())

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes `to_toml()` into a file."""
        Path(path).write_text(self.to_toml(), encoding="utf-8")

    def notes(self) -> list[str]:
        """Which of the given keys have no effect, in sentences."""
        return self._load().notes()

    def warnings(self) -> list[str]:
        """Values that look as if they were in another unit (mm, MPa), in sentences."""
        return self._load().doubts()

    def explain(self) -> str:
        """What a run will take and how the case will be modelled, as `subimpact explain` prints it."""
        return self._load().explain()

    def resolve(self) -> dict[str, Any]:
        """The settings that a run uses (of the first run, where the program chooses mesh and
        method), as "used" in summary.json. Raises CaseError for what cannot be modelled."""
        return json.loads(self._load().resolved_summary())["used"]

    def identity(self, how: str = "") -> str:
        """A hash of the program's version, of all keys but the title, and of `how`. Cases of the
        same identity have the same results, to the last bit."""
        return self._load().identity(how)


def as_case(case: object) -> Case:
    """The same, if it is a case. Raises TypeError."""
    if not isinstance(case, Case):
        raise TypeError(
            f"{case!r} is no Case; allowed: a subimpact.Case, such as Case.from_file(path)"
        )
    return case
