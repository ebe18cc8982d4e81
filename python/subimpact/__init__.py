"""Sub-impacts of a rigid mass that strikes an elasto-plastic beam.

    import subimpact as si

    case = si.Case.from_file("strike.toml")
    case["striker.velocity"] = 12.0
    result = si.run(case)
    result.sub_impacts["start_s"]

SI units everywhere. `keys()` lists the keys of a case, `columns()` the columns of the tables of a
result. `sweep()` runs populations of cases; docs/populations.md explains how.

The module of C++ and NumPy are loaded when a name below is first used: pages of results need neither.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._core import __version__
    from ._errors import CaseError, OutputError, PlanError, ResultsError, StoreError
    from .case import Case, Key, Material, keys, materials
    from .derivatives import Sensitivity, sensitivity
    from .methods import Comparison, compare, stability, work_precision
    from .predictability import Scatter, scatter
    from .result import Result, columns, read_results
    from .running import run
    from .sweep import Plan, sweep

__all__ = [
    "Case", "CaseError", "Comparison", "Key", "Material", "OutputError", "Plan", "PlanError", "Result", "ResultsError",
    "Scatter", "Sensitivity", "StoreError", "__version__", "columns", "compare", "keys", "materials", "read_results", "run",
    "scatter", "sensitivity", "stability", "sweep", "work_precision",
]

_PLACES = {name: module for module, names in {
    "_core": "_core __version__",
    "_errors": "CaseError OutputError PlanError ResultsError StoreError",
    "case": "Case Key Material keys materials",
    "derivatives": "Sensitivity sensitivity",
    "methods": "Comparison compare stability work_precision",
    "predictability": "Scatter scatter",
    "result": "Result columns read_results",
    "running": "run",
    "sweep": "Plan sweep",
}.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        module = import_module(f".{_PLACES[name]}", __name__)
    except ModuleNotFoundError as error:
        if error.name != f"{__name__}._core":
            raise
        raise ModuleNotFoundError(
            f"the package subimpact in {__path__[0]} was built for another Python than {sys.executable} "
            f"({sys.version.split()[0]}); run the one that scripts/install named, or build for this one: "
            "docs/populations.md",
            name=error.name,
        ) from None
    globals()[name] = module if name == "_core" else getattr(module, name)
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


class _Package(ModuleType):
    """`sweep` is the function, not the package of that name, which its first import would put here."""

    def __setattr__(self, name: str, value: object) -> None:
        if name != "sweep" or not isinstance(value, ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
