"""Sub-impacts of a rigid mass that strikes an elasto-plastic beam.

    import subimpact as si

    case = si.Case.from_file("strike.toml")
    case["striker.velocity"] = 12.0
    result = si.run(case)
    result.sub_impacts["start_s"]

SI units everywhere. `keys()` lists the keys of a case, `columns()` the columns of the tables of a
result. `sweep()` runs populations of cases; docs/populations.md explains how.
"""

from ._core import __version__
from ._errors import CaseError, OutputError, PlanError, ResultsError, StoreError
from .case import Case, Key, keys
from .result import Result, columns, read_results
from .running import run
from .sensitivity import Sensitivity, sensitivity
from .sweep import Plan, sweep

__all__ = [
    "Case",
    "CaseError",
    "Key",
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
    "read_results",
    "run",
    "sensitivity",
    "sweep",
]
