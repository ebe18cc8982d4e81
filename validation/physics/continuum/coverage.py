"""Errors of the model that the program states for open cases, beside how far the continua are from it."""

import statistics

from contacts import markdown

OPEN = {key: "default" for key in ("beam.theory", "contact.law", "contact.indentation", "model.segments",
                                   "solver.method", "solver.rtol", "output.interval")}
# Scene: continuum, and settings beside the open keys.
SCENES = {"published": ("3-D", {"contact.yield_pressure": "default"}),
          "elastic": ("3-D", {}),
          "steel": ("3-D", {"contact.yield_pressure": "default"}),
          "ball": ("3-D", {"contact.yield_pressure": "default", "striker.nose": "sphere"}),
          "cantilever": ("plane stress", {"contact.yield_pressure": "default"})}
FIGURES = {"parting_s": ("parting, us", 1e6), "peak_force_N": ("force, kN", 1e-3),
           "striker_velocity_m_per_s": ("velocity, m/s", 1.0), "permanent_set_m": ("set, mm", 1e3)}
TOTALS = {"peak_force_N": "peak_force_N", "striker_velocity_m_per_s": "striker_velocity_m_per_s",
          "permanent_set_m": "permanent_set_m"}


def of_body(run):
    contacts = run["contacts"]
    parted = contacts[contacts.opening_um > 1.0]
    return {"parting_s": 1e-6 * parted.end_us.iloc[0], "peak_force_N": contacts.largest_force_N.max(),
            "striker_velocity_m_per_s": run["striker_m_s"], "permanent_set_m": 1e-3 * abs(run["set_mm"])}


def numerical_errors(summary, first_end_error):
    totals = summary["totals"] or {}
    errors = {figure: (totals.get(name) or {}).get("error") or 0.0 for figure, name in TOTALS.items()}
    return errors | {"parting_s": first_end_error}


def table(bodies, summary_of):
    """`bodies`: continua by scene. `summary_of(scene, settings)`: summary.json of a run, and the error of its parting."""
    rows, ratios, n_within, n = [], [], 0, 0
    for scene, (_, settings) in SCENES.items():
        if scene not in bodies:
            continue
        summary, parting_error = summary_of(scene, OPEN | settings)
        model, body = summary["model_errors"], of_body(bodies[scene])
        numerical = numerical_errors(summary, parting_error)
        for figure, (words, unit) in FIGURES.items():
            value, error = model["value"][figure], model["error"][figure]
            if value is None or error is None or body[figure] != body[figure]:
                continue
            if scene == "cantilever" and figure == "permanent_set_m":
                continue  # the program's is that of the tip, against the clamp; the continuum's against the chord
            value = abs(value) if figure == "permanent_set_m" else value
            true = abs(value - body[figure])
            within = true <= error + numerical[figure]
            n, n_within = n + 1, n_within + within
            ratios.append((error + numerical[figure]) / true)
            rows.append([scene, words, *(f"{unit * x:.4g}" for x in (body[figure], value, true, error, numerical[figure])),
                         "yes" if within else "**no**"])
    header = ["scene", "figure", "continuum", "program", "difference", "error of the model", "numerical", "within"]
    return (markdown(header, rows) + f"\n\n{n_within} of {n} within; median of stated error over difference: "
            f"{statistics.median(ratios):.1f}.")
