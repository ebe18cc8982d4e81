"""Measured contact forces and strains: read as instruments write them, compared with a run, fitted by a case.

    from subimpact import measured

    signal = measured.read("hammer.csv")
    print(measured.align(result, signal, low_pass=20e3))
    print(measured.fit(case, signal, ["striker.nose_radius", "contact.damping"]))
"""

from .aligning import Alignment, align, low_passed
from .fitting import Fit, fit
from .reading import Signal, read

__all__ = ["Alignment", "Fit", "Signal", "align", "fit", "low_passed", "read"]
