"""Events of the scenes of scenes.py by SciPy's solve_ivp (DOP853), by the gap alone and by gap and rate.

    python3 scipy_events.py SCENES OUT [--rate]

Writes the processor time in seconds, then per scene the number of events with kinds and times. With --rate a step
also ends where the rate of the gap changes its sign, so that no step has two roots of the gap; solve_ivp looks at the
gap at the ends of whole steps only, so that a root before such an end is looked for here, on the solver's dense output.
"""

import argparse
import time

import numpy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

RTOL = 2.3e-14  # the least that SciPy takes
MOST_STOPS = 200  # ends a run that stops over and over at one time


def read(file):
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            words = line.split()
            end, mass, velocity, stiffness = (float(w) for w in words[6:10])
            count = int(words[10])
            modes = numpy.array([float(w) for w in words[11:11 + 3 * count]]).reshape(count, 3)
            yield end, mass, velocity, stiffness, modes


def events_of(end, mass, velocity, stiffness, modes, by_rate):
    m, k, s = modes.T
    n = len(m)
    masses = numpy.append(m, mass)
    springs = numpy.append(k, 0.0)
    gains = numpy.append(-s, 1.0)

    def contact(_, y):
        force = stiffness * (gains @ y[:n + 1])
        return numpy.concatenate([y[n + 1:], (-springs * y[:n + 1] - force * gains) / masses])

    def flight(_, y):
        return numpy.concatenate([y[n + 1:], -springs * y[:n + 1] / masses])

    def gap(_, y):
        return gains @ y[:n + 1] + side * aside

    def rate(_, y):
        return gains @ y[n + 1:]

    gap.terminal = rate.terminal = True
    # A root at the start of a piece is no event: the function begins a little beyond it.
    side = 1.0
    fastest = numpy.sqrt(numpy.max(k / m) + stiffness * numpy.sum(gains**2 / masses))
    aside = 1e-15 * velocity / fastest
    y = numpy.zeros(2 * n + 2)
    y[-1] = velocity
    atol = RTOL * numpy.concatenate([numpy.full(n + 1, velocity / fastest), numpy.full(n + 1, velocity)])
    t, closed, events = 0.0, True, []
    rate.direction = -1.0  # the gap's rate changes its sign one way, then the other
    n_stops = 0
    while t < end and n_stops < MOST_STOPS:
        n_stops += 1
        side = 1.0 if closed else -1.0
        gap.direction = -side
        functions = [gap, rate] if by_rate else [gap]
        solution = solve_ivp(contact if closed else flight, (t, end), y, method="DOP853",
                             rtol=RTOL, atol=atol, events=functions, dense_output=by_rate)
        if solution.status != 1:
            break
        t, y = solution.t[-1], solution.y[:, -1]
        passed = by_rate and gap(t, y) * side < 0.0
        if passed:
            t = brentq(lambda at: gap(at, solution.sol(at)), solution.t[-2], t, xtol=1e-300, rtol=1e-15)
            y = solution.sol(t)
        if passed or len(solution.t_events[0]) and solution.t_events[0][-1] == t:
            closed = not closed
            events.append(("begins" if closed else "ends", t))
            rate.direction = -1.0 if closed else 1.0
        else:
            rate.direction = -rate.direction
    return events


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes")
    parser.add_argument("out")
    parser.add_argument("--rate", action="store_true")
    arguments = parser.parse_args()
    lines = []
    start = time.process_time()
    for scene in read(arguments.scenes):
        events = events_of(*scene, arguments.rate)
        lines.append(" ".join([str(len(events))] + [f"{kind} {t!r}" for kind, t in events]))
    seconds = time.process_time() - start
    with open(arguments.out, "w", encoding="utf-8") as out:
        out.write(f"{seconds!r}\n" + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
