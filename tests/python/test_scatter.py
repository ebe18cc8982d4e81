"""What scattering numbers leave of a strike."""

import json
from pathlib import Path

import numpy as np
import pytest

import subimpact as si
from subimpact.derivatives import VELOCITY
from subimpact.predictability import N_SAMPLES, Scatter

PAPER = Path(__file__).parents[2] / "validation/physics/paper/case.toml"
BY = ["striker.velocity", "beam.thickness"]


def strike():
    case = si.Case.from_file(PAPER)
    return case.changed({"model.section": "elastic", "solver.method": "exponential", "model.segments": 51, "time.end": 2e-3,
                         "output.interval": 0.0})


@pytest.fixture
def small_strike():
    return strike()


@pytest.fixture(scope="module")
def study():
    return si.sensitivity(strike(), BY, jobs=2)


def test_little_scatter_reaches_far_with_deviations_in_proportion(study):
    once, twice = (Scatter(study, {"striker.velocity": deviation}) for deviation in (1e-9, 2e-9))
    known = np.isfinite(once.table["end_scatter_s"])
    assert once.n_predictable == len(once.table) and not once.reason and known.any()
    np.testing.assert_allclose(twice.table["end_scatter_s"][known], 2 * once.table["end_scatter_s"][known], rtol=1e-12)


def test_the_horizon_comes_sooner_the_more_the_numbers_scatter(study):
    horizons = [Scatter(study, dict.fromkeys(BY, deviation)).horizon for deviation in (1e-6, 1e-3, 1e-2, 0.1, 0.5)]
    assert horizons == sorted(horizons, reverse=True) and horizons[-1] < 1e-3


def test_a_deviation_is_the_root_of_the_sum_of_squares_over_the_keys_that_scatter(study):
    found = Scatter(study, dict.fromkeys(BY, 0.1))
    assert found.deviation(np.array([3.0, -4.0]), np.zeros(2)) == pytest.approx(0.5)
    assert np.isnan(found.deviation(np.array([3.0, np.nan]), np.zeros(2)))
    assert Scatter(study, {BY[0]: 0.1}).deviation(np.array([3.0, np.nan]), np.zeros(2)) == pytest.approx(0.3)


def test_the_impulse_of_a_zone_scatters_as_the_velocity_of_the_striker(study):
    found = Scatter(study, {"beam.thickness": 1e-4})
    last = np.flatnonzero(found.base.sub_impacts["zone"] == 1)[-1]
    deviation = found.deviation(study.derivatives[last, VELOCITY], study.errors[last, VELOCITY])
    assert found.zones[0]["impulse_scatter_Ns"] == pytest.approx(found.base["striker.mass"] * deviation, rel=1e-12)


def test_a_beam_that_yields_has_its_permanent_set_among_the_totals_whatever_the_rows(small_strike):
    case = small_strike.changed({"model.section": "exact", "solver.method": "nystrom", "time.end": 3e-4, "scatter.striker.velocity": 0.01})
    found = si.scatter(case, jobs=2, distribution="uniform")
    total = found.totals["permanent_set_m"]
    assert total.nominal > 1e-4 and 0 < total.standard_deviation < 0.1 * total.mean
    assert "set: " in found.report()


def test_no_deviation_is_more_than_possible(study):
    found = Scatter(study, dict.fromkeys(BY, 0.5))
    assert not (found.table["end_scatter_s"] > 1e-3).any()
    most = found.base["striker.mass"] * found.base["striker.velocity"]
    assert all(not zone["impulse_scatter_Ns"] > most for zone in found.zones)


def test_samples_of_a_linear_contact_scatter_in_force_as_the_velocity_does(small_strike, tmp_path):
    del small_strike["contact.yield_pressure"], small_strike["striker.nose_radius"]
    case = small_strike.changed({"model.mesh": "rigid", "contact.law": "linear", "contact.stiffness": 1e7, "time.end": 1e-3,
                                 "scatter.striker.velocity": 0.02})
    counts = []
    found = si.scatter(case, jobs=2, progress=lambda *n: counts.append(n))
    assert counts[-1] == (N_SAMPLES + 7, N_SAMPLES + 7)
    force, one = found.totals["max_force_N"], case.run(error_bars="off").summary["maxima"]["force_N"]
    # 64 samples leave an eighth of a deviation open in their mean, and 9 % of the deviation itself.
    assert force.nominal == pytest.approx(one, rel=1e-6) and found.n_samples == N_SAMPLES
    assert force.mean == pytest.approx(one, abs=3 * 0.02 * one / 8)
    assert force.standard_deviation == pytest.approx(0.02 * one, rel=0.3)
    assert force.quantile_95 - force.quantile_5 == pytest.approx(2 * 1.645 * 0.02 * one, rel=0.4)
    assert found.totals["restitution"].standard_deviation == pytest.approx(0, abs=1e-6)
    assert "force: " in found.report() and "64 runs" in found.report()
    found.write(tmp_path)
    summary = json.loads((tmp_path / "scatter.json").read_text())
    assert summary["totals"]["max_force_N"]["mean"] == force.mean
    assert (tmp_path / "scatter.csv").read_text().startswith("sub_impact,start_s,start_scatter_s,end_s,end_scatter_s\n1,0,")


def test_samples_have_the_deviations_of_the_derivatives(small_strike):
    case = small_strike.changed({"time.end": 3e-4, "scatter.striker.velocity": 1e-3, "scatter.beam.thickness": 1e-3})
    found = si.scatter(case, jobs=2)
    plan = si.Plan(case.changed({"solver.rtol": 1e-9}), samples=400)
    ends = [plan.case_of(i).run(error_bars="off", body_errors=False).sub_impacts["end_s"][0] for i in range(400)]
    # 400 samples leave 3.5 % of a standard deviation open.
    assert np.std(ends, ddof=1) / found.table["end_scatter_s"][0] == pytest.approx(1, abs=0.1)


def test_a_case_in_which_nothing_scatters_is_refused(small_strike):
    for more in ({}, {"scatter.striker.gap": 0.1, "scatter.beam.length": 0.0}):
        with pytest.raises(si.CaseError, match="nothing scatters"):
            si.scatter(small_strike.changed(more))


def test_a_callback_ends_the_study(small_strike):
    with pytest.raises(KeyboardInterrupt):
        si.scatter(small_strike.changed({"scatter.striker.velocity": 0.01}), progress=lambda n, n_all: n < 3)
