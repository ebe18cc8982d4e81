"""Scenes beside reference.py, event by event; random scenes by every method, on other meshes, and searched for lost touches."""

from __future__ import annotations

import argparse
import csv
import json
import math
import random
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import reference

BAR = {"length": 0.6, "width": 0.04, "thickness": 0.01, "density": 7850.0, "youngs_modulus": 210e9}
TOLERANCE = 1e-8  # s, of event times beside the reference
SHARED_FORCE = 1e-6  # over the largest: weaker contacts are not compared between methods
ROUNDING = 1e-6  # over the largest: below it rounding in front of the waves decides
ALONE = 1e-4


def roller(position: float, stiffness: float = 5e7, **others: object) -> dict:
    return {"position": position, "stiffness": stiffness, "one_sided": True, **others}


def scene(springs: list[dict], at: float = 0.5, mass: float = 0.5, velocity: float = 1.0, stiffness: float = 2e7,
          end: float = 2e-3, gravity: float = 0.0, **beam: object) -> dict:
    case = {"beam": {**BAR, "springs": springs, **beam}, "striker": {"mass": mass, "velocity": velocity, "position": at},
            "contact": {"law": "linear", "stiffness": stiffness}, "time": {"end": end}}
    if gravity:
        case["scene"] = {"gravity": gravity}
    return case


SCENES = {
    "rollers": scene([roller(0.0), roller(1.0)]),
    "off the middle, from equilibrium": scene([roller(0.05), roller(0.95)], at=0.325, gravity=9.81, start="equilibrium"),
    "a stop behind the middle": scene([roller(0.0), roller(1.0), roller(0.5, 2e7, gap=2e-4)], velocity=3.0),
}
KEPT_BACK = {
    "a stop before an end": scene([roller(0.1), roller(0.9), roller(0.0, 1e7, gap=1e-5, side="before")], at=0.7, mass=1.5),
    "four supports": scene([roller(0.0, 2e8), roller(0.25, 2e7, gap=1e-5), roller(0.75, 2e7, gap=1e-5), roller(1.0, 2e8)],
                           at=0.45, mass=2.0, gravity=9.81),
    "a strike over a support": scene([roller(0.5, 1e8), roller(0.1, 1e7), roller(0.9, 1e7)], mass=0.2, velocity=2.0, end=1e-3),
}


def text_of(value: object) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {text_of(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(text_of, value)) + "]"
    return json.dumps(value) if isinstance(value, (str, bool)) else repr(value)


def toml(case: dict) -> str:
    return "\n".join(f"[{table}]\n" + "\n".join(f"{key} = {text_of(value)}" for key, value in keys.items())
                     for table, keys in case.items())


class Run:
    def __init__(self, program: str, case: dict, *arguments: str) -> None:
        with tempfile.TemporaryDirectory() as place:
            file, out = Path(place, "case.toml"), Path(place, "out")
            file.write_text(toml(case))
            done = subprocess.run([program, "run", file, "--out", out, *arguments], capture_output=True, text=True, timeout=600)
            if done.returncode not in (0, 3) or not (out / "summary.json").exists():
                raise RuntimeError(f"{done.stdout}{done.stderr}{toml(case)}")
            self.summary = json.loads((out / "summary.json").read_text())
            number = lambda text: float(text) if text else None  # noqa: E731
            table = lambda name: list(csv.DictReader((out / name).open()))  # noqa: E731
            self.spells = sorted(
                [reference.Spell("striker", float(r["start_s"]), number(r["end_s"]), float(r["peak_force_N"]))
                 for r in table("events.csv")]
                + [reference.Spell(f"at {float(r['position_m']):.6g}", float(r["start_s"]), number(r["end_s"]),
                                   float(r["peak_force_N"])) for r in table("supports.csv")], key=lambda s: (s.start, s.name))
            self.supports = table("supports.csv")
            self.events = table("events.csv")
            self.points = table("points.csv") if (out / "points.csv").exists() else []
        self.ok = self.summary["outcome"]["kind"] == "completed"

    def error(self, of: str) -> float:
        return self.summary["conservation"][f"max_{of}_error_relative"] or 0.0


def by_place(spells: list[reference.Spell], case: dict) -> list[reference.Spell]:
    """Contacts with the place of their support for its name."""
    names = {f"spring {i + 1}": f"at {spring['position'] * case['beam']['length']:.6g}"
             for i, spring in enumerate(case["beam"]["springs"])}
    return sorted((reference.Spell(names.get(s.name, s.name), s.start, s.end, s.force) for s in spells),
                  key=lambda s: (s.start, s.name))


def matched(a: list[reference.Spell], b: list[reference.Spell]) -> tuple[list[tuple], list[reference.Spell]]:
    """Pairs of one name that overlap most, and what is left on either side."""
    pairs, left, free = [], [], list(b)
    for one in a:
        common = lambda other: min(one.end or math.inf, other.end or math.inf) - max(one.start, other.start)  # noqa: E731
        best = max((other for other in free if other.name == one.name and common(other) > 0), key=common, default=None)
        if best is None:
            left.append(one)
            continue
        free.remove(best)
        pairs.append((one, best))
    return pairs, left + free


def difference(one: reference.Spell, other: reference.Spell) -> float:
    ends = [abs(one.start - other.start)]
    if one.end and other.end:
        ends.append(abs(one.end - other.end))
    return max(ends)


FINE = ("--set", "model.mesh=hermite", "--set", f"model.elements={reference.N_ELEMENTS}", "--set", "model.section=elastic",
        "--set", "output.interval=0", "--error-bars=off", "--body-errors=off")


def beside_reference(program: str, name: str, case: dict) -> tuple[str, bool]:
    expected = by_place(reference.simulate(case), case)
    cells, ok = [], True
    for method in ("nystrom", "erk"):
        run = Run(program, case, *FINE, "--set", f"solver.method={method}", "--set", "solver.rtol=1e-13",
                  "--set", "beam.theory=rayleigh")
        pairs, left = matched(expected, run.spells)
        largest = max(s.force for s in expected)
        strong = [p for p in pairs if p[0].force > ROUNDING * largest]
        weak = [p for p in pairs if p[0].force <= ROUNDING * largest]
        worst = max((difference(*p) for p in strong), default=math.inf)
        worst_weak = max((difference(*p) for p in weak), default=0.0)
        strong_left = [s for s in left if s.force > ROUNDING * largest]
        ok = ok and run.ok and worst < TOLERANCE and not strong_left
        cells.append(f"{len(pairs)} of {len(expected)} | {1e6 * worst:.1e} | {1e6 * worst_weak:.1e} | {len(left)}")
    return "\n".join(f"| {name} | {method} | {cell} |" for method, cell in zip(("nystrom", "erk"), cells)), ok


def random_case(rng: random.Random) -> dict:
    length = rng.choice([0.2, 0.6, 1.5])
    height = length * 10 ** rng.uniform(-2, -1)
    beam = {"length": length, "width": 2 * height, "thickness": height, "density": 7850.0, "youngs_modulus": 210e9}
    mass = 7850.0 * 2 * height**2 * length
    bending = 210e9 * height**4 / 6
    own = 48 * bending / length**3
    n = rng.randint(1, 4)
    symmetric = rng.random() < 0.3
    springs = []
    for _ in range(n if not symmetric else (n + 1) // 2):
        # m: sag of a strike, by order of magnitude
        gap = 0.0 if rng.random() < 0.5 else 10 ** rng.uniform(-3, 0) * math.sqrt(mass / own)
        one = roller(round(rng.uniform(0, 1), 3) if rng.random() < 0.6 else rng.choice([0.0, 1.0]), own * 10 ** rng.uniform(0, 3), gap=gap)
        if rng.random() < 0.2:
            one["side"] = "before"
        springs.append(one)
        if symmetric:
            springs.append({**one, "position": 1.0 - one["position"]})
    case = {"beam": {**beam, "springs": springs},
            "striker": {"mass": mass * 10 ** rng.uniform(-1.5, 1), "velocity": 10 ** rng.uniform(-0.5, 0.7),
                        "position": 0.5 if symmetric else round(rng.uniform(0.1, 0.9), 3)},
            "contact": {"law": "linear", "stiffness": own * 10 ** rng.uniform(0.5, 2.5)},
            "time": {"end": rng.uniform(0.5, 2.0) * 2 * math.pi * math.sqrt(mass / own)}}
    kind = rng.random()
    if kind < 0.35:
        case["scene"] = {"gravity": 9.81}
        behind = {s["position"] for s in springs if s.get("side") != "before" and s["gap"] == 0}
        if len(behind) >= 2 and min(behind) < 0.5 < max(behind):
            case["beam"]["start"] = "equilibrium"
    elif kind < 0.5:
        case["beam"]["velocity"] = rng.uniform(0.1, 0.8) * case["striker"]["velocity"]
    return case


def search(run: Run, case: dict) -> int:
    """Touches in the run's own rows that are in no contact of supports.csv: rows within a support by more than its error."""
    lost = 0
    largest = max(s.force for s in run.spells)
    for i, spring in enumerate(case["beam"]["springs"]):
        place = spring["position"] * case["beam"]["length"]
        rows = [r for r in run.points if abs(float(r["position_m"]) - place) < 1e-9]
        sense = -1.0 if spring.get("side") == "before" else 1.0
        spells = [s for s in run.spells if s.name == f"at {place:.6g}"]
        for row in rows:
            t, depth = float(row["time_s"]), sense * float(row["displacement_m"]) - spring["gap"]
            if spring["stiffness"] * depth <= 1e-7 * largest:
                continue
            lost += not any(s.start - 1e-12 <= t <= (s.end or math.inf) + 1e-12 for s in spells)
    return lost


def compare(a: Run, b: Run, share: float) -> tuple[float, int]:
    """Largest difference of events that both have, s; contacts above that share of the force that only one has."""
    largest = max(s.force for s in a.spells)
    pairs, left = matched(a.spells, b.spells)
    return (max((difference(*p) for p in pairs if p[0].force > share * largest), default=0.0),
            sum(s.force > share * largest for s in left))


def random_scene(program: str, seed: int, number: int) -> dict:
    case = random_case(random.Random(f"{seed} {number}"))
    places = sorted({spring["position"] for spring in case["beam"]["springs"]})
    end = case["time"]["end"]
    run_of = lambda method, *more: Run(program, case, *FINE, "--set", "model.elements=24", "--set", f"solver.method={method}",  # noqa: E731
                                       "--set", "solver.rtol=1e-12", "--set", "beam.theory=rayleigh", *more)
    base = run_of("nystrom", "--set", f"output.interval={end / 4000}", "--set", f"output.points={places}")
    found = {"number": number, "ok": base.ok, "energy": base.error("energy"), "momentum": base.error("momentum"),
             "lost": search(base, case), "contacts": len(base.spells)}
    for method in ("erk", "dirk"):
        other = run_of(method, *(["--set", "solver.rtol=1e-11"] if method == "dirk" else []))
        found["ok"] = found["ok"] and other.ok
        found["energy"] = max(found["energy"], other.error("energy"))
        found[method], found[f"{method} alone"] = compare(base, other, SHARED_FORCE)
    steps = [run_of("central-difference", "--set", f"solver.step={step}") for step in
             (0.2 * base.summary["used"]["critical_step_s"], 0.1 * base.summary["used"]["critical_step_s"])]
    errors = [compare(base, step, ALONE)[0] for step in steps]
    found["central"], found["central half"] = errors
    found["central alone"] = compare(base, steps[1], ALONE)[1]
    return found


def judged_scene(program: str, seed: int, number: int) -> tuple[int, int, int, int, int]:
    """Contacts with supports with an error; beyond it; striker's certain sub-impacts; of them missing on a finer mesh."""
    case = random_case(random.Random(f"{seed} {number}"))
    common = ("--set", "model.section=elastic", "--set", "output.interval=0", "--set", "beam.theory=rayleigh")
    run = Run(program, case, *common)
    used = run.summary["case"]["model"]
    size = "elements" if used["mesh"] != "cells" else "segments"
    finer = Run(program, case, *common, "--set", f"model.mesh={used['mesh']}", "--set", f"model.{size}={2 * used[size] + used[size] % 2}",
                "--set", f"solver.method={run.summary['case']['solver']['method']}", "--set", "solver.rtol=1e-12", "--error-bars=off", "--body-errors=off")
    stated = beyond = 0
    for row in run.supports:
        same = [r for r in finer.supports if r["position_m"] == row["position_m"]]
        for column in ("start", "end"):
            if not row[f"{column}_error_s"] or not row[f"{column}_s"] or float(row["start_s"]) == 0.0 and column == "start":
                continue
            stated += 1
            times = [abs(float(r[f"{column}_s"]) - float(row[f"{column}_s"])) for r in same if r[f"{column}_s"]]
            beyond += min(times, default=math.inf) > float(row[f"{column}_error_s"])
    certain = [r for r in run.events if r["certain"] == "1"]
    missing = 0
    for row in certain:
        start, end = float(row["start_s"]), float(row["end_s"] or math.inf)
        missing += not any(float(r["start_s"]) < end and float(r["end_s"] or math.inf) > start for r in finer.events)
    return stated, beyond, len(certain), missing, int(run.ok and finer.ok)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--random", type=int, default=300)
    parser.add_argument("--judged", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--update", action="store_true")
    given = parser.parse_args()
    lines = ["| scene | method | contacts of the reference that the run has | largest difference, us | the same below 1e-6 of the largest force | on one side only |",
             "|---|---|---|---|---|---|"]
    good = True
    for name, case in {**SCENES, **KEPT_BACK}.items():
        line, ok = beside_reference(given.program, name, case)
        print(line)
        lines.append(line)
        good = good and ok
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda k: random_scene(given.program, given.seed, k), range(given.random)))
        judged = list(pool.map(lambda k: judged_scene(given.program, given.seed + 1, k), range(given.judged)))
    if found:
        most = lambda name: max(one[name] for one in found)  # noqa: E731
        count = lambda name: sum(one[name] > 0 for one in found)  # noqa: E731
        ratios = [one["central half"] / one["central"] for one in found if one["central"] > 0]
        lines += ["", "| of random scenes | |", "|---|---|",
                  f"| scenes; all runs complete | {len(found)}; {sum(one['ok'] for one in found)} |",
                  f"| contacts | {sum(one['contacts'] for one in found)} |",
                  f"| energy, momentum off by at most | {most('energy'):.1e}, {most('momentum'):.1e} |",
                  f"| touches that rows show and no table has | {sum(one['lost'] for one in found)} |",
                  f"| erk: times differ by at most, us; scenes with a contact that one lacks | {1e6 * most('erk'):.1e}; {count('erk alone')} |",
                  f"| dirk: the same | {1e6 * most('dirk'):.1e}; {count('dirk alone')} |",
                  f"| central differences: median ratio of errors at half the step; scenes with a contact that one lacks | {np.median(ratios):.2f}; {count('central alone')} |"]
        good = good and all(one["ok"] for one in found) and not sum(one["lost"] for one in found)
        if given.verbose:
            for one in found:
                print(one)
    if judged:
        sums = [sum(column) for column in zip(*judged)]
        lines += [f"| times of supports with an error; beyond it on twice as fine a mesh | {sums[0]}; {sums[1]} |",
                  f"| certain sub-impacts; without a counterpart there | {sums[2]}; {sums[3]} |"]
    print("\n".join(lines[lines.index("") if "" in lines else len(lines):]))
    if given.update:
        page = Path(__file__).with_name("README.md")
        head, _, rest = page.read_text().partition("<!-- results -->\n")
        page.write_text(head + "<!-- results -->\n\n" + "\n".join(lines) + "\n")
    sys.exit(0 if good else 1)


main()
