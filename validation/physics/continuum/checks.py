"""Checks of the continua: frequencies of the free beam; meshes, penalties and balances of the published strike."""

import numpy as np
import pandas as pd

from contacts import joined, markdown

LENGTH, THICKNESS, WIDTH, DENSITY, E, NU = 0.15, 0.0075, 0.0163, 2600.0, 71.96e9, 0.33
ZONE = 1250.0  # us, a tenth of the first period of the published beam


def timoshenko(modulus, near):
    """The frequency in Hz of a free beam with shear (Cowper's coefficient) that is the first below `near`."""
    area, inertia, shear = THICKNESS, THICKNESS**3 / 12, 10 * (1 + NU) / (12 + 11 * NU) * E / (2 * (1 + NU))

    def residual(f):  # moment and shear force at one end from displacement and rotation of the other
        w2 = (2 * np.pi * f) ** 2
        rate = np.array([[0, 1, 0, 1 / (shear * area)], [0, 0, 1 / (modulus * inertia), 0],
                         [0, -DENSITY * inertia * w2, 0, -1], [-DENSITY * area * w2, 0, 0, 0]])
        values, vectors = np.linalg.eig(rate)
        carried = ((vectors * np.exp(values * LENGTH)) @ np.linalg.inv(vectors)).real
        return np.linalg.det(carried[2:, :2])

    high = near
    while residual(high) * residual(0.999 * high) > 0:
        high *= 0.999
    low = 0.999 * high
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if residual(low) * residual(middle) <= 0 else (middle, high)
    return low


def measured(place):
    """Frequency from the line through the times of all zeros of the mode's amplitude."""
    ring = pd.read_csv(place / "ring.csv").to_numpy()
    t, u = 1e-6 * ring[:, 0], ring[:, 1]
    n = np.flatnonzero(u[1:-1] * u[2:] < 0) + 1
    zeros = t[n] - u[n] * (t[n + 1] - t[n]) / (u[n + 1] - u[n])
    return 0.5 / np.polyfit(np.arange(len(zeros)), zeros, 1)[0]


def frequencies(runs):
    rows = []
    for name, program, options, modulus in (("plane stress", "plane", ["--state", "stress"], E),
                                            ("plane strain", "plane", ["--state", "strain"], E / (1 - NU**2)),
                                            ("3-D", "solid", [], E)):
        for mode, beta in ((1, 4.7300407449), (3, 10.9956078380), (5, 17.2787596574)):
            slender = beta**2 * np.sqrt(modulus * THICKNESS**2 / (12 * DENSITY)) / LENGTH**2 / (2 * np.pi)
            theory = timoshenko(modulus, slender)
            end = 6 / theory if mode > 1 or program == "plane" else 2.2 / theory
            command = [f"subimpact_continuum_{program}", "--length", str(LENGTH), "--yield", "0", "--ring", str(mode),
                       "--end", f"{end:.4g}", *options]
            found = measured(runs.folder(f"free/{name}-{mode}", command))
            rows.append((name, mode, f"{slender:.1f}", f"{theory:.1f}", f"{found:.1f}",
                         f"{100 * (found / theory - 1):+.2f} %"))
    return markdown(["", "mode", "without shear, Hz", "Timoshenko, Hz", "continuum, Hz", "difference"], rows)


def zones(contacts):
    return 1 + int((contacts.start_us.to_numpy()[1:] - contacts.end_us.to_numpy()[:-1] > ZONE).sum())


def strike(name, run, opening):
    contacts, summary = run["contacts"], run["summary"]
    parted = joined(contacts, opening)
    return (name, len(contacts), zones(contacts), len(joined(contacts, 0.3)), len(joined(contacts, 10.0)),
            f"{parted.end_us[0]:.1f} ({parted.opening_um[0]:.2g})", f"{1e-3 * contacts.largest_force_N.max():.2f}",
            f"{run['striker_m_s']:.3f}", f"{summary['energy_error']:.1e}", f"{summary['momentum_error']:.0e}",
            f"{summary['penetration_um_to_4_kN']:.2f}")


def table(runs):
    rows = []
    for state, opening in (("stress", 5.0), ("strain", 10.0)):
        for layers in (15, 20):
            for penalty in (1.5, 0.75):
                options = {"state": state}
                if layers != 15:
                    element = THICKNESS / layers
                    options |= {"layers": layers, "element": element, "coarsest": 2 * element}
                if penalty != 1.5:
                    options["penalty"] = penalty
                name = f"plane {state}" + "".join(f"-{value:.3g}" for value in [*options.values()][1:])
                run = runs.continuum("published", name, "plane", options)
                rows.append(strike(f"plane {state}, {layers} layers, penalty {penalty}", run, opening))
    for penalty, place in ((1.5, "published"), (0.75, "published-soft")):
        run = runs.stored(place)
        if run:
            rows.append(strike(f"3-D, 15 x 8 bricks, penalty {penalty}", run, 5.0))
    header = ["", "contacts", "zones", "parted by > 0.3 um", "> 10 um", "first parting, us (um)", "force, kN", "striker, m/s",
              "energy", "momentum", "penetration to 4 kN, um"]
    return frequencies(runs) + "\n\n" + markdown(header, rows)
