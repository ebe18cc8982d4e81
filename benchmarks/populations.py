"""The cost of populations of strikes on two cores: threads, sweeps, workers. Run it on an idle machine."""

import argparse
import statistics
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import subimpact as si
from subimpact.sweep import engines

SCENE = dict(
    beam=dict(length=0.7112, width=0.0163, thickness=0.0075, density=2600.0,
              youngs_modulus=71.96e9, yield_stress=150e6, theory="rayleigh"),
    striker=dict(mass=0.201, nose_radius=0.01, velocity=15.9),
    contact=dict(law="foundation"),
    output=dict(interval=0.0, shapes=0.0),
    time=dict(end=8e-3))
QUICK = si.Case(SCENE, model=dict(section="elastic", mesh="hermite", elements=100),
                solver=dict(method="exponential"))  # some 2 ms per run
YIELDING = si.Case({**SCENE, "time": dict(end=1e-3)}, model=dict(section="exact", mesh="cells", segments=801),
                   solver=dict(method="central-difference"))  # some 10 ms per run
WITH_SHEAR = si.Case({**SCENE, "beam": {**SCENE["beam"], "theory": "timoshenko", "poisson": 0.3},
                      "contact": dict(law="line", yield_pressure="by-depth"), "time": dict(end=1e-3)},
                     model=dict(section="exact", mesh="spectral", elements=52),
                     solver=dict(method="central-difference"))  # some 10 ms per run
SLOW = si.Case(SCENE, model=dict(section="exact", mesh="cells", segments=501),
               solver=dict(method="exponential"))  # some 0.2 s per run


def seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def line(name, measured, target, holds):
    print(f"| {name} | {measured} | {target}{'' if holds else ': not reached'} |", flush=True)


def measure_threads(rounds):
    """Two runs one after another against two threads, in turn."""

    def one():
        si.run(SLOW, error_bars="off")

    def two_threads():
        threads = [threading.Thread(target=one) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    ratios = [seconds(lambda: (one(), one())) / seconds(two_threads) for _ in range(rounds)]
    ratio = statistics.median(ratios)
    line("two runs by two threads, against one after another", f"{ratio:.2f} times faster "
         f"({min(ratios):.2f} to {max(ratios):.2f})", "at least 1.8", ratio >= 1.8)


def plan_of(case, n):
    side = round(n**0.5)
    return si.Plan(case, {"striker.mass": np.linspace(0.15, 0.25, side),
                          "striker.velocity": np.linspace(10.0, 16.0, side)}, error_bars="off")


def samples_of(plan, n):
    numbers = np.random.default_rng(1).choice(len(plan), min(n, len(plan)), replace=False)
    return [plan.case_of(int(number)) for number in numbers]


def measure_sweep(n, directory):
    """Strikes of 2 ms on two processes, with store and tables."""
    plan = plan_of(QUICK, n)
    cases = samples_of(plan, 200)
    alone = min(seconds(lambda: [si.run(case, error_bars="off") for case in cases]) / len(cases) for _ in range(3))
    before = time.process_time()
    whole = seconds(lambda: si.sweep(plan, out=directory / "quick", workers=2))
    overhead = (time.process_time() - before) / len(plan)
    again = seconds(lambda: si.sweep(plan, out=directory / "quick", workers=2))
    target = 30.0 * len(plan) / 10_000
    line(f"{len(plan)} elastic strikes of 8 ms, {1e3 * alone:.2f} ms each, on two workers",
         f"{whole:.1f} s", f"below {target:.0f} s", whole < target)
    ratio = 2.0 * whole / (alone * len(plan))
    line("that sweep over half the sum of its runs alone", f"{ratio:.2f}", "at most 1.15", ratio <= 1.15)
    line("processor time of the coordinator, tables included", f"{1e3 * overhead:.3f} ms per run",
         "below 1 ms", overhead < 1e-3)
    line("the same sweep again, from its store", f"{again:.1f} s", "", True)


def measure_yielding(case, finer, n, directory):
    """Strikes that yield, and how far their first separations are from those on a finer mesh."""
    key, count = finer
    name = f"{case[f'model.{key}']} {'cells' if key == 'segments' else 'spectral elements with shear'}"
    plan = plan_of(case, n)
    whole = seconds(lambda: si.sweep(plan, out=directory / key, workers=2))
    target = 60.0 * len(plan) / 10_000
    line(f"{len(plan)} yielding strikes of 1 ms, {name}, on two workers", f"{whole:.1f} s",
         f"below {target:.0f} s", whole < target)
    errors = []
    for sample in samples_of(plan, 100):
        fine = sample.changed({f"model.{key}": count})
        first, limit = (si.run(each, error_bars="off").sub_impacts["end_s"][0] for each in (sample, fine))
        errors.append(1e6 * abs(first - limit))
    within = np.mean(np.array(errors) < 1.0)
    line(f"first separation of {len(errors)} of them, against {count}: median, largest, share within 1 us",
         f"{np.median(errors):.2f} us, {max(errors):.2f} us, {100 * within:.0f} %",
         "median below 0.5 us, share at least 95 %", np.median(errors) < 0.5 and within >= 0.95)


def measure_workers(n, rounds, directory):
    """The same strikes of 0.2 s by one worker and by two, in turn."""
    plan = si.Plan(SLOW, {"striker.velocity": np.linspace(14.0, 16.0, n)}, error_bars="off")
    ratios = []
    for i in range(rounds):
        one, two = (seconds(lambda: si.sweep(plan, out=directory / f"{i}-{w}", workers=w)) for w in (1, 2))
        ratios.append(one / two)
    ratio = statistics.median(ratios)
    line(f"{n} strikes of {one / n:.2f} s by two workers, against one", f"{ratio:.2f} times faster",
         "at least 1.9", ratio >= 1.9)


def measure_makespan(n_workers, directory):
    """Cases that sleep as long as runs have taken, on more workers than there are cores."""
    durations = np.random.default_rng(1).gamma(2.0, 0.1, 4000)  # s: 0.2 in the mean, some 1
    plan = si.Plan(QUICK, {"striker.velocity": np.linspace(1.0, 16.0, len(durations))})
    row = engines.row_without_result("", "completed", "")

    def run_chunk(plan, numbers):
        time.sleep(durations[numbers].sum())
        rows = [row._replace(identity=engines.identity_of(plan, number)) for number in numbers]
        return rows, durations[numbers].sum()

    given, engines.run_chunk = engines.run_chunk, run_chunk
    with ThreadPoolExecutor(n_workers) as executor:
        whole = seconds(lambda: si.sweep(plan, out=directory / "asleep", executor=executor))
    engines.run_chunk = given
    ideal = max(durations.sum() / n_workers, durations.max())
    line(f"{len(durations)} sleeping cases on {n_workers} workers", f"{whole:.1f} s, ideal {ideal:.1f} s", "", True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10_000, help="of the sweep of quick strikes")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    print("| | measured | target |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        measure_threads(options.rounds)
        measure_sweep(options.runs, Path(name))
        measure_yielding(YIELDING, ("segments", 4001), options.runs, Path(name))
        measure_yielding(WITH_SHEAR, ("elements", 240), options.runs, Path(name))
        measure_workers(60, max(1, options.rounds // 2), Path(name))
        measure_makespan(64, Path(name))


if __name__ == "__main__":
    main()
