"""The strike by SciPy's DOP853 and RK45, on right-hand sides of this program compiled into a library.

    python3 scipy_strike.py LIBRARY OUT SCENE      writes OUT.SCENE: setting seconds count start end ...

The steps are SciPy's; events are roots of the event functions on its dense output, found with brentq; histories of
sections advance at the ends of steps.
"""

import ctypes
import sys
import time

import numpy
from scipy.integrate import DOP853, RK45
from scipy.optimize import brentq

END = 2e-3  # s
BUDGET = 60.0  # s for all settings of a scene
US = 1e-6

SETTINGS = {
    "elastic": [(DOP853, tolerance, None) for tolerance in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8)],
    "exact": [(DOP853, 1e-6, None), (DOP853, 1e-7, None), (RK45, 1e-6, 0.1), (RK45, 1e-7, 0.05), (RK45, 1e-8, 0.025)],
}
SETTINGS["layered"] = SETTINGS["exact-with-shear"] = SETTINGS["exact"]
SETTINGS["elastic-with-shear"] = SETTINGS["elastic"]


class Strike:
    def __init__(self, library, scene):
        self.c = ctypes.CDLL(library)
        self.c.strike_make.restype = ctypes.c_void_p
        for name in ("unit", "scale"):
            getattr(self.c, "strike_" + name).restype = ctypes.c_double
        pointer = ctypes.c_void_p
        self.of = pointer(self.c.strike_make(scene.encode()))
        self.size = self.c.strike_size(self.of)
        self.unit = self.c.strike_unit(self.of)
        self.scale = self.c.strike_scale(self.of)
        self.values = numpy.zeros(4)

    def __del__(self):
        self.c.strike_free(self.of)

    @staticmethod
    def at(array):
        return ctypes.c_void_p(array.ctypes.data)

    def start(self):
        y = numpy.zeros(self.size)
        self.c.strike_start(self.of, self.at(y))
        return y

    def rate(self, _, y):
        y = numpy.ascontiguousarray(y)
        result = numpy.empty(self.size)
        self.c.strike_rate(self.of, self.at(y), self.at(result))
        return result

    def events(self, y):
        y = numpy.ascontiguousarray(y)
        n = self.c.strike_events(self.of, self.at(y), self.at(self.values))
        return self.values[:n].copy()

    def advance(self, y):
        self.c.strike_commit(self.of, self.at(y))

    def happen(self, event, y):
        return self.c.strike_pass(self.of, event, self.at(y))


def run(library, scene, solver_class, tolerance, longest):
    strike = Strike(library, scene)
    end = END / strike.unit
    options = {"rtol": 3e-14, "atol": tolerance * strike.scale}
    if longest:
        options["max_step"] = longest * US / strike.unit
    y = strike.start()
    t, first = 0.0, 1e-3
    contacts = [[0.0, 0.0]]
    while t < end:
        solver = solver_class(strike.rate, t, y, end, first_step=min(first, end - t), **options)
        before = strike.events(y)
        while solver.status == "running":
            solver.step()
            if solver.status == "failed":
                return contacts
            after = strike.events(solver.y)
            passed = [i for i in range(len(after)) if before[i] <= 0.0 < after[i]]
            if passed:
                break
            before = after
            strike.advance(numpy.ascontiguousarray(solver.y))
        if not passed:
            break
        dense = solver.dense_output()
        roots = [(brentq(lambda u, i=i: strike.events(dense(u))[i], solver.t_old, solver.t, xtol=1e-300, rtol=1e-15), i)
                 for i in passed]
        t, event = min(roots)
        y = numpy.ascontiguousarray(dense(t))
        first = solver.step_size
        kind = strike.happen(event, y)
        if kind == 1:
            contacts.append([t * strike.unit, 0.0])
        elif kind == -1:
            contacts[-1][1] = t * strike.unit
    return contacts


def main():
    library, out, scene = sys.argv[1:4]
    spent = 0.0
    with open(f"{out}.{scene}", "w", encoding="utf-8") as file:
        for solver_class, tolerance, longest in SETTINGS[scene]:
            if spent > BUDGET:
                break
            start = time.process_time()
            contacts = run(library, scene, solver_class, tolerance, longest)
            seconds = time.process_time() - start
            spent += seconds
            text = f"{solver_class.__name__},{tolerance:.0e}" + (f",steps_up_to_{longest}_us" if longest else "")
            times = " ".join(f"{a!r} {b!r}" for a, b in contacts)
            file.write(f"{text} {seconds!r} {len(contacts)} {times}\n")
            file.flush()


if __name__ == "__main__":
    main()
