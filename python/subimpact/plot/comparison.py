"""A figure of several runs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..result import Result
from .style import COLOURS, CONTACT, Absent, bands, figure, unit

_PANELS = (("force_N", "contact force", "force"), ("f_c_m", "deflection $f_c$", "length"), ("v_m_m_per_s", "striker", None),
           ("U_e_J", "energy $U_e$", "energy"))
_LINES = ("-", "--", "-.", ":")


@figure([[0], [1], [2], [3]], height=8.6, sharex=True)
def comparison(several: Mapping[str, Result], axes: Any = None) -> Any:
    """Contact force, deflection of the struck point, velocity of the striker and elastic energy of bending of each run over time.
    Shaded: sub-impacts of the first run."""
    drawn = {name: result for name, result in several.items() if len(result.history)}
    if not drawn:
        raise Absent("the runs kept no history; run them again with output.interval above 0")
    first = next(iter(several.values()))
    end = max(result.time for result in several.values())
    time_unit, t = unit("time", end)
    for panel, (column, label, quantity) in zip(axes, _PANELS):
        name, factor = unit(quantity, *(r.history[column] for r in drawn.values())) if quantity else ("m/s", 1.0)
        hits = first.sub_impacts
        bands(panel, t * hits["start_s"], t * np.nan_to_num(hits["end_s"], nan=first.time), CONTACT)
        for k, (run, result) in enumerate(drawn.items()):
            panel.plot(t * result.history["time_s"], factor * result.history[column], _LINES[k % len(_LINES)], label=run,
                       color=COLOURS[k % len(COLOURS)], linewidth=0.9)
        panel.set(ylabel=f"{label}, {name}", xlim=(0, t * end))
    axes[-1].set_xlabel(f"time, {time_unit}")
    axes[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=min(len(drawn), 3), borderaxespad=0.1)
