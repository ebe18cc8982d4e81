"""Errors of the body that the program states for open cases, beside how far the continua are from it."""

import statistics

from contacts import markdown

OPEN = {key: "default" for key in ("beam.theory", "contact.law", "contact.indentation", "model.segments",
                                   "solver.method", "solver.rtol", "output.interval")}
OPEN |= {"scene.gravity": "0",  # the continua have none, and a rigid nose
         "contact.striker_modulus": "inf", "contact.striker_poisson": "0.3"}
# Scene: continuum, and settings beside the open keys.
SCENES = {"published": ("3-D", {"contact.yield_pressure": "default"}),
          "elastic": ("3-D", {"beam.yield_stress": "inf", "contact.yield_pressure": "default"}),
          "steel": ("3-D", {"contact.yield_pressure": "default"}),
          "ball": ("3-D", {"contact.yield_pressure": "default", "striker.nose": "sphere"}),
          "cantilever": ("plane stress", {"contact.yield_pressure": "default"})}
FIGURES = {"parting_s": ("parting, us", 1e6), "peak_force_N": ("force, kN", 1e-3),
           "striker_velocity_m_per_s": ("velocity, m/s", 1.0), "permanent_set_m": ("set, mm", 1e3),
           "impulse_Ns": ("impulse, N s", 1.0), "zone_1_end_s": ("end of zone 1, us", 1e6),
           "zone_2_start_s": ("start of zone 2, us", 1e6)}


def zones(contacts, gap_us):
    """Start and end of each zone, s; None: still in contact."""
    found = []
    for contact in contacts.itertuples():
        end = None if contact.end_us != contact.end_us else 1e-6 * contact.end_us
        if not found or 1e-6 * contact.start_us - found[-1][1] > 1e-6 * gap_us:
            found.append([1e-6 * contact.start_us, end])
        found[-1][1] = end
        if end is None:
            break
    return found


def of_body(run, gap_us):
    contacts = run["contacts"]
    parted = contacts[contacts.opening_um > 1.0]
    found = zones(contacts, gap_us)
    return {"parting_s": 1e-6 * parted.end_us.iloc[0], "peak_force_N": contacts.largest_force_N.max(),
            "striker_velocity_m_per_s": run["striker_m_s"], "permanent_set_m": 1e-3 * abs(run["set_mm"]),
            "impulse_Ns": contacts.impulse_Ns.sum(), "zone_1_end_s": found[0][1] if len(found) > 1 else None,
            "zone_2_start_s": found[1][0] if len(found) > 1 else None}


def of_beam(figures):
    """Numbers of the program, or errors of them, by the names above."""
    zones_of = figures["zones"]
    return figures | {"zone_1_end_s": zones_of[0]["end_s"] if len(zones_of) > 1 else None,
                      "zone_2_start_s": zones_of[1]["start_s"] if len(zones_of) > 1 else None}


def computed_errors(summary, first_end_error):
    errors = {name: total.get("error") or 0.0 for name, total in (summary["totals"] or {}).items() if name != "by_zone"}
    return {"zone_1_end_s": 0.0, "zone_2_start_s": 0.0} | errors | {"parting_s": first_end_error}


def table(bodies, summary_of):
    """`bodies`: continua by scene. `summary_of(scene, settings)`: summary.json of a run, and the error of its parting."""
    rows, ratios, n_within = [], [], 0
    for scene, (_, settings) in SCENES.items():
        if scene not in bodies:
            continue
        summary, parting_error = summary_of(scene, OPEN | settings)
        body = of_body(bodies[scene], 1e5 * summary["used"]["first_period_s"])
        values, errors = (of_beam(summary["body_errors"][kind]) for kind in ("value", "error"))
        computed = computed_errors(summary, parting_error)
        for figure, (words, unit) in FIGURES.items():
            value, error = values[figure], errors[figure]
            if value is None or body[figure] is None or body[figure] != body[figure]:
                continue
            if scene == "cantilever" and figure == "permanent_set_m":
                continue  # the program's is that of the tip, against the clamp; the continuum's against the chord
            true = abs(abs(value) - abs(body[figure]))
            total = None if error is None else (error**2 + computed[figure] ** 2) ** 0.5
            within = total is not None and true <= total
            n_within += within
            ratios.append(total / true if total is not None else 0.0)
            rows.append([scene, words, *(f"{unit * x:.4g}" for x in (body[figure], abs(value), true)),
                         "not known" if error is None else f"{unit * error:.4g}", f"{unit * computed[figure]:.4g}",
                         "yes" if within else "**no**"])
    header = ["scene", "figure", "continuum", "program", "difference", "error of the body", "computed", "within"]
    return (markdown(header, rows) + f"\n\n{n_within} of {len(rows)} within their total error; median of stated error over "
            f"difference: {statistics.median(ratios):.1f}.")
