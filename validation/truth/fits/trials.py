"""Noisy forces of known strikes: are shift, cut-off, gain and keys within the errors that are stated?"""

import argparse
import re
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

import subimpact as si
from subimpact import measured

HERE = Path(__file__).parent
INTERVAL = 1e-6  # s, between samples
PLAIN = {"output.sections": [], "output.points": [], "output.shapes": 0.0, "output.interval": 5e-7}


def run(case):
    return si.run(case.changed(PLAIN), error_bars="off", body_errors=False)


def signal_of(result, seed, noise, shift, cutoff=None, memory=0.0, gain=1.0):
    """The force as a transducer and a recorder would show it; noise relative to its largest value, each sample's
    with a part `memory` of the one before."""
    times, forces = (np.array(result.history[name]) for name in ("time_s", "force_N"))
    t = np.arange(-1e-4, times[-1], INTERVAL) + INTERVAL * np.random.default_rng([seed, 1]).uniform()
    t = t[t < times[-1]]
    if cutoff is not None:
        fine = np.unique(np.r_[times, t[t > 0]])
        times, forces = fine, measured.low_passed(fine, np.interp(fine, times, forces), cutoff)
    white = np.random.default_rng([seed, 2]).normal(size=len(t))
    coloured = lfilter([np.sqrt(1 - memory**2)], [1, -memory], white)
    return measured.Signal(t + shift, gain * np.interp(t, times, forces, left=0) + noise * forces.max() * coloured)


def alignment_trials(result, n, find, **how):
    """In how many trials all that is found lies within its error, and the largest of these, us."""
    hits, errors = 0, []
    for seed in range(n):
        shift = 1e-3 * np.random.default_rng([seed, 3]).uniform(-1, 1)
        found = measured.align(result, signal_of(result, seed, shift=shift, **how), gain="find",
                               low_pass="find" if find else how.get("cutoff"))
        within = [abs(found.shift - shift) <= found.shift_error, abs(found.gain - how.get("gain", 1.0)) <= found.gain_error]
        if find:
            within.append(abs(found.low_pass - how["cutoff"]) <= found.low_pass_error)
        hits += all(within)
        errors.append(1e6 * found.shift_error)
    return hits, np.median(errors)


def fit_trials(case, start, n, noise, **how):
    """In how many trials all keys lie within three standard errors, and these in the median, per cent."""
    keys, truth = list(start), np.array([case[key] for key in start])
    result, begun = run(case), case.changed(start)
    hits, errors = 0, []
    for seed in range(n):
        found = measured.fit(begun, signal_of(result, seed, noise, 2e-4, **how), keys, low_pass=how.get("cutoff"))
        hits += bool(np.all(np.abs(found.values - truth) <= 3 * found.errors))
        errors.append(100 * found.errors / truth)
    return hits, np.median(errors, axis=0)


def table(n):
    elastic, yielding = (si.Case.from_file(HERE / f"{name}.toml") for name in ("elastic", "yielding"))
    strike = run(elastic)
    rows = []
    for words, find, how in (("noise 1 %", False, {"noise": 0.01}),
                             ("noise 2 %, each sample like the one before (0.9)", False, {"noise": 0.02, "memory": 0.9}),
                             ("20 kHz, noise 1 %", False, {"noise": 0.01, "cutoff": 20e3}),
                             ("20 kHz, to be found, noise 1 %, gain 1.1", True, {"noise": 0.01, "cutoff": 20e3, "gain": 1.1})):
        hits, error = alignment_trials(strike, n, find, **how)
        found = "shift, cut-off, gain" if find else "shift, gain"
        rows.append(f"| {found} | {words} | {hits} of {n} | shift {error:.2g} us |")
    for words, case, start, how in (
            ("elastic, noise 1 %", elastic, {"striker.velocity": 15.0, "contact.stiffness": 6e9}, {"noise": 0.01}),
            ("elastic, 50 kHz, noise 2 %", elastic, {"striker.mass": 0.21, "contact.stiffness": 4.5e9},
             {"noise": 0.02, "cutoff": 50e3}),
            ("yielding, noise 1 %", yielding, {"striker.nose_radius": 0.011, "contact.yield_pressure": 0.9e9}, {"noise": 0.01}),
            ("yielding, noise 2 % (0.9)", yielding, {"striker.velocity": 3.2, "contact.yield_pressure": 1.1e9},
             {"noise": 0.02, "memory": 0.9})):
        hits, errors = fit_trials(case, start, n, **how)
        sizes = ", ".join(f"{key} {error:.2g} %" for key, error in zip(start, errors))
        rows.append(f"| {' and '.join(start)} | {words} | {hits} of {n} | {sizes} |")
    return "\n".join(["| found | force | within their errors | errors |", "|---|---|---|---|", *rows])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--trials", type=int, default=100)
    n = parser.parse_args().trials
    text = table(n)
    print(text)
    if n == 100:
        page = HERE / "README.md"
        old = page.read_text()
        page.write_text(re.sub(r"(<!-- results.*? -->\n).*(<!-- end of results -->)", lambda m: m[1] + text + "\n" + m[2],
                               old, flags=re.DOTALL))


main()
