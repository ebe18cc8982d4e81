"""Runs and their results."""

import csv
import math
import os
import pickle
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import subimpact as si

PAPER = Path(__file__).parents[2] / "validation/physics/paper/case.toml"
TABLES = {"sub_impacts": "events.csv", "transitions": "transitions.csv", "supports": "supports.csv", "history": "history.csv",
          "sections": "sections.csv", "points": "points.csv", "shapes": "shapes.csv",
          "envelope": "envelope.csv", "strikes": "strikes.csv"}


def text_of(value, name, digits):
    """A cell as the file has it."""
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        if math.isnan(value):
            return ""
        n = 17 if name == "time_s" else digits
        text = format(value, f".{n}g")
        size = text.lstrip("-")
        return format(value, f".{len(size[2:].lstrip('0')) - 1}e") if size.startswith("0.0") and len(size) > n + 2 else text
    return "" if value == -1 else str(value)


def compare(result, directory):
    for table, file in TABLES.items():
        rows = getattr(result, table)
        if not (directory / file).exists():
            assert len(rows) == 0
            continue
        with open(directory / file) as text:
            heading, *lines = csv.reader(text)
        assert list(rows.dtype.names) == heading
        assert len(rows) == len(lines)
        digits = 9 if table == "shapes" else 17
        for row, line in zip(rows.tolist(), lines):
            assert [text_of(v, n, digits) for v, n in zip(row, heading)] == line


def test_a_doubt_with_a_comma_is_read_whole_from_tables_and_a_beam_that_turns_too_far_has_no_set(tmp_path):
    case = si.Case.from_file(PAPER).changed({"model.segments": 101, "solver.method": "central-difference", "striker.velocity": 120.0,
                                             "time.end": 2e-3, "output.opening": 1e-6})
    result = si.run(case, body_errors=False, out=tmp_path / "out")
    doubts = si.read_results(tmp_path / "out").sub_impacts["doubt"]
    assert doubts.tolist() == result.sub_impacts["doubt"].tolist() and any(", and contacts" in doubt for doubt in doubts)
    assert result.summary["verdict"]["text"].startswith("Not a result: rotations of 2.") and result.summary["next"] == []
    runs = si.sweep(case, {"striker.velocity": [12.0, 120.0]}, error_bars="off", out=tmp_path / "sweep", workers=0).runs
    assert runs["permanent_set_m"].notna().tolist() == [True, False]


@pytest.mark.parametrize("error_bars", [None, "off"])
def test_tables_are_those_of_the_program_bit_for_bit(elastic, error_bars, tmp_path, program):
    elastic.write(tmp_path / "case.toml")
    option = [f"--error-bars={error_bars}"] if error_bars else []
    program("run", tmp_path / "case.toml", "--out", tmp_path / "out", *option)
    result = si.run(elastic, error_bars=error_bars, out=tmp_path / "written")
    compare(result, tmp_path / "out")
    for file in TABLES.values():
        written, out = tmp_path / "written" / file, tmp_path / "out" / file
        assert written.exists() == out.exists()  # strikes.csv: of repeated strikes alone
        if out.exists():
            assert written.read_bytes() == out.read_bytes()
    compare(si.read_results(tmp_path / "out"), tmp_path / "out")


def test_a_yielding_beam_and_a_wish_are_those_of_the_program(yielding, tmp_path, program):
    yielding["accuracy.work_limit"] = 1e7
    del yielding["model.segments"]
    yielding.write(tmp_path / "case.toml")
    program("run", tmp_path / "case.toml", "--out", tmp_path / "out", "--within", "1us")
    result = si.run(yielding, within=1e-6, jobs=2)
    compare(result, tmp_path / "out")
    assert result["accuracy.event_times"] == 1e-6 and "wish" in result.summary


def test_columns_are_views_of_one_read_only_array(elastic):
    result = si.run(elastic)
    assert result.history is result.history
    force = result.history["force_N"]
    assert force.base is result.history
    assert np.shares_memory(force, result.history)
    with pytest.raises(ValueError):
        force[0] = 1.0
    assert result.sub_impacts["index"][0] == 1
    assert set(np.unique(result.transitions["kind"])) >= {"contact_begins", "contact_ends"}


@pytest.mark.parametrize("timeout", [-1, 0, float("nan"), float("inf"), 1e300, "1", True])
def test_a_timeout_that_is_none_is_refused(elastic, timeout):
    with pytest.raises(ValueError, match="timeout is .*; allowed: seconds above 0"):
        si.run(elastic, timeout=timeout)


def test_times_of_a_run_may_have_a_unit(elastic, without_rows):
    result = si.run(elastic, within="1 us", timeout="90 s")
    assert result["accuracy.event_times"] == 1e-6 and not result.timed_out
    assert si.run(without_rows.changed({"time.end": 1000.0}), error_bars="off", timeout="50 ms").timed_out
    with pytest.raises(si.CaseError, match="within is 1; allowed: up to time.end, 0.002 s"):
        si.run(elastic, within=1)


def test_progress_that_cannot_be_called_is_refused(elastic, tmp_path):
    for call in (si.run, si.sensitivity, lambda case, progress: si.sweep(case, out=tmp_path, progress=progress)):
        with pytest.raises(TypeError, match="progress is 5; allowed: a function"):
            call(elastic, progress=5)


def test_a_path_with_nul_is_no_shorter_path(elastic, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for out in ("out\0x", "out\ud800"):
        for call in (lambda: si.run(elastic, out=out), lambda: si.run(elastic).write(out)):
            with pytest.raises(si.OutputError, match=r"out\\x.* is no path"):
                call()
        with pytest.raises(si.ResultsError, match="is no path"):
            si.read_results(out)
        with pytest.raises(si.StoreError, match="is no path"):
            si.sweep(elastic, {"striker.mass": [0.1]}, out=out)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_kind_of_error_bars_and_no_jobs_are_refused(elastic):
    with pytest.raises(ValueError, match="error_bars"):
        si.run(elastic, error_bars="some")
    with pytest.raises(ValueError, match="jobs"):
        si.run(elastic, jobs=0)
    with pytest.raises(si.CaseError, match="event_times"):
        si.run(elastic, error_bars="all", within=1e-6)


def test_files_that_cannot_be_written_or_read_raise(elastic, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(si.OutputError):
        si.run(elastic, out=tmp_path / "file")
    with pytest.raises(si.ResultsError):
        si.read_results(tmp_path / "nothing")


def slow(case):
    """The same for some seconds."""
    return case.changed({"model.segments": 1001, "solver.rtol": 1e-11, "time.end": 1.0})


def test_progress_is_called_and_ends_the_run(elastic):
    times = []

    def progress(t):
        times.append(t)
        return len(times) < 3

    result = si.run(slow(elastic), error_bars="off", progress=progress)
    assert result.outcome == "stopped" and not result.interrupted
    assert len(times) == 3 and times == sorted(times)
    assert 0 < result.time < 1.0 and len(result.history) > 0


def test_an_exception_of_the_callback_leaves_run(elastic):
    with pytest.raises(ZeroDivisionError):
        si.run(slow(elastic), error_bars="off", progress=lambda t: 1 / 0)


def test_a_timeout_returns_what_there_is(elastic):
    start = time.monotonic()
    result = si.run(slow(elastic), error_bars="off", timeout=0.3)
    assert result.timed_out and result.outcome == "stopped"
    assert time.monotonic() - start < 3


def test_ctrl_c_returns_what_there_is(elastic):
    timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    result = si.run(slow(elastic), error_bars="off")
    timer.join()
    assert result.interrupted and result.outcome == "stopped"
    assert 0 < result.time < 1.0 and len(result.sub_impacts) > 0


def test_two_threads_run_at_the_same_time(elastic):
    case = elastic.changed({"model.segments": 501, "time.end": 0.2, "solver.rtol": 1e-10})

    def one():
        return si.run(case, error_bars="off")

    alone, results, ticks = one(), [], 0
    threads = [threading.Thread(target=lambda: results.append(one())) for _ in range(2)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        time.sleep(0.005)
        ticks += 1  # this thread has the GIL meanwhile
    assert ticks > 5
    for result in results:
        assert result.history.tobytes() == alone.history.tobytes()


def test_a_failure_is_a_result(yielding):
    result = si.run(yielding.changed({"solver.step": 3e-6, "study.beyond_critical": True}))
    assert result.outcome in ("unstable", "inaccurate", "left-validity")
    assert result.message and not result.usable


def test_a_result_is_the_same_after_pickling(elastic):
    result = si.run(elastic)
    again = pickle.loads(pickle.dumps(result))
    assert again.summary == result.summary
    for name in TABLES:
        one, other = getattr(result, name), getattr(again, name)
        if name == "shapes":  # whose file has nine digits
            for column in one.dtype.names:
                np.testing.assert_allclose(other[column], one[column], rtol=1e-8)
        else:
            assert other.tobytes() == one.tobytes(), name


def test_gauges_are_columns_of_the_history_after_files_and_pickling_too(elastic, tmp_path):
    case = elastic.changed({"time.end": 1e-4, "output.gauges": [{"position": np.float64(0.5)}, {"position": "0.3 m", "face": "front"}]})
    assert case["output.gauges"] == [{"position": 0.5, "face": "back"}, {"position": 0.3 / 0.7112, "face": "front"}]
    result = case.run(error_bars="off", out=tmp_path)
    assert result["output.gauges"][1] == {"position": 0.3 / case["beam.length"], "face": "front"}
    assert result.history.dtype.names[-2:] == ("gauge_1_strain", "gauge_2_strain") and np.ptp(result.history["gauge_2_strain"]) > 0
    for other in (si.read_results(tmp_path), pickle.loads(pickle.dumps(result))):
        for column in ("time_s", "gauge_1_strain", "gauge_2_strain"):
            np.testing.assert_array_equal(other.history[column], result.history[column])
    assert "gauge_1_strain" not in si.run(elastic.changed({"time.end": 1e-5}), error_bars="off").history.dtype.names
    for gauges, words in (([{"position": 1.2}], "position 1.2"), ([{"position": 0.2, "face": "top"}], 'face "top"')):
        with pytest.raises(si.CaseError, match=words):
            case["output.gauges"] = gauges
    with pytest.raises(si.CaseError, match="up to the beam's"):
        case.changed({"output.gauges": [{"position": "0.9 m"}]}).check()
    with pytest.raises(KeyError, match="result.history"):
        result["gauge_1_strain"]


def test_a_table_becomes_one_of_pandas_by_its_name(elastic):
    pandas = pytest.importorskip("pandas")
    result = si.run(elastic, error_bars="off")
    frame = result.to_pandas("history")
    assert isinstance(frame, pandas.DataFrame)
    assert np.array_equal(frame["force_N"], result.history["force_N"])
    with pytest.raises(ValueError, match="allowed: sub_impacts"):
        result.to_pandas("forces")


def test_notebooks_show_the_keys_of_a_case_with_units_and_the_summary_of_a_result(elastic):
    assert "<td>striker.velocity</td>" in elastic._repr_html_()
    assert "m/s" in elastic._repr_html_()
    assert "sub-impacts" in si.run(elastic)._repr_html_()


def test_materials_are_those_of_the_case_files(elastic):
    steel = si.materials["S355"]
    case = si.Case(beam={"material": "S355", "length": 0.5, "width": 0.02, "thickness": 0.01},
                   striker={"mass": 0.1, "velocity": 1.0, "nose_radius": 0.01}, time={"end": 1e-4})
    for key in ("density", "youngs_modulus", "poisson", "yield_stress"):
        assert case[f"beam.{key}"] == getattr(steel, key)
    assert len(si.materials) == 12
