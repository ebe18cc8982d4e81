"""Continua beside beams: runs what is missing, then writes tables and pictures. See the file study."""

import argparse
import dataclasses
import json
import subprocess
import sys
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams |= {"svg.fonttype": "none", "svg.hashsalt": "continuum"}
import matplotlib.pyplot as plt
import pandas as pd

import checks
import coverage
from contacts import alongside, counted, joined, totals

HERE = Path(__file__).resolve().parent
FINE_STEEL = {"element": 0.667e-3, "coarsest": 1.33e-3}
FOUNDATION = {"contact.law": "foundation", "contact.yield_pressure": "default"}
BEAMS = {
    "shear, line": {},
    "shear, foundation": FOUNDATION,
    "no shear, foundation": FOUNDATION | {"beam.theory": "rayleigh"},
}
BY_DEPTH = {"shear, line, pressure by depth": {"contact.yield_pressure": "by-depth"}}
ELASTIC = {"beam.yield_stress": 1e12}  # of the columns of a foundation
E, NU, Y = 71.96e9, 0.33, 150e6
# A beam in plane strain: E/(1 - nu^2), which is the contact's modulus too if Poisson's ratio is 0; k G is then given by k
# and is 5/(6 - nu) of the metal's G. Of the law 2 ln(2 d/a) - nu/(1 - nu) is too large by 0.49, some 1 um of the dent.
STRAIN = {
    "beam.youngs_modulus": E / (1 - NU**2),
    "beam.yield_stress": 2 * Y / 3**0.5,
    "beam.poisson": 0,
    "beam.shear_coefficient": 5 / (6 - NU) * (1 - NU),
}


@dataclasses.dataclass
class Table:
    """Continua and beams side by side. Times are compared from `since` to `until` us, closing openings up to `opening`."""

    bodies: dict
    beams: dict
    until: float
    since: float = 0.0
    opening: float = 1.0


SCENES = {
    "published": [
        Table({"3-D": ("solid", {}), "plane stress": ("plane", {"state": "stress"})}, BEAMS | BY_DEPTH, 900, since=270),
        Table({"plane strain": ("plane", {"state": "strain"})}, {"shear, line, plane strain": STRAIN}, 1700, opening=4),
    ],
    "elastic": [
        Table({"3-D": ("solid", {})}, {"shear, line": {}, "shear, foundation": FOUNDATION | ELASTIC,
                                       "no shear, foundation": FOUNDATION | ELASTIC | {"beam.theory": "rayleigh"}}, 900),
        Table({"plane strain": ("plane", {"state": "strain", "layers": 30, "element": 0.25e-3, "fine": 4e-3})},
              {"shear, line, plane strain": STRAIN}, 900),
    ],
    "steel": [Table({"3-D": ("solid", FINE_STEEL)}, BEAMS, 2500)],
    "cantilever": [Table({"plane stress": ("plane", {"state": "stress"})}, BEAMS, 5000)],
    "ball": [Table({"3-D": ("solid", {"nose": "ball", "across": 12})},
                   {"shear, sphere from the mid-plane": {},
                    "shear, sphere, half-space, 1.6 Y": {"contact.indentation": "half-space",
                                                         "contact.yield_pressure": "default"}}, 1200)],
}
SOFT = "published-soft"  # in three dimensions, with half the penalty, to 1 ms


class Runs:
    """Runs of both kinds of program, each kept with its options in a folder of its own."""

    def __init__(self, programs, place):
        self.programs, self.place = programs, place

    def folder(self, name, command):
        place = self.place / name.replace(", ", "_").replace(" ", "-")
        made = place / "command.json"
        if made.exists() and json.loads(made.read_text()) == command:
            return place
        print("running " + " ".join(command), file=sys.stderr)
        place.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([str(self.programs / command[0]), *command[1:], "--out", str(place)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip())
        made.write_text(json.dumps(command))
        return place

    def continuum(self, scene, name, program, options):
        given = {key: str(value) for key, value in (of_case(scene) | options).items()}
        command = [f"subimpact_continuum_{program}"]
        for key, value in given.items():
            command += [f"--{key}"] if value == "True" else [f"--{key}", value]
        return read_continuum(self.folder(f"{scene}/{name}", command))

    def beam(self, scene, name, changes):
        command = ["subimpact", "run", str(case_file(scene)), "--quiet", "--error-bars=off"]
        for key, value in changes.items():
            command += ["--set", f"{key}={value}"]
        return read_beam(self.folder(f"{scene}/{name}", command))

    def open_model(self, scene, settings):
        """The summary of a run that chooses its model, and the error (s) of its first parting."""
        command = ["subimpact", "run", str(case_file(scene)), "--quiet"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        place = self.folder(f"{scene}/open", command)
        events = pd.read_csv(place / "events.csv")
        parted = events[events.opening_m > 1e-6].iloc[0]
        error = parted.end_error_s if parted.end_error_s == parted.end_error_s else 0.0
        return json.loads((place / "summary.json").read_text()), error

    def stored(self, name):
        place = HERE / "stored" / name
        return read_continuum(place) if place.exists() else None


def case_file(scene):
    return HERE / "cases" / f"{scene}.toml"


def of_case(scene):
    """The options of the programs that a case file of the beam stands for."""
    case = tomllib.loads(case_file(scene).read_text())
    beam, striker = case["beam"], case["striker"]
    options = {key: beam[key] for key in ("length", "width", "thickness", "density", "poisson")}
    options |= {"modulus": beam["youngs_modulus"], "yield": beam["yield_stress"], "end": case["time"]["end"],
                "mass": striker["mass"], "radius": striker["nose_radius"], "speed": striker["velocity"],
                "position": striker["position"]}
    if case["model"].get("section") == "elastic":
        options["yield"] = 0
    if beam.get("ends", ["free"])[0] == "clamped":
        options["clamped"] = True
    return options


def read_continuum(place):
    summary = pd.read_csv(place / "summary.csv", header=None, index_col=0)[1]
    stored = place / "force.csv"
    force = pd.read_csv(stored if stored.exists() else place / "history.csv")
    return {"contacts": pd.read_csv(place / "contacts.csv"), "force": force[["t_us", "force_N"]],
            "striker_m_s": summary["striker_m_s"], "set_mm": summary["permanent_set_mm"],
            "energy_error": summary["energy_error"], "summary": summary}


def read_beam(place):
    events = pd.read_csv(place / "events.csv")
    contacts = pd.DataFrame({
        "start_us": 1e6 * events.start_s, "end_us": 1e6 * events.end_s, "impulse_Ns": events.impulse_Ns,
        "largest_force_N": events.peak_force_N, "opening_um": 1e6 * events.opening_m,
        "striker_m_s": events.striker_velocity_m_per_s})
    history = pd.read_csv(place / "history.csv")
    summary = json.loads((place / "summary.json").read_text())
    return {"contacts": contacts, "force": pd.DataFrame({"t_us": 1e6 * history.time_s, "force_N": history.force_N}),
            "striker_m_s": summary["final"]["striker_velocity_m_per_s"],
            "set_mm": 1e3 * summary["rest"]["largest_permanent_set_m"] if summary["rest"] else 0.0,
            "energy_error": summary["conservation"]["max_energy_error_relative"]}


def store(run, place):
    """What is kept of a long run: contacts, summary, and the force of the first millisecond, a value per microsecond."""
    place.mkdir(parents=True, exist_ok=True)
    run["contacts"].to_csv(place / "contacts.csv", index=False)
    run["summary"].to_csv(place / "summary.csv", header=False)
    force = run["force"][run["force"].t_us <= 1000.0]
    pairs = force.groupby((force.t_us // 1.0).astype(int)).mean().round(1)
    pairs.to_csv(place / "force.csv", index=False)


def solid(runs, scene, name, options, anew):
    if anew:
        store(runs.continuum(scene, name, "solid", options), HERE / "stored" / scene)
    found = runs.stored(scene)
    if found is None:
        raise RuntimeError(f"nothing is stored of {scene} in three dimensions: scripts/study continuum --solid {scene}")
    return found


def gather(runs, scene, bodies, beams, anew):
    found = {}
    for name, (program, options) in bodies.items():
        try:
            found[name] = (solid(runs, scene, name, options, anew) if program == "solid"
                           else runs.continuum(scene, name, program, options))
        except RuntimeError as error:
            print(f"{scene}, {name}: left out: {error}", file=sys.stderr)
    for name, changes in beams.items():
        try:
            found[name] = runs.beam(scene, name, changes)
        except RuntimeError as error:
            print(f"{scene}, {name}: left out: {error}", file=sys.stderr)
    return found


def coverage_table(runs):
    bodies = {}
    for scene, (kind, _) in coverage.SCENES.items():
        for name, (program, options) in SCENES[scene][0].bodies.items():
            if name == kind:
                bodies[scene] = (solid(runs, scene, name, options, False) if program == "solid"
                                 else runs.continuum(scene, name, program, options))
    return coverage.table(bodies, runs.open_model)


def picture(found, scene, until):
    """Force over time, one panel per body."""
    figure, panels = plt.subplots(len(found), sharex=True, sharey=True, figsize=(8, 1.25 * len(found) + 0.6))
    for panel, (name, run) in zip(panels if len(found) > 1 else [panels], found.items()):
        force = run["force"][run["force"].t_us <= until]
        force = force.groupby((force.t_us * 240 / until).astype(int)).mean()
        panel.fill_between(force.t_us, 1e-3 * force.force_N, color="0.75" if "shear" in name else "tab:blue", lw=0)
        for contact in joined(run["contacts"], 1.0).itertuples():
            if contact.start_us < until:
                end = until if contact.end_us != contact.end_us else min(contact.end_us, until)
                panel.plot([contact.start_us, end], [0, 0], color="black", lw=2.5,
                           solid_capstyle="butt")
        panel.set_title(name, fontsize=9, loc="right", y=0.68, x=0.99)
        panel.set_ylabel("kN", fontsize=8)
        panel.tick_params(labelsize=8)
    panel.set_xlabel("time, us; black: contact, openings below 1 um closed", fontsize=9)
    figure.tight_layout(h_pad=0.2)
    figure.savefig(HERE / f"{scene}.svg", metadata={"Date": None})
    plt.close(figure)


def compared(table, found):
    return "\n\n".join([alongside(found, table.until, table.opening),
                        totals(found, table.since, table.until, table.opening), counted(found)])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", choices=[*SCENES, []], default=[])
    parser.add_argument("--bin", type=Path, required=True, help="where the programs are")
    parser.add_argument("--solid", nargs="+", choices=[*SCENES, SOFT], default=[], metavar="SCENE")
    parser.add_argument("--checks", action="store_true")
    parser.add_argument("--coverage", action="store_true")
    parser.add_argument("--update", action="store_true")
    asked = parser.parse_args()
    runs = Runs(asked.bin, asked.bin.parent / "continuum")
    if SOFT in asked.solid:
        asked.solid.remove(SOFT)
        store(runs.continuum("published", "3-D, soft", "solid", {"penalty": 0.75, "end": 1e-3}), HERE / "stored" / SOFT)
        asked.checks = True
    texts = {}
    if asked.checks:
        texts["checks"] = checks.table(runs)
    if asked.coverage:
        texts["coverage"] = coverage_table(runs)
    for scene in asked.scenes or asked.solid or ([] if asked.checks or asked.coverage else [*SCENES]):
        parts = []
        for table in SCENES[scene]:
            found = gather(runs, scene, table.bodies, table.beams, scene in asked.solid)
            if not found:
                continue
            if table is SCENES[scene][0]:
                picture(found, scene, min(table.until, 1000))
            parts.append(compared(table, found))
        texts[scene] = "\n\n".join(parts)
    page = HERE / "README.md"
    for name, text in texts.items():
        print(f"\n## {name}\n\n{text}")
        if asked.update:
            before, rest = page.read_text().split(f"<!-- results: {name} -->")
            after = rest.split("<!-- end of results -->", 1)[1]
            page.write_text(f"{before}<!-- results: {name} -->\n\n{text}\n\n<!-- end of results -->{after}")


main()
