"""Measured forces: files of instruments, laid beside a run, fitted by a case."""

import json
import re
import time
from dataclasses import replace

import numpy as np
import pytest
from instrument_files import FORCES, PEAK, STEP, TIMES, all_files, rows
from scipy.integrate import solve_ivp

import subimpact as si
from subimpact import measured
from subimpact.measured.__main__ import main

FILES = list(all_files())


@pytest.fixture(scope="module")
def strike():
    from conftest import ELASTIC

    case = si.Case.from_text(ELASTIC).changed({"output.sections": [], "output.points": [], "output.shapes": 0.0,
                                               "output.interval": 5e-7, "time.end": 1.8e-3})
    return si.run(case, error_bars="off", body_errors=False)


def curve(strike):
    return np.array(strike.history["time_s"]), np.array(strike.history["force_N"])


def filtered(strike, cutoff, at):
    """Butterworth's filter of fourth order another way: by its differential equation."""
    times, forces = curve(strike)
    w, a, b = 2 * np.pi * cutoff, np.sqrt(4 + 2 * np.sqrt(2)), 2 + np.sqrt(2)

    def rate(t, y):
        return [w * y[1], w * y[2], w * y[3], w * (np.interp(t, times, forces, left=0) - y[0] - a * y[1] - b * y[2] - a * y[3])]

    return solve_ivp(rate, (0, at[-1]), [0, 0, 0, 0], t_eval=at, max_step=0.05 / w, rtol=1e-9).y[0]


def signal_of(strike, shift=0.0, cutoff=None, interval=1e-6, noise=0.0, factor=1.0, begin=-2e-4, end=1.8e-3, seed=1):
    times, forces = curve(strike)
    t = np.arange(begin, end, interval)
    if cutoff is not None:
        fine = np.unique(np.r_[times, t[t > 0]])
        forces = measured.low_passed(fine, np.interp(fine, times, forces), cutoff)
        times = fine
    clean = np.interp(t, times, forces, left=0.0)
    random = np.random.default_rng(seed).normal(size=len(t))
    return measured.Signal(t + shift, factor * clean + noise * forces.max() * random)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_an_instrument_s_file_is_read_with_its_units_and_sign(file, tmp_path):
    path = tmp_path / file.name
    path.write_bytes(file.content)
    if file.refusal:
        with pytest.raises(si.ResultsError) as refused:
            measured.read(path)
        message = str(refused.value)
        assert message.startswith(str(path)) and file.refusal in message and "\n" not in message
    signal = measured.read(path, **file.options)
    assert len(signal.times) == file.n
    expected = np.interp(signal.times - file.begin, np.array(TIMES) - TIMES[0], FORCES)
    assert np.abs(signal.forces - expected).max() < file.accuracy * PEAK
    assert signal.times[0] == pytest.approx(file.begin, abs=0.1 * STEP)
    assert path.name in repr(signal) and signal.assumed
    force = next(re.search(r"column (\d+)", words)[1] for words in signal.assumed if words.startswith("force"))
    assert measured.read(path, **{**file.options, "columns": force}) == signal


@pytest.mark.parametrize("columns", [2, "2", "Force 1", (1, 2)])
def test_a_named_column_of_forces_leaves_the_times_of_the_file_in_place(columns, tmp_path):
    """Every second sample exported, of a record whose header has the rate of all of them."""
    path = tmp_path / "export.csv"
    path.write_text("Sample rate,50000 Hz\nTime (s),Force 1 (N),Force 2 (N)\n" + "".join(
        f"{t:.6f},{1200 * np.sin(np.pi * t / 8e-4) * (0 < t < 8e-4):.4f},0.0\n" for t in np.arange(-1e-3, 6.97e-3, 4e-5)))
    signal = measured.read(path, columns=columns)
    assert signal.times[0] == -1e-3 and signal.interval == pytest.approx(4e-5)
    assert np.trapz(signal.forces, signal.times) == pytest.approx(1200 * 8e-4 * 2 / np.pi, rel=1e-2)
    assert any("40 us apart" in words and "states 20 us" in words for words in signal.assumed)
    assert measured.read(path, columns=columns, interval="1us").times[0] == 0.0
    path.write_text(path.read_text().replace("50000 Hz", "250 kHz"))  # every tenth
    assert any("40 us apart" in words and "states 4 us" in words for words in measured.read(path, columns=columns).assumed)


def test_the_records_of_a_file_with_segments_are_read_as_the_message_advises(tmp_path):
    path = tmp_path / "segments.csv"
    path.write_text("LECROYWS3024,12345,Waveform\nSegments,2,SegmentSize,400\n#1,13-Mar-2020 14:22:11,0\n#2,13-Mar-2020 14:22:12,1\n"
                    "Time,Ampl\n" + rows(1, 1, time_format="{:.6e}") + rows(1, 0.5, time_format="{:.6e}"))
    with pytest.raises(si.ResultsError) as refused:
        measured.read(path, units="s,N")
    n, skip, columns = re.search(r"rows=(\d+) .* skip=(\d+) .*columns=(\d,\d)", str(refused.value)).groups()
    first = measured.read(path, units="s,N", rows=int(n))
    second = measured.read(path, units="s,N", skip=int(skip), columns=columns, rows=int(n))
    assert len(first) == len(second) == len(TIMES) and np.allclose(second.forces, 0.5 * first.forces, atol=1e-4)


REFUSED = {
    "of two units": ("time [ms],force [N]\ns,N\n" + rows(1e6, 1), "units="),
    "in megaseconds": ("time (MS),force (N)\n" + rows(1e6, 1), "units="),
    "in millionths of a second": ("time x10^-6 s,force [N]\n" + rows(1e6, 1), "units="),
    "of one column with decimal commas": ("rate [kHz];500\nKraft [N]\n" + "12,5\n13,5\n" * 9, "decimal=,"),
    "in kilograms": ("time_us,load_kg\n" + rows(1e6, 1), "units="),
    "of two forces": ("time_us,F1 [N],F2 [N]\n" + rows(1e6, 1, after=",3.0"), "columns="),
    "with commas of two meanings": ("time_us,force_N\n" + rows(1e6, 1, comma=True), "decimal=,"),
    "with marks that part thousands or decimals": ("t [us];F [N]\n" + "".join(f"{i}.000;1.500\n" for i in range(100, 200)), "decimal="),
    "of two records": ("time_us,force_N\n" + rows(1e6, 1) * 2, "rows="),
    "with a broken number": ("time_us,force_N\n" + rows(1e6, 1).replace("-90.0000,0.0", "-90.0000,x0.0"), '"x0.0'),
    "with an interval without unit": ("# dt = 2e-6\nforce_N\n" + "1.0\n" * 9, "interval="),
    "in coulombs at volts": ("time_us,Q [pC]\n# sensitivity: 2 mV/N\n" + rows(1e6, 1), "sensitivity="),
    "of a program": ("PK\3\4\0\0\0\0", "export it as CSV"),
    "with a broken number at once": ("time_us,force_N\n" + rows(1e6, 1).replace("0.0000,0.0", "0.0000,x0.0", 1), '"x0.0'),
    "with a factor beside the unit": ("Time [s] x 1e-3;Force [N] x 1000\n" + rows(1e3, 1e-3, ";"), "units="),
    "with two units in a heading": ("Time [s] (ms);Force [N]\n" + rows(1e3, 1, ";"), "units="),
    "of whole numbers with thousands": ("t [us];F [N]\n" + "".join(f"{i};{900 + i:,d}\n".replace(",", ".") for i in range(300)), "decimal="),
    "whose rate is not that of its times": ("# Sample rate: 500 kHz\nTime (s);Force (N)\n" + rows(1e6, 1, ";"), "units="),
    "with a mark within a number": ("time_us,force_N\n" + rows(1e6, 1).replace("-90.0000,0.0", "-90.0000,12#3"), '"12#3'),
    "with every tenth sample": ("# Sample rate: 1 MHz\n# Decimation: 10\nForce (N)\n" + "1.0\n" * 9, "interval="),
    "divided by a number": ("time_us,force/1000 [N]\n" + rows(1e6, 1e-3), "units="),
    "of times in millionths": ("time x 1e6 (s),force (N)\n" + rows(1e6, 1), "units="),
    "of negative forces by name": ("time_us,-force (N)\n" + rows(1e6, 1), "units="),
    "times a number": ("time_us,Force x 5 [N]\n" + rows(1e6, 1), "units="),
    "times minus one": ("time_us,Force*-1 (N)\n" + rows(1e6, 1), "units="),
    "with a power behind the unit": ("time_us,Force [N] 1e3\n" + rows(1e6, 1), "units="),
    "of logarithms": ("time_us,log force (N)\n" + rows(1e6, 1), "units="),
    "of a pressure alone": ("time [us],p [psi]\n" + rows(1e6, 1), "columns="),
    "of modal analysis without times": ("    -1\n    58\n" + "x\n" * 6 + "         5       400         1  0.0  2.0  0.0\n        18\n        12\n\n\n"
                                        "  0.000e+00" * 4 + "\n    -1\n", "export it as CSV"),
    "of words": ("no numbers at all\n", "no rows of numbers"),
}


@pytest.mark.parametrize("why", REFUSED)
def test_a_file_is_refused_with_what_helps(why, tmp_path):
    text, remedy = REFUSED[why]
    path = tmp_path / "force.csv"
    path.write_text(text)
    with pytest.raises(si.ResultsError, match=re.escape(remedy)) as refused:
        measured.read(path)
    assert "\n" not in str(refused.value)


def test_no_unit_of_a_heading_is_read_as_another(tmp_path):
    times, forces = {"s": 1, "ms": 1e3, "us": 1e6, "µs": 1e6, "ns": 1e9}, {"N": 1, "kN": 1e-3, "MN": 1e-6, "mN": 1e3, "lbf": 1 / 4.4482216152605}
    for heading in ("time [{}],force [{}]", "Log Time [{}],Max 50 force 1/2 12/03/2024 [{}]", "time ({}),Force beam 40x20 ({})",
                    "time ({}),Force/1 - Untitled ({})", "time ({}),/Group/0 Force ({})", "Zeit in {},Kraft in {}", "t/{},F/{}", "time_{},force_{}", '"time ({})","F ({})"', "{},{}"):
        for time_unit, per_second in times.items():
            for force_unit, per_newton in forces.items():
                path = tmp_path / "force.csv"
                path.write_text(heading.format(time_unit, force_unit) + "\n" + rows(per_second, per_newton, time_format="{:.9g}",
                                                                                   force_format="{:.9g}"))
                signal = measured.read(path)
                assert signal.interval == pytest.approx(STEP, rel=1e-6), (heading, time_unit)
                assert signal.forces.max() == pytest.approx(PEAK, rel=1e-6), (heading, force_unit)


def test_a_million_samples_take_seconds(tmp_path):
    path = tmp_path / "long.csv"
    line = "".join(f"{{0}}{i:05d},{i % 97}.25\n" for i in range(100_000))
    path.write_text("time_us,force_N\n" + "".join(line.replace("{0}", str(k + 1)) for k in range(10)))
    begin = time.process_time()
    assert len(measured.read(path).times) == 1_000_000
    assert time.process_time() - begin < 6  # 1.4 s; the bar is 3


def test_the_low_pass_is_the_filter_of_fourth_order_by_its_differential_equation(strike):
    times, forces = curve(strike)
    at = times[:900:7]
    at = np.unique(at)
    got = np.interp(at, times, measured.low_passed(times, forces, 20e3))
    assert np.abs(got - filtered(strike, 20e3, at)).max() < 2e-5 * forces.max()


@pytest.mark.parametrize("how", [
    {"shift": 1.2345678e-3, "cutoff": 20e3, "noise": 0.003},
    {"shift": -4.4421e-4, "cutoff": 20e3, "noise": 0.003, "factor": 1.05, "seed": 2},
    {"shift": 0.7312346, "cutoff": 8e3, "interval": 2e-6, "noise": 0.003, "seed": 3},
    # The record begins within the first contact and ends before the run does.
    {"shift": 3.21e-5, "cutoff": 50e3, "noise": 0.01, "seed": 4, "begin": 5e-5, "end": 1.5e-3},
    # The record is far longer than the run.
    {"shift": 2.00007e-2, "cutoff": 30e3, "noise": 0.01, "seed": 5, "begin": -2e-2},
])
def test_shift_cutoff_and_gain_are_found_within_their_errors(strike, how):
    found = measured.align(strike, signal_of(strike, **how), low_pass="find", gain="find")
    for value, error, true, most in ((found.shift, found.shift_error, how["shift"], 0.5 * how.get("interval", 1e-6)),
                                     (found.low_pass, found.low_pass_error, how["cutoff"], 0.05 * how["cutoff"]),
                                     (found.gain, found.gain_error, how.get("factor", 1.0), 0.005)):
        assert abs(value - true) < error < most
    assert found.correlation > 0.99 and not found.at_bound and not found.doubt


def test_forces_that_are_alike_differ_by_their_gain_alone(strike):
    found = measured.align(strike, signal_of(strike, shift=1e-3, factor=1.25, interval=2.5e-7))
    assert found.shift == pytest.approx(1e-3, abs=1e-8)
    assert found.measured.peak / found.computed.peak == pytest.approx(1.25, rel=1e-4)
    assert found.measured.impulse / found.computed.impulse == pytest.approx(1.25, rel=1e-4)
    assert found.measured.contact == pytest.approx(found.computed.contact, rel=2e-3)
    struck, after = strike.history["v_m_m_per_s"][[0, -1]]
    assert found.computed.impulse == pytest.approx(0.201 * (struck - after), rel=1e-3)
    assert "1.25" not in repr(found) and "-20 %" in repr(found)


def test_a_strain_is_laid_beside_its_gauge_and_fitted(elastic, tmp_path):
    case = elastic.changed({"time.end": 3e-4, "output.sections": [], "output.points": [], "output.shapes": 0.0, "output.interval": 5e-7,
                            "output.gauges": [{"position": 0.5}, {"position": "0.3 m", "face": "front"}]})
    history = si.run(case, error_bars="off", body_errors=False).history
    times, strains = np.array(history["time_s"]), np.array(history["gauge_2_strain"])
    t = np.arange(0, 3e-4, 1e-6)
    sampled = np.interp(t, times, strains)
    path = tmp_path / "strain.csv"
    np.savetxt(path, np.c_[1e3 * (t + 2e-4), 1e6 * sampled], delimiter=";", header="t [ms];gauge [µm/m]", comments="", encoding="utf-8")
    signal = measured.read(path)
    assert signal.quantity == "strain" and np.abs(signal.forces - sampled).max() < 1e-9
    found = measured.align(si.run(case, error_bars="off"), signal, gauge=2)
    assert found.shift == pytest.approx(2e-4, abs=2e-8) and found.correlation > 0.9999
    assert found.measured.peak == pytest.approx(sampled[np.abs(sampled).argmax()], rel=1e-3)
    assert "largest strain" in repr(found) and "um/m" in repr(found) and "impulse" not in repr(found)
    assert found.plot().get_ylabel() == "strain, µm/m"
    with pytest.raises(si.ResultsError, match="output.gauges"):
        measured.align(si.run(case, error_bars="off"), signal, gauge=3)
    fit = measured.fit(case.changed({"striker.velocity": 14.0}), signal, "striker.velocity", gauge=2)
    assert fit.values[0] == pytest.approx(15.9, rel=1e-3)


def test_neighbours_that_resemble_each_other_widen_the_error(strike):
    white = signal_of(strike, noise=0.01)
    noise = np.random.default_rng(1).normal(size=len(white.times) + 24)
    alike = measured.Signal(white.times, signal_of(strike).forces
                            + 0.01 * white.forces.max() * np.convolve(noise, np.ones(25) / 5, "valid"))
    assert measured.align(strike, alike).shift_error > 1.5 * measured.align(strike, white).shift_error


def test_an_option_against_the_file_is_said(tmp_path):
    (tmp_path / "kN.csv").write_text("time_us,force_kN\n" + rows(1e6, 1e-3))
    assert any("the file says kN" in words for words in measured.read(tmp_path / "kN.csv", units="N").assumed)
    (tmp_path / "MSO.csv").write_text("Vertical Units,V\ntime_us,CH1\n" + rows(1e6, 1))
    assert any("the file says V" in words for words in measured.read(tmp_path / "MSO.csv", units="us,N").assumed)
    assert "times 2" in repr(measured.read(tmp_path / "kN.csv", scale=2))
    assert "times 2" in repr(measured.read(tmp_path / "kN.csv", scale="2"))
    (tmp_path / "mV.csv").write_text("# Sensitivity: 2.27 mV/N\ntime_us,U (mV)\n" + rows(1e6, 2.27))
    with pytest.raises(si.ResultsError, match="mass is given"):
        measured.read(tmp_path / "mV.csv", mass=0.2)
    for option in ({"sensitivity": "2 mV/N"}, {"mass": 0.2}, {"mass": "1,000 g"}, {"decimal": ";"}, {"skip": -1}, {"interval": "1,000 us"}):
        with pytest.raises(si.ResultsError, match=next(iter(option))):
            measured.read(tmp_path / "kN.csv", **option)
    (tmp_path / "V.csv").write_text("# Sensitivity: 2.27 mV/N\ntime_us,U (mV)\n" + rows(1e6, 2.27))
    assert any("the file says 2.27 mV/N" in words for words in measured.read(tmp_path / "V.csv", sensitivity="3 mV/N").assumed)


@pytest.mark.parametrize("times, forces, quantity, words", [
    ([0, 1, 2], [0, 1], "force", "as many"), ([0, 2, 1], [0, 1, 0], "force", "increase"), ([0, 1, 2], [0, np.nan, 0], "force", "finite"),
    ([0, 1, 2], [0, 1, 0], "Strain", "allowed"), ([0, 1], [0, 1], "force", "3 or more"),
    ([0, 1, 2], [0, 1e200, 0], "force", "check its unit"), ([0, 1, 2], [0, 1e-200, 0], "strain", "check its unit")])
def test_what_is_no_signal_is_refused(times, forces, quantity, words):
    with pytest.raises(si.ResultsError, match=words):
        measured.Signal(times, forces, quantity=quantity)


def test_a_signal_is_read_from_open_files_and_frames_and_compares(tmp_path):
    import io

    text = "time_us,force_N\n" + rows(1e6, 1)
    signal = measured.read(io.StringIO(text))
    assert signal == measured.read(io.BytesIO(text.encode())) and len(signal) == len(TIMES)
    frame = signal.to_pandas()
    again = measured.read(frame.to_frame())
    assert frame.name == "force_N" and np.allclose(again.times, signal.times, rtol=1e-15) and (again.forces == signal.forces).all()
    assert signal != measured.Signal(signal.times, 2 * signal.forces) and signal.plot().get_xlabel() == "time, µs"


def test_a_record_too_coarse_for_the_run_is_refused(strike, elastic):
    coarse = measured.Signal(1e-3 * np.arange(300), 100.0 * (np.arange(300) % 50))
    for look in (measured.align, lambda run, signal: measured.fit(elastic, signal, "striker.velocity")):
        with pytest.raises(si.ResultsError, match="units="):
            look(strike, coarse)
    with pytest.raises(TypeError, match="Result"):
        measured.align(coarse, strike)


def test_a_fit_tells_what_the_force_does_not_determine(strike, elastic):
    quick = elastic.changed({"time.end": 3e-4, "output.sections": [], "output.points": [], "output.shapes": 0.0})
    signal = signal_of(strike, noise=0.01, end=3e-4)
    for key in ("scene.gravity",):
        with pytest.raises(si.ResultsError, match=f"does not depend on {key}"):
            measured.fit(quick.changed({key: 9.81}), signal, ["striker.velocity", key])
    assert measured.fit(quick.changed({"beam.damping.ratio": 0.0, "solver.method": "erk"}), signal, "beam.damping.ratio").values[0] < 0.1
    bounded = measured.fit(quick.changed({"striker.velocity": 15.0}), signal, "striker.velocity",
                           bounds={"striker.velocity": ("14 m/s", 15.2)})
    assert bounded.at_bound == ("striker.velocity",) and "end of its bounds" in repr(bounded)
    assert measured.align(strike, signal, shift="0 us").shift_error is None


@pytest.mark.parametrize("keys", [("beam.youngs_modulus", "beam.width", "beam.density"),
                                  ("beam.width", "striker.mass", "contact.stiffness", "striker.velocity")])
def test_keys_that_stand_for_one_another_are_named_and_refused(strike, elastic, keys):
    quick = elastic.changed({"time.end": 3e-4, "output.sections": [], "output.points": [], "output.shapes": 0.0})
    with pytest.raises(si.ResultsError, match=f"^{', '.join(keys)} stand for one another"):
        measured.fit(quick, signal_of(strike, noise=0.01, end=3e-4), [*keys, "striker.velocity"][:4])


def test_a_fit_of_noise_alone_is_one_message(strike, elastic):
    noise = measured.Signal(1e-6 * np.arange(40), 3 * np.random.default_rng(10).normal(size=40) + 0.5)
    with pytest.raises(si.ResultsError, match="noise alone"):
        measured.fit(elastic.changed({"output.sections": [], "output.points": [], "output.shapes": 0.0}), noise, "striker.velocity")


@pytest.mark.parametrize("name", ["constant", "step", "spike", "first", "last", "least", "ramp", "zeros"])
def test_strange_signals_are_compared_or_refused_without_a_warning_of_numpy(strike, name):
    """conftest.py makes errors of these."""
    i, spike = np.arange(500), lambda at: (np.arange(500) == at) * 5.0
    forces = {"constant": np.ones(500), "step": (i > 100) * 1.0, "spike": spike(250), "first": spike(0), "last": spike(499),
              "least": 1e-29 * np.sin(0.1 * i) ** 2, "ramp": 1.0 * i, "zeros": np.zeros(500)}[name]
    for options in ({}, {"low_pass": "find", "gain": "find"}, {"gain": "find", "shift": 0.0}, {"low_pass": 1e3}, {"low_pass": 1e9}):
        try:
            assert "nan" not in repr(measured.align(strike, measured.Signal(1e-6 * i, forces), **options))
        except si.ResultsError as error:
            assert "\n" not in str(error)


def test_a_second_hit_in_a_record_is_said(strike):
    one = signal_of(strike, shift=1e-3, noise=0.003)
    later = one.times[-1] + 1e-6 * np.arange(1, 400_000)
    again = measured.Signal(np.r_[one.times, later], np.r_[one.forces, np.interp(later - 0.3, one.times, 0.8 * one.forces)])
    found = measured.align(strike, again)
    assert found.elsewhere == pytest.approx((0.3 + one.times[one.forces.argmax()], 0.8 * one.forces.max()), rel=1e-3)
    assert "another hit" in found.doubt and not measured.align(strike, one).doubt


def test_a_force_in_another_unit_is_doubted(strike):
    signal = signal_of(strike)
    assert measured.align(strike, signal, low_pass="20kHz").low_pass == pytest.approx(20e3)
    assert not measured.align(strike, signal).doubt
    assert "1e-03 times" in measured.align(strike, measured.Signal(signal.times, 1e-3 * signal.forces)).doubt.replace("0.001", "1e-03")
    for low_pass in (-1.0, "20 mm"):
        with pytest.raises(si.ResultsError, match="low_pass"):
            measured.align(strike, signal, low_pass=low_pass)


def test_bounds_of_keys_that_are_not_fitted_are_refused(elastic, strike):
    with pytest.raises(si.CaseError, match="'striker.mas'"):
        measured.fit(elastic, signal_of(strike), "striker.velocity", bounds={"striker.mas": (8, 20)})


def test_what_cannot_be_laid_beside_each_other_is_refused_or_doubted(strike):
    signal = signal_of(strike)
    for wrong, words in ((lambda: measured.align(strike, signal, shift=1.0), "no time in common"),
                         (lambda: measured.align(strike, measured.Signal(signal.times, -signal.forces)), "sign=-1")):
        with pytest.raises(si.ResultsError, match=words):
            wrong()
    hum = measured.Signal(1e-6 * np.arange(2000), 100 * np.sin(0.02 * np.arange(2000)))
    assert "correlation" in measured.align(strike, hum).doubt


def test_a_difference_lies_within_the_total_error_of_the_computed_force_or_not(strike):
    found = measured.align(strike, signal_of(strike, factor=1.01))

    for name, error, size in (("largest force", "total_error", found.computed.peak), ("impulse", "impulse_error", found.computed.impulse)):
        def words(total):
            return next(answer["note"] for answer in replace(found, **{error: total}).answers() if answer["name"] == name)

        assert words(0.1 * size).startswith("within") and words(1e-3 * size).startswith("outside") and "not known" in words(None)
    force = next(answer for answer in strike.answers if answer["key"] == "largest_force")
    assert (found.total_error is None) == (force["error"] is None or force["body_error"] is None)


def test_a_fit_finds_two_keys_and_damping_from_zero(strike, elastic):
    quick = elastic.changed({"time.end": 3e-4, "output.sections": [], "output.points": [], "output.shapes": 0.0})
    signal = signal_of(strike, shift=1e-4, noise=0.01, end=3e-4)
    found = measured.fit(quick.changed({"striker.velocity": 15.0, "contact.stiffness": 6e9}), signal,
                         ["striker.velocity", "contact.stiffness"])
    assert np.all(np.abs(found.values - [15.9, 5e9]) < 4 * found.errors)
    assert np.all(found.errors < 0.02 * found.values)
    assert found.correlation[0, 0] == pytest.approx(1) and abs(found.correlation[0, 1]) < 1
    assert found.case["contact.stiffness"] == found.values[1] and "standard error" in repr(found)
    own = next(answer for answer in si.run(found.case).answers if answer["key"] == "largest_force")
    assert found.alignment.total_error == pytest.approx(np.hypot(own["error"], own["body_error"]), rel=0.01)
    damped = quick.changed({"contact.damping": 0.05, "solver.method": "erk", "output.interval": 1e-6})
    signal = signal_of(si.run(damped, error_bars="off", body_errors=False), noise=0.01, end=3e-4)
    found = measured.fit(damped.changed({"contact.damping": 0.0}), signal, "contact.damping")
    assert abs(found.values[0] - 0.05) < 4 * found.errors[0] < 0.01


@pytest.mark.parametrize("keys, words", [("contact.law", "a fit changes numbers"), ("speed", "no key"), ([], "one key or several"),
                                         ("contact.yield_pressure", "likely one"), (["striker.mass"] * 2, "each once")])
def test_a_fit_of_what_is_no_number_is_refused(elastic, strike, keys, words):
    with pytest.raises(si.CaseError, match=words):
        measured.fit(elastic, signal_of(strike), keys)


def test_the_report_of_the_program_has_what_was_found(strike, tmp_path, program):
    strike.write(tmp_path / "run")
    signal = signal_of(strike, shift=1e-3, factor=1.01)
    np.savetxt(tmp_path / "force.csv", np.c_[1e3 * signal.times, signal.forces], delimiter=",")
    command = ("report", tmp_path / "run", "--measured", tmp_path / "force.csv", "--units", "ms,N")
    done = program(*command)
    assert done.stderr == "" and re.search(r"shift +1000\.0", done.stdout) and "-0.99 %" in done.stdout
    page = json.loads((tmp_path / "run/figures/measured.json").read_text())
    assert [answer["name"] for answer in page["answers"]] == ["shift", "largest force", "impulse", "time in contact"]
    assert page["doubt"] == "" and len(page["overlay"]) == 2
    svg = (tmp_path / "run/figures/measured.svg").read_text()
    assert len(svg) < 60_000 and "time of the run" in svg
    assert "Compared with the measurement" in (tmp_path / "run/report.html").read_text()
    given = program(*command, "--shift", "1.0001ms", "--low-pass", "20kHz", "--gain", "find").stdout
    for words in ("1000.1 us", "as given", "20 kHz", "gain"):
        assert words in given
    program("report", tmp_path / "run")
    assert "Compared with the measurement" not in (tmp_path / "run/report.html").read_text()


@pytest.mark.parametrize("options, words", [(["--shift", "3"], "a time with its unit"), (["--low-pass=-2kHz"], "above 0"),
                                            (["--units", "parsec"], "units"), (["--scale", "0"], "other than 0")])
def test_the_command_refuses_in_one_line(strike, tmp_path, capsys, options, words):
    strike.write(tmp_path / "run")
    (tmp_path / "force.csv").write_text("1,2\n2,3\n3,4\n")
    try:
        status = main([str(tmp_path / "run"), "--measured", str(tmp_path / "force.csv"), *options])
    except SystemExit as stop:
        status = stop.code
    message = capsys.readouterr().err
    assert status == 2 and words in message and message.count("\n") == 1
