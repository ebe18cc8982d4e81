"""Random scenes with every choice left to the program: refusals, cost, and peaks of fields beside finer runs."""

import argparse
import subprocess
import time
import tomllib
from multiprocessing import Pool

import numpy as np
import subimpact as si

PEAKS = ("max_displacement_m", "max_moment_Nm", "max_strain")
TABLES_LEFT_OPEN = ("solver", "study", "accuracy", "repeat", "output")
FINER = (1.5, 2.25)  # meshes of the runs that say what is right
INSTANTS = 3900  # of these runs
SETTLED = 0.3  # the two differ by less than this share of the error that is tried, or nothing is said
MOST_SECONDS = 5.0  # of such a run
LONG = 24.0  # s of a processor: 12 s on two


def open_case(writer, seed, number):
    """The case of a random scene without mesh, method, tolerances and rows of its own."""
    text = subprocess.run([writer, "--write", str(number), "--of", "keys", "--seed", str(seed)],
                          capture_output=True, text=True, check=True).stdout
    tables = tomllib.loads(text)
    for name in TABLES_LEFT_OPEN:
        tables.pop(name, None)
    section = tables["model"].get("section")
    tables["model"] = {"section": section} if section == "elastic" else {}
    return si.Case(tables)


def finer_peaks(case, result, ratio):
    """Peaks of the case by a run on a mesh finer than that of a result, at instants closer together."""
    model, solver = result.summary["case"]["model"], result.summary["case"]["solver"]
    size = "segments" if model["mesh"] == "cells" else "elements"
    finer = case.copy()
    finer["model.mesh"] = model["mesh"]
    finer[f"model.{size}"] = round(ratio * model[size])
    finer["solver.method"] = solver["method"]
    if solver["method"] != "central-difference":
        finer["solver.rtol"] = max(1e-11, 0.1 * solver["rtol"])
    finer["output.interval"] = case["time.end"] / INSTANTS
    run = si.run(finer, error_bars="off", body_errors=False, timeout=MOST_SECONDS)
    if run.outcome != "completed":
        raise TimeoutError(run.message)
    return {name: max(np.abs(run.envelope[side + name[3:]]).max() for side in ("max", "min")) for name in PEAKS}


def study_scene(arguments):
    writer, seed, number, with_peaks = arguments
    row = {"number": number, "refused": "", "seconds": 0.0, "sub_impacts": 0, "certain": 0, "peaks": {}}
    try:
        case = open_case(writer, seed, number)
        begun = time.process_time()
        result = si.run(case)
        row["seconds"] = time.process_time() - begun
        row["sub_impacts"], row["certain"] = len(result.sub_impacts), int(result.sub_impacts["certain"].sum())
    except si.CaseError as error:
        row["refused"] = str(error)
        return row
    totals = result.summary["totals"]
    if not with_peaks or result.outcome != "completed" or not totals:
        return row
    try:
        coarser, right = (finer_peaks(case, result, ratio) for ratio in FINER)
    except (si.CaseError, TimeoutError):
        return row
    for name in PEAKS:
        error = totals.get(name, {}).get("error")
        if error is None or name not in right or abs(right[name] - coarser[name]) > SETTLED * error:
            continue
        row["peaks"][name] = (totals[name]["value"], error, right[name])
    return row


def print_rows(rows, verbose):
    refused = [row for row in rows if row["refused"]]
    taken = sorted((row["seconds"], row["number"]) for row in rows if not row["refused"])
    print(f"{len(rows)} scenes, {len(refused)} refused, {sum(seconds > LONG for seconds, _ in taken)} above {LONG:.0f} s "
          f"of a processor; longest: " + ", ".join(f"{seconds:.1f} s (scene {number})" for seconds, number in taken[:-6:-1]))
    if taken:
        print(f"median {taken[len(taken) // 2][0]:.2f} s, sum {sum(seconds for seconds, _ in taken):.0f} s; "
              f"{sum(row['certain'] for row in rows)} of {sum(row['sub_impacts'] for row in rows)} sub-impacts certain")
    for row in refused:
        print(f"  scene {row['number']} refused: {row['refused'][:150]}")
    for name in PEAKS:
        found = [(row["number"], *row["peaks"][name]) for row in rows if name in row["peaks"]]
        outside = [entry for entry in found if abs(entry[1] - entry[3]) > entry[2]]
        widths = sorted(error / abs(value) for _, value, error, _ in found if value)
        median = f"{100 * widths[len(widths) // 2]:.2g} %" if widths else "-"
        share = f"{100 - 100 * len(outside) / len(found):.1f} %" if found else "-"
        print(f"{name}: {len(found) - len(outside)} of {len(found)} within their error ({share}), median error {median}")
        for number, value, error, right in outside if verbose else []:
            print(f"  scene {number}: {value:.6g} +- {error:.2g}, right {right:.6g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene-writer", required=True, help="the program subimpact_random_scenes")
    parser.add_argument("--scenes", type=int, default=300)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--minutes", type=float, default=60.0, help="no further scenes after that time")
    parser.add_argument("--cost", action="store_true", help="no finer runs: refusals and cost alone")
    parser.add_argument("--verbose", action="store_true", help="name every peak that is not covered")
    options = parser.parse_args()
    scenes = [(options.scene_writer, options.seed, number, not options.cost)
              for number in range(options.first, options.first + options.scenes)]
    rows, begun = [], time.monotonic()
    with Pool(options.jobs, maxtasksperchild=20) as workers:
        for row in workers.imap_unordered(study_scene, scenes):
            rows.append(row)
            if len(rows) % 20 == 0:
                print(f"... {len(rows)} of {len(scenes)} scenes", flush=True)
            if time.monotonic() - begun > 60 * options.minutes:
                print(f"ended after {options.minutes:g} minutes")
                break
    print_rows(rows, options.verbose)


if __name__ == "__main__":
    main()
