"""Contacts of the README's strike that are called certain, beside a mesh of 8001 cells."""

import sys
import time

import numpy as np
import subimpact as si

OPENINGS = (0.0, 1e-6)  # m, below which contacts are joined
CELLS = 8001
OWN_ERROR = 0.2e-6  # s, of times on that mesh: half of its change from 4001 cells, or less
MODEL = ("beam.theory", "beam.poisson", "contact.law", "contact.yield_pressure", "solver.method")


def strike(opening):
    return si.Case(
        beam=dict(length=0.7112, width=0.0163, thickness=0.0075, density=2600.0, youngs_modulus=71.96e9, yield_stress=150e6),
        striker=dict(mass=0.201, nose_radius=0.01, velocity=15.9), time=dict(end=2e-3), output=dict(opening=opening))


def show(opening):
    """Prints the contacts of the default run and their differences; returns how many certain ones are wrong."""
    case, begun = strike(opening), time.monotonic()
    found = si.run(case)
    seconds = time.monotonic() - begun
    model = {key: found[key] for key in MODEL}
    fine = case.changed({**model, "model.mesh": "cells", "model.segments": CELLS, "output.interval": 0.0})
    right = si.run(fine, error_bars="off", body_errors=False).sub_impacts
    hits, n_wrong, differences = found.sub_impacts, 0, []
    print(f"\ncontacts parted by less than {1e6 * opening:g} um joined: {len(hits)}, on {CELLS} cells {len(right)}; "
          f"{int(hits['certain'].sum())} certain, in {seconds:.1f} s\n\n"
          "   start, us     end, us  error, us   start differs, us  end differs, us")
    for hit in hits:
        there = right[np.argmin(np.abs(right["start_s"] - hit["start_s"]))]
        errors = hit["start_error_s"], hit["end_error_s"]
        apart = there["start_s"] - hit["start_s"], there["end_s"] - hit["end_s"]
        is_right = all(abs(d) <= e + OWN_ERROR for d, e in zip(apart, errors))
        n_wrong += bool(hit["certain"]) and not is_right
        if hit["certain"]:
            differences += np.abs(apart).tolist()
        print(f"{1e6 * hit['start_s']:12.2f}{1e6 * hit['end_s']:12.2f}{1e6 * max(errors):11.2f}{1e6 * apart[0]:20.2f}{1e6 * apart[1]:17.2f}"
              f"{'' if hit['certain'] else '  not certain'}{'' if is_right else '  OUTSIDE'}")
    print(f"certain: {n_wrong} wrong; differences at most {1e6 * max(differences):.2f} us, median {1e6 * np.median(differences):.2f} us")
    return n_wrong


if __name__ == "__main__":
    sys.exit(1 if sum(map(show, OPENINGS)) else 0)
