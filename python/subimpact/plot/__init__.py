"""Figures for publication, by Matplotlib: of a run, of a sweep, of studies.

    from subimpact import plot

    plot.response(result)[0].figure.savefig("response.pdf")
    plot.histogram(sweep.runs, axes, "max_force_N")

A function takes what it draws and panels (axes, or a list of them), and returns the panels; without any
it makes them, in the style of `style()`. It raises `Absent` where the results lack what it draws.
`python -m subimpact.plot DIR`, or `subimpact plot DIR`, draws all that a directory holds.
"""

from .._tables import read_table
from .beam import bending, envelope, shapes, strikes
from .comparison import comparison
from .directory import draw_directory, save
from .run import energies, first_sub_impact, force, gauges, indentation, response, timeline
from .studies import differences, outcomes, sensitivity, work_precision
from .style import Absent, figure, style
from .sweeps import histogram, histograms, sweep_map

__all__ = [
    "Absent", "bending", "comparison", "differences", "draw_directory", "energies", "envelope", "figure", "first_sub_impact",
    "force", "gauges", "histogram", "histograms", "indentation", "outcomes", "read_table", "response", "save", "sensitivity",
    "shapes", "strikes", "style", "sweep_map", "timeline", "work_precision",
]
