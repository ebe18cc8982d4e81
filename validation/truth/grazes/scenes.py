"""Grazes whose answers are known to fifty digits: scenes and all their events, one line each.

A mass meets a beam of one or more modes through a spring that can push only. In contact and apart the equations
are linear, so the indentation is a sum of sines and a straight line on each piece; the pieces end at its roots. One
stiffness is tuned until a local extremum of the indentation lies a wanted depth beyond zero, or short of it.

    python3 scenes.py OUT [--one-mode N] [--beams N] [--seed S]
"""

import argparse
import math
import multiprocessing
import random
from dataclasses import dataclass

import mpmath
import numpy
from mpmath import mpf

mpmath.mp.dps = 50

LEAST_OTHER = 1e-3  # of the amplitude: how far every other extremum stays from zero
DEEPEST, SHALLOWEST = -2.0, -13.0  # decades of the depth over the amplitude


@dataclass
class Scene:
    striker_mass: float
    velocity: float
    stiffness: float  # of the contact, N/m
    modes: list  # (mass, stiffness, displacement of the struck point)

    def highest(self):
        return max(math.sqrt(k / m) for m, k, _ in self.modes)

    def fastest(self):
        joined = self.stiffness * (1.0 / self.striker_mass + sum(s * s / m for m, _, s in self.modes))
        return math.sqrt(self.highest() ** 2 + joined)


class Piece:
    """The indentation from t = 0 on, in contact or apart: a sum of sines and, apart, a line."""

    def __init__(self, scene, positions, velocities, closed):
        masses = [mpf(m) for m, _, _ in scene.modes] + [mpf(scene.striker_mass)]
        self.roots = [mpmath.sqrt(m) for m in masses]
        squares = [mpf(k) / mpf(m) for m, k, _ in scene.modes] + [mpf(0)]
        gains = [-mpf(s) / r for (_, _, s), r in zip(scene.modes, self.roots)] + [1 / self.roots[-1]]
        self.x = [r * q for r, q in zip(self.roots, positions)]
        self.v = [r * q for r, q in zip(self.roots, velocities)]
        n = len(masses)
        if closed:
            self.squares = eigenvalues(squares, gains, mpf(scene.stiffness))
            self.vectors = []
            for mu in self.squares:
                vector = [g / (d - mu) for g, d in zip(gains, squares)]
                size = mpmath.sqrt(sum(c * c for c in vector))
                self.vectors.append([c / size for c in vector])
        else:
            self.squares = squares
            self.vectors = [[mpf(i == j) for i in range(n)] for j in range(n)]
        project = lambda vector, of: sum(a * b for a, b in zip(vector, of))
        self.z = [project(vector, self.x) for vector in self.vectors]
        self.zv = [project(vector, self.v) for vector in self.vectors]
        self.gain = [project(vector, gains) for vector in self.vectors]
        self.frequencies = [mpmath.sqrt(mu) for mu in self.squares]
        self.coarse = numpy.array(
            [[float(w), float(g * z), float(g * v)]
             for w, g, z, v in zip(self.frequencies, self.gain, self.z, self.zv)])

    def on_grid(self, times):
        value = numpy.zeros_like(times)
        rate = numpy.zeros_like(times)
        for w, a, b in self.coarse:
            if w == 0.0:
                value += a + b * times
                rate += b
            else:
                c, s = numpy.cos(w * times), numpy.sin(w * times)
                value += a * c + b / w * s
                rate += b * c - a * w * s
        return value, rate

    def at(self, t):
        """Indentation, its rate and the rate of that."""
        value = rate = second = mpf(0)
        for w, mu, g, z, v in zip(self.frequencies, self.squares, self.gain, self.z, self.zv):
            if w == 0:
                value, rate = value + g * (z + v * t), rate + g * v
                continue
            c, s = mpmath.cos_sin(w * t)
            position = z * c + v / w * s
            value, rate, second = value + g * position, rate + g * (v * c - z * w * s), second - g * mu * position
        return value, rate, second

    def state(self, t):
        n = len(self.x)
        x, v = [mpf(0)] * n, [mpf(0)] * n
        for w, vector, z, zv in zip(self.frequencies, self.vectors, self.z, self.zv):
            if w == 0:
                position, rate = z + zv * t, zv
            else:
                c, s = mpmath.cos_sin(w * t)
                position, rate = z * c + zv / w * s, zv * c - z * w * s
            for i in range(n):
                x[i] += vector[i] * position
                v[i] += vector[i] * rate
        return [a / r for a, r in zip(x, self.roots)], [a / r for a, r in zip(v, self.roots)]

    def extremum(self, t):
        for _ in range(12):
            _, rate, second = self.at(t)
            change = rate / second
            t -= change
            if abs(change) < mpf(10) ** -44 * abs(t):
                break
        return t

    def root(self, a, b, guess=None):
        """The one root between a and b, where the indentation has opposite signs or is zero at a."""
        at_b = self.at(b)[0]
        grid = numpy.linspace(float(a), float(b), 4000)
        change = numpy.nonzero((self.on_grid(grid)[0][1:-1] > 0) != (at_b > 0))[0]
        if len(change) and change[-1] + 3 < len(grid):
            close = (mpf(grid[change[-1] + 1]), mpf(grid[change[-1] + 2]))
            if (self.at(close[0])[0] > 0) != (at_b > 0) and (self.at(close[1])[0] > 0) == (at_b > 0):
                a, b = close
        t = guess if guess is not None and a < guess < b else (a + b) / 2
        for _ in range(400):
            value, rate, _ = self.at(t)
            if (value > 0) == (at_b > 0):
                b = t
            else:
                a = t
            following = t - value / rate if rate != 0 else (a + b) / 2
            if abs(following - t) < mpf(10) ** -44 * b:
                return following
            if not a < following < b:
                following = (a + b) / 2
            t = following
        raise ArithmeticError("no root")


def eigenvalues(squares, gains, stiffness):
    """Of diag(squares) + stiffness gains gains^T, each from its double by Newton's method."""
    approximate = numpy.diag([float(d) for d in squares])
    g = numpy.array([float(x) for x in gains])
    approximate += float(stiffness) * numpy.outer(g, g)
    found = []
    for start in numpy.linalg.eigvalsh(approximate):
        mu = mpf(float(start))
        for _ in range(40):
            # f = (1/K + sum g^2/(d - mu)) has poles; mu moves between two of them.
            terms = [x * x / (d - mu) for x, d in zip(gains, squares)]
            slope = sum(t / (d - mu) for t, d in zip(terms, squares))
            change = (1 / stiffness + sum(terms)) / slope
            mu -= change
            if abs(change) < mpf(10) ** -46 * abs(mu):
                break
        else:
            raise ArithmeticError("eigenvalue")
        found.append(mu)
    if any(b - a < mpf(10) ** -20 * b for a, b in zip(found, found[1:])):
        raise ArithmeticError("eigenvalues coincide")
    return found


@dataclass
class Extremum:
    piece: int
    index: int  # within its piece
    time: object
    value: object
    closed: bool  # a minimum in contact, else a maximum apart


class Path:
    """Pieces, events and those extrema of the indentation that lie towards zero, to the end of time."""

    def __init__(self, scene, end, most_pieces=60):
        self.events = []  # (time, begins?)
        self.extrema = []
        self.depths = {}  # of a separation or contact: its largest excursion, by index of the piece
        self.amplitude = mpf(0)
        positions = [mpf(0)] * (len(scene.modes) + 1)
        velocities = [mpf(0)] * len(scene.modes) + [mpf(scene.velocity)]
        start, closed, number = mpf(0), True, 0
        step = 0.02 / scene.fastest()
        while True:
            piece = Piece(scene, positions, velocities, closed)
            side = 1 if closed else -1
            left = float(end - start)
            # Roots may lie close to the start: the first steps are graded.
            graded = step * numpy.geomspace(1e-9, 1.0, 60)[:-1]
            times = numpy.concatenate([graded, numpy.arange(step, left + step, step)])
            _, rate = piece.on_grid(times)
            turns = numpy.nonzero(numpy.sign(rate[1:]) != numpy.sign(rate[:-1]))[0]
            before, root, index = mpf(0), None, 0
            for i in turns:
                share = rate[i] / (rate[i] - rate[i + 1])
                t = piece.extremum(mpf(times[i] + share * (times[i + 1] - times[i])))
                if not before < t:
                    raise ArithmeticError("extrema out of order")
                value, _, second = piece.at(t)
                if t > left:
                    break
                if side * value < 0:
                    self.extrema.append(Extremum(number, index, start + t, value, closed))
                    root = piece.root(before, t, t - mpmath.sqrt(abs(2 * value / second)))
                    break
                self.depths[number] = max(self.depths.get(number, mpf(0)), abs(value))
                self.amplitude = max(self.amplitude, abs(value))
                if side * second > 0:
                    self.extrema.append(Extremum(number, index, start + t, value, closed))
                before, index = t, index + 1
            if root is None:
                value = piece.at(mpf(left))[0]
                if side * value < 0:
                    root = piece.root(before, mpf(left))
            if root is None:
                return
            self.events.append((start + root, not closed))
            if len(self.events) == most_pieces:
                return
            positions, velocities = piece.state(root)
            start, closed, number = start + root, not closed, number + 1


def target_of(path, choice):
    """The chosen extremum again after a change of the scene; None if the path has become another one."""
    for extremum in path.extrema:
        if (extremum.piece, extremum.index) == (choice.piece, choice.index):
            return extremum
    return None


def tuned(scene, end, choice, wanted):
    """The scene with the contact's stiffness such that the chosen extremum is wanted times the amplitude."""
    def miss(stiffness):
        trial = Scene(scene.striker_mass, scene.velocity, stiffness, scene.modes)
        path = Path(trial, end, most_pieces=choice.piece + 1)
        extremum = target_of(path, choice)
        if extremum is None:
            raise ArithmeticError("path changed")
        amplitude = max(value for number, value in path.depths.items() if number <= choice.piece)
        return extremum.value / amplitude - wanted

    a, b = scene.stiffness, scene.stiffness * (1 + 1e-4)
    fa, fb = miss(a), miss(b)
    for _ in range(30):
        if fa == fb:
            break
        c = float(mpf(b) - fb * (mpf(b) - mpf(a)) / (fb - fa))
        if not 0.3 * scene.stiffness < c < 3.0 * scene.stiffness:
            raise ArithmeticError("left the range")
        if c == b or abs(fb) < 1e-3 * abs(wanted):
            return Scene(scene.striker_mass, scene.velocity, b, scene.modes)
        a, fa, b = b, fb, c
        fb = miss(b)
    raise ArithmeticError("no stiffness")


def one_mode(draw):
    mass, frequency = 1.0, 10 ** draw.uniform(3, 4)
    stiffness = mass * frequency**2
    return Scene(10 ** draw.uniform(0.3, 1.3), 1.0, stiffness * 10 ** draw.uniform(0.0, 1.0), [(mass, stiffness, 1.0)])


def beam(draw):
    """Pinned, of one kilogram, with its first modes; struck anywhere."""
    first = 10 ** draw.uniform(2.5, 3.5)
    place = draw.uniform(0.2, 0.8)
    count = draw.randint(3, 6)
    modes = [(0.5, 0.5 * (first * k * k) ** 2, math.sin(k * math.pi * place)) for k in range(1, count + 1)]
    contact = 0.5 * first**2 * 10 ** draw.uniform(1.0, 3.0)
    return Scene(10 ** draw.uniform(-0.7, 0.7), 1.0, contact, modes)


def make(task):
    """A scene with one graze of the wanted depth (negative: a near miss) and its line."""
    family, number, seed, decade, touches = task
    draw = random.Random(f"{seed} {family} {number}")
    kind_wanted = number % 2 == 0  # an opening of a contact, else a closing of a gap
    while True:
        scene = one_mode(draw) if family == "one-mode" else beam(draw)
        lowest = min(math.sqrt(k / m) for m, k, _ in scene.modes)
        end = 3.0 * 2.0 * math.pi / lowest
        try:
            path = Path(scene, mpf(end), most_pieces=4)
            choices = [e for e in path.extrema if e.closed == kind_wanted]
            choices = [e for e in choices if abs(e.value) < 0.3 * path.amplitude]
            if not choices:
                continue
            choice = min(choices, key=lambda e: abs(e.value))
            sign = -1 if choice.closed == touches else 1
            until = choice.time * mpf("1.02") + mpf(0.3 / scene.fastest())
            scene = tuned(scene, until, choice, sign * mpf(10) ** mpf(decade))
            end = float(choice.time) + 1.0 / scene.highest()
            path = Path(scene, mpf(end))
        except (ArithmeticError, ValueError, ZeroDivisionError):
            continue
        graze = target_of(path, choice)
        if graze is None:
            continue
        amplitude = max(value for n, value in path.depths.items() if n <= choice.piece)
        others = [e for e in path.extrema if e is not graze and abs(e.value) < LEAST_OTHER * amplitude]
        excursions = [d for n, d in path.depths.items()
                      if n not in (choice.piece + 1, len(path.events)) and d < LEAST_OTHER * amplitude]
        if others or excursions or (path.events and float(path.events[-1][0]) > end - 0.02 / scene.fastest()):
            continue
        if touches:
            # Beyond zero the piece is another one: the depth is that of the piece itself.
            if len(path.events) < choice.piece + 2 or choice.piece + 1 not in path.depths:
                continue
            depth = path.depths[choice.piece + 1] / amplitude
            duration = path.events[choice.piece + 1][0] - path.events[choice.piece][0]
        else:
            depth, duration = -abs(graze.value) / amplitude, mpf(0)
        words = [family, number, "opening" if choice.closed else "closing", mpmath.nstr(depth, 17),
                 repr(float(graze.time)), mpmath.nstr(duration, 17), repr(end), repr(scene.striker_mass),
                 repr(scene.velocity), repr(scene.stiffness), len(scene.modes)]
        for mode in scene.modes:
            words += [repr(x) for x in mode]
        words.append(len(path.events))
        for time, begins in path.events:
            words += ["begins" if begins else "ends", mpmath.nstr(time, 25)]
        return " ".join(str(word) for word in words)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("--one-mode", type=int, default=920, help="grazes of one mode, half of them near misses")
    parser.add_argument("--beams", type=int, default=1000, help="random grazes on beams, a quarter of them near misses")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    tasks = []
    levels = 23  # twice per decade
    for i in range(arguments.one_mode):
        decade = DEEPEST + (SHALLOWEST - DEEPEST) * (i // 4 % levels) / (levels - 1)
        tasks.append(("one-mode", i, arguments.seed, decade, i // 2 % 2 == 0))
    for i in range(arguments.beams):
        tasks.append(("beam", i, arguments.seed, draw.uniform(SHALLOWEST, DEEPEST), i // 2 % 4 != 3))
    with multiprocessing.Pool() as pool, open(arguments.out, "w", encoding="utf-8") as out:
        for line in pool.imap(make, tasks, chunksize=4):
            out.write(line + "\n")


if __name__ == "__main__":
    main()
