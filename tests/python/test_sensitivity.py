"""Derivatives of event times."""

import csv
import math
import os
import signal
import threading
from pathlib import Path

import numpy as np
import pytest

import subimpact as si
from subimpact.derivatives import END, FORCE, QUANTITIES, SHIFTS, START, VELOCITY

NAN = pytest.approx(np.nan, nan_ok=True)
BY = ["striker.velocity", "beam.thickness"]


@pytest.fixture
def strike(without_rows):
    return without_rows.changed({"time.end": 6e-4})


@pytest.fixture
def paper():
    """The published strike on 51 cells, elastic."""
    return si.Case.from_file(Path(__file__).parents[2] / "validation/physics/paper/case.toml").changed({
        "model.section": "elastic", "solver.method": "exponential", "model.segments": 51, "output.interval": 0.0})


@pytest.fixture
def rigid(paper):
    """A striker against a rigid bar, free to move."""
    return paper.changed({"model.mesh": "rigid", "time.end": 5e-3})


def by(study, quantity, key, number=0):
    return study.derivatives[number, quantity, study.keys.index(key)]


def beam_share(case):
    beam = math.prod(case[f"beam.{name}"] for name in ("length", "width", "thickness", "density"))
    return beam / (case["striker.mass"] + beam)


def test_the_table_is_the_file_of_the_program(strike, tmp_path, program):
    strike.write(tmp_path / "case.toml")
    done = program("sensitivity", tmp_path / "case.toml", "--by", ",".join(BY), "--out", tmp_path / "s")
    counts = []
    study = si.sensitivity(strike, BY, jobs=2, progress=lambda *n: counts.append(n))
    study.write(tmp_path / "p")
    text = (tmp_path / "s" / "sensitivity.csv").read_bytes()
    assert (tmp_path / "p" / "sensitivity.csv").read_bytes() == text
    assert study.report() in done.stdout
    heading, *lines = csv.reader(text.decode().splitlines())
    assert list(study.table.dtype.names) == heading
    for row, line in zip(study.table.tolist(), lines, strict=True):
        for value, cell in zip(row, line, strict=True):
            assert value == (type(value)(cell) if cell or isinstance(value, str) else NAN)
    assert counts[-1] == (10, 10)


def test_a_jacobian_is_the_change_of_times(strike):
    study = si.sensitivity(strike, BY)
    ends = si.run(strike.changed({"solver.rtol": 1e-12}), error_bars="off").sub_impacts["end_s"]
    jacobian = study.jacobian("end_s")
    assert study.keys == BY and jacobian.shape == (np.isfinite(ends).sum(), 2)
    with pytest.raises(ValueError, match="quantity is 'max_force_N'; allowed: start_s, end_s, peak_force_N"):
        study.jacobian("max_force_N")
    shift = 1e-4
    for column, key in enumerate(BY):
        changed = {key: strike[key] * np.exp(shift), "solver.rtol": 1e-12}
        moved = si.run(strike.changed(changed), error_bars="off").sub_impacts["end_s"]
        np.testing.assert_allclose((moved - ends)[:2] / shift, jacobian[:2, column], rtol=0.02)


@pytest.mark.parametrize("law, n", [("hertz", 1.5), ("linear", 1.0)])
def test_two_rigid_bodies_under_a_power_law_have_the_derivatives_of_the_closed_form(rigid, law, n):
    """Under F = K lambda^n the contact of the reduced mass m' lasts T ~ (m'/K)^(1/(n+1)) v^((1-n)/(n+1)), with the peak
    F ~ K (m' v^2/K)^(n/(n+1))."""
    del rigid["contact.yield_pressure"], rigid["striker.nose_radius"]
    case = rigid.changed({"contact.law": law, "contact.stiffness": 1e7 if law == "linear" else 5e9, "striker.velocity": 2.0})
    study = si.sensitivity(case)
    assert len(study.values) == 1 and not any(study.flags[0])
    t, peak = study.values[0, END], study.values[0, FORCE]
    share = beam_share(case)  # d ln m'/d ln m
    for quantity, key, expected in (
        (END, "striker.velocity", t * (1 - n) / (n + 1)), (END, "contact.stiffness", -t / (n + 1)),
        (END, "striker.mass", t / (n + 1) * share), (END, "beam.density", t / (n + 1) * (1 - share)),
        (FORCE, "striker.velocity", peak * 2 * n / (n + 1)), (FORCE, "contact.stiffness", peak / (n + 1)),
    ):
        assert by(study, quantity, key) == pytest.approx(expected, abs=1e-6 * (t if quantity == END else peak)), key


def closed_velocity(case, unit_energy, v):
    """The striker's velocity after an elasto-plastic impact at v; x: the largest indentation over that at first yield."""
    share = beam_share(case)
    energy = 0.5 * case["striker.mass"] * share * v * v / unit_energy

    def work(x):
        return 0.4 * (x**2.5 - max(x - 1, 0) ** 2.5)

    low, high = 0.0, 1e3
    for _ in range(200):
        x = 0.5 * (low + high)
        low, high = (x, high) if work(x) < energy else (low, x)
    e = math.sqrt(1 - (low - 1) ** 1.5 / work(low))
    return v * (1 - share - e * share)


@pytest.mark.parametrize("v", [3.0, 15.9])
def test_an_elasto_plastic_impact_has_the_derivative_of_its_restitution(rigid, v):
    case = rigid.changed({"contact.law": "foundation", "striker.velocity": v})
    study = si.sensitivity(case, "striker.velocity")
    used = study.base.summary["used"]
    stiffness = next(value for key, value in used.items() if key.startswith("contact_stiffness"))
    unit = stiffness * used["yield_indentation_m"] ** 2.5
    h = 1e-3

    def f(shift):
        return closed_velocity(case, unit, v * math.exp(shift))

    expected = (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)
    assert by(study, VELOCITY, "striker.velocity") == pytest.approx(expected, abs=1e-6 * v)


@pytest.mark.parametrize("section, method", [("elastic", "exponential"), ("exact", "nystrom")])
def test_the_identities_of_time_mass_and_length_hold(paper, section, method):
    case = paper.changed({"model.section": section, "solver.method": method, "model.segments": 101, "time.end": 1e-3})
    study = si.sensitivity(case, jobs=2)
    assert len(study.keys) == 9 and len(study.values) >= 5
    for quantity in (START, END):
        t = study.values[:, quantity]
        rows = (t > 0) & np.array([not flags[quantity] for flags in study.flags])

        def share(key):
            return study.derivatives[rows, quantity, study.keys.index(key)] / t[rows]

        moduli = share("beam.youngs_modulus") + share("beam.yield_stress")
        defects = (2 * moduli + share("striker.velocity") + 1, share("beam.density") + share("striker.mass") + moduli,
                   share("beam.length") + share("beam.width") + share("beam.thickness") + share("striker.nose_radius")
                   + 3 * share("striker.mass") - 1)
        assert max(np.abs(defect).max() for defect in defects) < 1e-5


def test_a_contact_that_merges_or_appears_within_the_shifts_is_flagged(paper):
    case = paper.changed({"model.section": "elastic", "solver.method": "exponential", "model.segments": 51,
                                 "time.end": 1e-3, "solver.rtol": 1e-13})

    def count(velocity):
        hits = case.changed({"striker.velocity": velocity}).run(error_bars="off", body_errors=False).sub_impacts
        return int((hits["start_s"] < 0.9e-3).sum())

    low = high = 10.0
    while count(high) == count(low):
        low, high = high, high * 1.01
    n = count(low)
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if count(middle) == n else (low, middle)
    for distance in (-5e-6, -5e-7, 5e-7, 5e-6):
        study = si.sensitivity(case.changed({"striker.velocity": low * (1 + distance)}), "striker.velocity")
        assert any(flag for flags in study.flags for flag in flags), distance


def test_a_struck_point_at_the_centre_of_a_cell_has_a_kink(paper):
    case = paper.changed({"model.section": "elastic", "solver.method": "exponential", "model.segments": 101, "time.end": 4e-4})
    at_centre = si.sensitivity(case.changed({"striker.position": 40.5 / 101}), "striker.position")
    assert "kink" in at_centre.flags[0][END]
    assert si.sensitivity(case.changed({"striker.position": 40.75 / 101}), "striker.position").flags[0][END] == ""


def test_central_differences_are_replaced_and_that_is_remarked(strike):
    study = si.sensitivity(strike.changed({"solver.method": "central-difference"}), "striker.mass")
    assert study.base.summary["used"]["method"] == "nystrom"
    assert "by nystrom in place of central-difference" in study.remarks[0]


@pytest.mark.parametrize("by, words", [("striker.velocty", "did you mean"), ("striker.gap", "no logarithm"),
                                       ("solver.method", "solver.method")])
def test_keys_without_a_derivative_are_refused_by_name(strike, by, words):
    with pytest.raises(si.CaseError, match=words) as refused:
        si.sensitivity(strike, by)
    assert refused.value.key == by


def test_a_callback_ends_the_study(strike):
    study = si.sensitivity(strike, BY, progress=lambda n, n_all: n < 7)
    assert study.interrupted and study.keys == BY[:1]


def test_ctrl_c_without_derivatives_raises(strike):
    slow = strike.changed({"model.segments": 1001, "time.end": 10.0})
    timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        si.sensitivity(slow, BY)
    timer.join()


def test_forces_and_springs_are_shifted_together():
    from subimpact.derivatives import shifted

    case = si.Case(beam={"length": 1.0, "width": 0.02, "thickness": 0.01, "density": 7800.0, "youngs_modulus": 2.1e11,
                         "springs": [{"position": 0.5, "stiffness": 4e4}]},
                   striker={"mass": 0.2, "nose_radius": 0.01, "velocity": 1.0}, time={"end": 1e-3})
    assert shifted(case, "beam.springs", SHIFTS[0])["beam.springs"][0]["stiffness"] == 4e4 * math.exp(SHIFTS[0])
    assert len(QUANTITIES) == 6
