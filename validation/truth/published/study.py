"""Sub-impacts of the published strike that are called certain, beside a mesh several times finer."""

import argparse
import sys
import time

import numpy as np
import subimpact as si

MODEL = ("beam.theory", "beam.poisson", "contact.law", "contact.yield_pressure")
NO_SHEAR = {"beam.theory": "rayleigh", "contact.law": "foundation"}
WITH_SHEAR = {"beam.poisson": 0.33}
# How the program is run: keys of the case, joined below this opening (m), tolerance.
RUNS = (("shear, joined at 1 um", WITH_SHEAR, 1e-6, None),
        ("shear", WITH_SHEAR, 0.0, None),
        ("no shear", NO_SHEAR, 0.0, None),
        ("shear, joined at 1 um, within 1 us", WITH_SHEAR, 1e-6, 1e-6))


def strike(keys, opening, end):
    case = si.Case(
        beam=dict(length=0.7112, width=0.0163, thickness=0.0075, density=2600.0, youngs_modulus=71.96e9, yield_stress=150e6),
        striker=dict(mass=0.201, nose_radius=0.01, velocity=15.9), time=dict(end=end), output=dict(opening=opening))
    return case.changed(keys)


def partner(hit, others):
    """The one among the others that overlaps a sub-impact, if it is the only one, and the only one to do so."""
    there = others[(others["start_s"] < hit["end_s"]) & (others["end_s"] > hit["start_s"])]
    return there[0] if len(there) == 1 else None


def show(name, keys, opening, tolerance, options):
    """Prints the certain sub-impacts of a run beside those of the fine mesh; returns how many are wrong."""
    case = strike(keys, opening, options.end)
    if tolerance:
        case = case.changed({"accuracy.event_times": tolerance})
    wall, processor = time.monotonic(), time.process_time()
    found = si.run(case, jobs=2)
    wall, processor = time.monotonic() - wall, time.process_time() - processor
    model = {key: found[key] for key in MODEL if found[key] is not None}
    fine = strike({**model, "model.mesh": "cells", "model.segments": options.cells, "solver.method": "central-difference",
                   "output.interval": 0.0, "output.shapes": 0.0}, opening, options.end)
    right = si.run(fine, error_bars="off", body_errors=False).sub_impacts
    hits = found.sub_impacts
    wrong, ratios, first = [], [], [0, 0]
    if options.verbose:
        print(f"\n{name}\n no. zone  start, us    end, us  errors, us    differ by, us")
    for number, hit in enumerate(hits, 1):
        there = partner(hit, right)
        if there is not None and partner(there, hits) is None:
            there = None
        first[0] += hit["zone"] == 1
        first[1] += hit["zone"] == 1 and hit["certain"]
        errors = np.array([hit["start_error_s"], hit["end_error_s"]])
        apart = np.abs([there["start_s"] - hit["start_s"], there["end_s"] - hit["end_s"]]) if there is not None else None
        if hit["certain"] and there is None:
            wrong.append(number)
        elif hit["certain"]:
            ratios += (errors[number == 1:] / np.maximum(apart[number == 1:], 1e-15)).tolist()
        if options.verbose:
            differ = "none there" if apart is None else "".join(f"{1e6 * x:9.3f}" for x in apart)
            doubt = "" if hit["certain"] else f"  {hit['doubt']}" if "doubt" in hits.dtype.names else "  not certain"
            print(f"{number:4}{hit['zone']:4}{1e6 * hit['start_s']:12.2f}{1e6 * hit['end_s']:12.2f}"
                  + "".join(f"{1e6 * x:8.2f}" for x in errors) + f"  {differ}{doubt}")
    covered = sum(ratio >= 1.0 for ratio in ratios)
    mesh = found["model.segments"] if found["model.mesh"] == "cells" else found["model.elements"]
    print(f"| {name} | {mesh} | {len(hits)}, {len(right)} | {hits['certain'].sum()} | {first[1]} of {first[0]} | {len(wrong)} | "
          f"{covered} of {len(ratios)} | {np.median(ratios):.1f} | {wall:.1f}, {processor:.1f} |", flush=True)
    return len(wrong)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, default=21691, help="of the fine mesh")
    parser.add_argument("--end", type=float, default=8e-3, help="of the strike, s")
    parser.add_argument("--only", default="", help="runs whose name contains this")
    parser.add_argument("--verbose", action="store_true", help="each sub-impact beside its counterpart")
    options = parser.parse_args()
    print("| run | mesh | sub-impacts, on the fine mesh | certain | of zone 1 | wrong | times covered | "
          "stated/true, median | s by the clock, of a processor |\n|---|---|---|---|---|---|---|---|---|")
    return sum(show(*run, options) for run in RUNS if options.only in run[0])


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
