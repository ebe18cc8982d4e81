"""Sub-impacts of a rigid mass that strikes an elasto-plastic beam.

    import subimpact as si

    case = si.Case.from_file("strike.toml")
    case["striker.velocity"] = 12.0
    result = si.run(case)
    result.sub_impacts["start_s"]

SI units everywhere. `keys()` lists the keys of a case, `columns()` the columns of the tables of a
result. `sweep()` runs populations of cases; docs/populations.md explains how.
"""

import sys

try:
    from ._core import __version__
except ModuleNotFoundError as error:
    if error.name != f"{__name__}._core":
        raise
    raise ModuleNotFoundError(
        f"the package subimpact in {__path__[0]} was built for another Python than {sys.executable} "
        f"({sys.version.split()[0]}); run the one that scripts/install named, or build for this one: "
        "docs/populations.md",
        name=error.name,
    ) from None
from ._errors import CaseError, OutputError, PlanError, ResultsError, StoreError
from .case import Case, Key, Material, keys, materials
from .derivatives import Sensitivity, sensitivity
from .result import Result, columns, read_results
from .running import run
from .sweep import Plan, sweep

__all__ = [
    "Case",
    "CaseError",
    "Key",
    "Material",
    "OutputError",
    "Plan",
    "PlanError",
    "Result",
    "ResultsError",
    "Sensitivity",
    "StoreError",
    "__version__",
    "columns",
    "keys",
    "materials",
    "read_results",
    "run",
    "sensitivity",
    "sweep",
]
