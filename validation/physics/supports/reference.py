"""Strikes on a beam that can lift off supports, by a program of its own: cubic Hermite elements with rotary inertia, linear
contacts. Between two events everything is linear, so that the motion is a sum of natural modes in closed form, one set of modes
for each set of contacts that are closed; an event is where an indentation passes zero. Nothing of the library is used."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

N_ELEMENTS = 40
DEAD = 2e-17  # m: below it a change of sign is rounding
SAMPLES_PER_RADIAN = 4.0  # of the highest mode
CHUNK = 256
LEAST_FORCE = 1e-9  # of a contact, over the largest of the run


@dataclass
class Contact:
    """A linear contact that pushes where direction @ q exceeds the gap."""

    direction: np.ndarray
    stiffness: float
    gap: float
    name: str


@dataclass
class Spell:
    """One contact: who, from, to (None: to the end), largest force."""

    name: str
    start: float
    end: float | None
    force: float


@dataclass
class System:
    mass: np.ndarray
    stiffness: np.ndarray
    load: np.ndarray
    contacts: list[Contact]
    modes: dict[frozenset[int], tuple[np.ndarray, np.ndarray, np.ndarray]] = field(default_factory=dict)

    def modes_of(self, closed: frozenset[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Frequencies, shapes normalised by the mass, and generalised forces of constant parts."""
        if closed not in self.modes:
            stiffness, load = self.stiffness.copy(), self.load.copy()
            for i in closed:
                contact = self.contacts[i]
                stiffness += contact.stiffness * np.outer(contact.direction, contact.direction)
                load += contact.stiffness * contact.gap * contact.direction
            factor = np.linalg.cholesky(self.mass)
            half = np.linalg.solve(factor, stiffness)
            squares, vectors = np.linalg.eigh(np.linalg.solve(factor, half.T))
            shapes = np.linalg.solve(factor.T, vectors)
            squares[squares < 1e-13 * squares[-1]] = 0.0
            self.modes[closed] = np.sqrt(squares), shapes, shapes.T @ load
        return self.modes[closed]

    def indentation(self, i: int, q: np.ndarray) -> float:
        return float(self.contacts[i].direction @ q) - self.contacts[i].gap


def point(x: float, length: float, n: int = N_ELEMENTS) -> np.ndarray:
    """Displacement at x as coefficients on the unknowns w_0, w_0', w_1, ..."""
    h = length / n
    k = min(int(x / h + 1e-12), n - 1)
    s = x / h - k
    row = np.zeros(2 * n + 2)
    row[2 * k:2 * k + 4] = [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)]
    return row


def matrices(length: float, bending: float, mass: float, inertia: float, n: int = N_ELEMENTS) -> tuple[np.ndarray, ...]:
    """Mass, stiffness, momentum of the unknowns; mass and inertia per length."""
    h = length / n
    k = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                  [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]) * bending / h**3
    m = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
                  [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]) * mass * h / 420
    m += np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2],
                   [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]]) * inertia / (30 * h)
    p = np.array([h / 2, h**2 / 12, h / 2, -h**2 / 12]) * mass
    size = 2 * n + 2
    stiffness, inertias, momentum = np.zeros((size, size)), np.zeros((size, size)), np.zeros(size)
    for e in range(n):
        at = slice(2 * e, 2 * e + 4)
        stiffness[at, at] += k
        inertias[at, at] += m
        momentum[at] += p
    return inertias, stiffness, momentum


def system_of(case: dict) -> tuple[System, np.ndarray, np.ndarray]:
    """Equations and state at t = 0 of a case with numbers in SI units, as tomllib reads it."""
    beam, striker = case["beam"], case["striker"]
    length, width, height = beam["length"], beam["width"], beam["thickness"]
    area, second = width * height, width * height**3 / 12
    mass, stiffness, momentum = matrices(length, beam["youngs_modulus"] * second, beam["density"] * area, beam["density"] * second)
    n = len(momentum)
    inertias, stiff = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    inertias[:n, :n], inertias[n, n], stiff[:n, :n] = mass, striker["mass"], stiffness
    gravity = case.get("scene", {}).get("gravity", 0.0)
    load = gravity * np.append(momentum, striker["mass"])
    nose = np.append(-point(striker["position"] * length, length), 1.0)
    contacts = [Contact(nose, case["contact"]["stiffness"], 0.0, "striker")]
    for i, spring in enumerate(beam["springs"]):
        row = np.append(point(spring["position"] * length, length), 0.0)
        if not spring.get("one_sided"):
            stiff += spring["stiffness"] * np.outer(row, row)
            continue
        sense = -1.0 if spring.get("side") == "before" else 1.0
        contacts.append(Contact(sense * row, spring["stiffness"], spring.get("gap", 0.0), f"spring {i + 1}"))
    system = System(inertias, stiff, load, contacts)
    q, v = np.zeros(n + 1), np.zeros(n + 1)
    if beam.get("start") == "equilibrium":
        closed = set(range(1, len(contacts)))
        while True:  # until the set of supports on which the beam lies is that which pushes
            k, f = stiff[:n, :n].copy(), load[:n].copy()
            for i in closed:
                row = contacts[i].direction[:n]
                k += contacts[i].stiffness * np.outer(row, row)
                f += contacts[i].stiffness * contacts[i].gap * row
            q[:n] = np.linalg.solve(k, f)
            q[:n] += np.linalg.solve(k, f - k @ q[:n])
            pushing = {i for i in range(1, len(contacts)) if system.indentation(i, q) > 0}
            if pushing == closed:
                break
            closed = pushing
    v[:n:2] = beam.get("velocity", 0.0)
    q[n] = -(nose[:n] @ q[:n])
    v[n] = striker["velocity"]
    return system, q, v


def simulate(case: dict) -> list[Spell]:
    """All contacts up to time.end whose force exceeds LEAST_FORCE of the largest."""
    system, q, v = system_of(case)
    end, t = case["time"]["end"], 0.0
    closed = {i for i in range(1, len(system.contacts)) if system.indentation(i, q) > 0} | {0}
    spells = {i: Spell(system.contacts[i].name, 0.0, None, 0.0) for i in closed}
    done: list[Spell] = []
    signs = lambda: np.array([1.0 if i in closed else -1.0 for i in range(len(system.contacts))])  # noqa: E731
    directions = np.array([contact.direction for contact in system.contacts])
    gaps = np.array([contact.gap for contact in system.contacts])
    stiffnesses = np.array([contact.stiffness for contact in system.contacts])
    while t < end:
        frequencies, shapes, forces = system.modes_of(frozenset(closed))
        y, rate = shapes.T @ (system.mass @ q), shapes.T @ (system.mass @ v)
        rows = directions @ shapes

        def at(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            """Modal coordinates and velocities at times since t."""
            phase = np.outer(frequencies, times)
            cos, sin = np.cos(phase), np.sin(phase)
            over = times * np.sinc(phase / np.pi)
            half = 0.5 * times**2 * np.sinc(phase / (2 * np.pi)) ** 2
            return (y[:, None] * cos + rate[:, None] * over + forces[:, None] * half,
                    rate[:, None] * cos - (frequencies * y)[:, None] * sin + forces[:, None] * over)

        step = 1.0 / (SAMPLES_PER_RADIAN * frequencies[-1])
        since, event = 0.0, None
        while event is None and t + since < end:
            times = since + step * np.arange(0, CHUNK + 1)
            wrong = -signs()[:, None] * (rows @ at(times)[0] - gaps[:, None])
            found = np.argwhere((wrong > DEAD).any(axis=0))
            # Contact just toggled lies at zero: what it begins with is not looked at.
            first = next((int(k) for k in found[:, 0] if k > 0), None)
            last = CHUNK if first is None else first
            inside = times[:last + 1]
            for i, spell in spells.items():
                at_most = (rows[i] @ at(inside[t + inside <= end])[0] - gaps[i]).max(initial=0.0)
                spell.force = max(spell.force, stiffnesses[i] * at_most)
            if first is None:
                since = times[-1]
                continue
            crossing = []
            for i in np.flatnonzero(wrong[:, first] > DEAD):
                low, high = times[first - 1], times[first]
                for _ in range(80):
                    middle = 0.5 * (low + high)
                    value = -signs()[i] * (rows[i] @ at(np.array([middle]))[0][:, 0] - gaps[i])
                    low, high = (low, middle) if value > 0 else (middle, high)
                crossing.append((high, int(i)))
            event = min(crossing)
        if event is None or t + event[0] >= end:
            break
        since, which = event
        coordinates, velocities = at(np.array([since]))
        q, v = shapes @ coordinates[:, 0], shapes @ velocities[:, 0]
        t += since
        together = {which} | {i for when, i in crossing if when - since < 1e-15}
        for i in together:
            if i in closed:
                closed.remove(i)
                spells[i].end = t
                done.append(spells.pop(i))
            else:
                closed.add(i)
                spells[i] = Spell(system.contacts[i].name, t, None, 0.0)
    done += spells.values()
    largest = max(spell.force for spell in done)
    return sorted((s for s in done if s.force >= LEAST_FORCE * largest), key=lambda s: (s.start, s.name))
