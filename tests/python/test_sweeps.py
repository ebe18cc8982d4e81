"""Sweeps: plans, engines of this machine, tables."""

import csv
import errno
import gc
import os
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import subimpact as si
from conftest import ELASTIC, tables
from subimpact.sweep.store import Store

PLAN = """
case = "case.toml"
error_bars = "off"
samples = 4
seed = 3
[axes]
striker.mass = { from = 0.05, to = 0.4, n = 10, spacing = "log" }
striker.velocity = { from = 1, to = 16, n = 10 }
[scatter]
beam.thickness = 0.01
[set]
time.end = 1e-3
output = { interval = 0, sections = [], points = [], shapes = 0 }
"""


@pytest.fixture
def plan_file(tmp_path):
    (tmp_path / "case.toml").write_text(ELASTIC)
    (tmp_path / "plan.toml").write_text(PLAN)
    return tmp_path / "plan.toml"


def command(*arguments):
    return subprocess.run([sys.executable, "-m", "subimpact.sweep", *map(str, arguments)],
                          capture_output=True, text=True)


def has_rows(store):
    """Whether a sweep that may still be running has stored a row."""
    return store.exists() and store.read_bytes().count(b"\n") > 1


def test_a_plan_expands_the_last_axis_fastest(population):
    assert len(population) == 40
    assert population.keys() == ["striker.mass", "striker.velocity", "beam.thickness"]
    values = [dict(population.settings(number)) for number in range(40)]
    assert [v["striker.mass"] for v in values[:10]] == [0.05] * 10
    assert [v["striker.velocity"] for v in values[:6]] == [1.0, 1.0, 2.0, 2.0, 4.0, 4.0]
    assert values[0]["beam.thickness"] == values[2]["beam.thickness"] != values[1]["beam.thickness"]
    with pytest.raises(IndexError):
        population.settings(40)


def test_samples_have_the_scatter_that_was_asked_for(elastic):
    plan = si.Plan(elastic, scatter={"striker.velocity": 0.01, "beam.thickness": 0.02}, samples=4000)
    values = np.array([[v for _, v in plan.settings(i)] for i in range(len(plan))])
    shifts = np.log(values / [elastic["beam.thickness"], 15.9])  # in the order of names
    assert abs(shifts.mean(axis=0)).max() < 4 * 0.02 / 4000**0.5
    np.testing.assert_allclose(shifts.std(axis=0), [0.02, 0.01], rtol=0.06)
    assert abs(np.corrcoef(shifts.T)[0, 1]) < 0.06
    other = si.Plan(elastic, scatter={"striker.velocity": 0.01}, samples=4000, seed=2)
    assert other.settings(0) != plan.settings(0)


def test_uniform_samples_have_the_same_deviation_and_a_largest_shift(elastic, tmp_path):
    plan = si.Plan(elastic, scatter={"striker.velocity": 0.01}, samples=4000, distribution="uniform")
    shifts = np.log([plan.settings(i)[0][1] / 15.9 for i in range(len(plan))])
    assert shifts.std() == pytest.approx(0.01, rel=0.03)
    assert 0.0172 < abs(shifts).max() <= 0.01 * 3**0.5 and abs(np.percentile(shifts, 25) + 0.01 * 3**0.5 / 2) < 5e-4
    elastic.write(tmp_path / "case.toml")
    (tmp_path / "plan.toml").write_text('case = "case.toml"\nsamples = 4000\ndistribution = "uniform"\n[scatter]\nstriker.velocity = 0.01\n')
    assert si.Plan.from_file(tmp_path / "plan.toml").settings(7) == plan.settings(7)
    with pytest.raises(si.PlanError, match='distribution is \'even\'; allowed: "normal", "uniform"'):
        si.Plan(elastic, scatter={"striker.velocity": 0.01}, samples=2, distribution="even")


def test_values_with_a_unit_are_numbers_of_the_plan(elastic, tmp_path):
    plan = si.Plan(elastic, {"striker.velocity": ["2 m/s", 4.0], ("beam.width", "beam.thickness"): [("20 mm", "8 mm")]})
    assert plan.settings(0) == [("striker.velocity", 2.0), ("beam.width", 0.02), ("beam.thickness", 0.008)]
    elastic.write(tmp_path / "case.toml")
    (tmp_path / "plan.toml").write_text('case = "case.toml"\ntimeout = "90 s"\n[axes]\nstriker.mass = ["100 g"]\n')
    of_file = si.Plan.from_file(tmp_path / "plan.toml")
    assert of_file.settings(0) == [("striker.mass", 0.1)] and of_file.timeout == 90.0


def test_a_sweep_of_nothing_is_refused(elastic, tmp_path):
    for axes in (None, {}):
        with pytest.raises(si.PlanError, match="nothing differs from case to case; give axes"):
            si.sweep(elastic, axes, out=tmp_path / "out")
    assert not (tmp_path / "out").exists()


SCATTER = {"scatter.striker.velocity": 0.01, "scatter.beam.yield_stress": 0.02,
           "scatter.beam.width": 0.0}


def test_samples_are_drawn_from_the_scatter_of_the_case(without_rows, tmp_path):
    """Of numbers that are there; and what is drawn scatters no more."""
    given = si.Plan(without_rows, scatter={"striker.velocity": 0.01}, samples=5)
    of_case = si.Plan(without_rows.changed(SCATTER), samples=5)
    assert [of_case.settings(i) for i in range(5)] == [given.settings(i) for i in range(5)]
    assert of_case.case_of(3) == given.case_of(3)
    si.sweep(given, out=tmp_path / "given", workers=0)
    si.sweep(of_case, out=tmp_path / "of-case", workers=0)
    assert tables(tmp_path / "given") == tables(tmp_path / "of-case")
    by_axis = si.Plan(without_rows.changed(SCATTER), {"beam.yield_stress": [1e8, 2e8]}, samples=5)
    assert by_axis.keys() == ["beam.yield_stress", "striker.velocity"]
    assert by_axis.settings(0)[0][1] != 1e8
    of_plan = si.Plan(without_rows.changed(SCATTER), scatter={"beam.width": 0.01}, samples=5)
    assert of_plan.keys() == ["beam.width"]


def test_without_a_directory_a_sweep_keeps_its_tables_as_long_as_it_lives(without_rows):
    sweep = si.sweep(without_rows.changed({"time.end": 2e-4}), {"striker.velocity": [10.0, 15.9]}, workers=0)
    directory = sweep.directory
    assert list(sweep.runs["striker.velocity"]) == [10.0, 15.9] and len(sweep.sub_impacts) > 0
    assert "nan" not in (directory / "runs.csv").read_text()  # there is no restitution yet
    del sweep
    gc.collect()
    assert not directory.exists()


def test_tables_do_not_depend_on_what_ran_the_cases(population, tmp_path):
    si.sweep(population, out=tmp_path / "serial", workers=0)
    expected = tables(tmp_path / "serial")
    assert expected[0].count(b"\n") == 41
    for workers in (1, 2, 4, 8):
        si.sweep(population, out=tmp_path / str(workers), workers=workers)
        assert tables(tmp_path / str(workers)) == expected
    with ThreadPoolExecutor(2) as executor:
        si.sweep(population, out=tmp_path / "threads", executor=executor)
    assert tables(tmp_path / "threads") == expected


def test_rows_are_those_of_single_runs(population, tmp_path):
    sweep = si.sweep(population, out=tmp_path, workers=2)
    with open(tmp_path / "runs.csv") as file:
        rows = list(csv.DictReader(file))
    with open(tmp_path / "sub_impacts.csv") as file:
        heading, *lines = file.read().splitlines()
    assert heading.startswith("run,index,zone,")
    names = heading.split(",")

    def own(line):  # without the errors of the body, which a sweep leaves out
        return [cell for name, cell in zip(names, line.split(","), strict=True) if "body_error" not in name]

    for number in (0, 17, 39):
        result = si.run(population.case_of(number))
        result.write(tmp_path / "one")
        events = (tmp_path / "one" / "events.csv").read_text().splitlines()[1:]
        assert [own(line) for line in lines if line.startswith(f"{number},")] == [
            own(f"{number},{event}") for event in events]
        row = rows[number]
        assert int(row["run"]) == number
        assert float(row["striker.mass"]) == result["striker.mass"]
        assert row["outcome"] == "completed"
        assert int(row["n_sub_impacts"]) == len(result.sub_impacts)
        assert float(row["max_force_N"]) == result.summary["maxima"]["force_N"]
        assert float(row["first_separation_s"]) == result.sub_impacts["end_s"][0]
    assert len(sweep.runs) == 40 and sweep.n_missing == 0
    base = si.Case.from_file(tmp_path / "base.toml")
    again = si.run(base.changed(dict(population.settings(39))), error_bars="off")
    assert again.sub_impacts["end_s"].tolist() == result.sub_impacts["end_s"].tolist()


def test_hdf5_has_the_numbers_of_the_tables(population, tmp_path):
    h5py = pytest.importorskip("h5py")
    sweep = si.sweep(population, out=tmp_path, workers=0)
    with h5py.File(sweep.write_hdf5()) as file, open(tmp_path / "sub_impacts.csv") as table:
        rows = list(csv.DictReader(table))
        assert [float(row["end_s"] or "nan") for row in rows] == pytest.approx(
            list(file["sub_impacts/end_s"]), rel=0, abs=0, nan_ok=True)
        assert set(file["runs/outcome"].asstr()) == {"completed"}


def test_a_changed_plan_keeps_what_still_fits(population, tmp_path, monkeypatch):
    si.sweep(population, out=tmp_path, workers=0)
    counted = []
    from subimpact.sweep import running

    run_case = running.run_case
    monkeypatch.setattr(running, "run_case", lambda *a: (counted.append(a[1]), run_case(*a))[1])
    axes = {"striker.mass": [0.05, 0.1, 0.2, 0.4, 0.8], "striker.velocity": [2.0, 4.0]}
    wider = si.Plan(population.case, axes, population.scatter, samples=2)
    si.sweep(wider, out=tmp_path, workers=0)
    assert counted == [16, 17, 18, 19]  # those of the new mass
    si.sweep(wider, out=tmp_path / "fresh", workers=0)
    assert tables(tmp_path) == tables(tmp_path / "fresh")


@pytest.mark.parametrize("axis", [{"striker.velocity": [1.0, 2.0, 4.0]}, {"contact.stiffness": [1e9, 2e9, 5e9]}])
def test_a_sweep_goes_on_without_making_its_stored_cases_again(without_rows, tmp_path, monkeypatch, axis):
    """Which takes a coarse run each where the sweep changes what the model is chosen by."""
    before = si.sweep(without_rows, axis, out=tmp_path, workers=0)
    expected = tables(tmp_path)
    with monkeypatch.context() as blind:
        blind.setattr(si.Plan, "case_of", lambda *_: pytest.fail("a stored case was made"))
        assert si.sweep(before.plan, out=tmp_path, workers=0).outcomes == {"completed": 3}
    assert tables(tmp_path) == expected
    key, values = next(iter(axis.items()))
    other = si.sweep(without_rows.changed({key: values[1]}), {"striker.mass": [without_rows["striker.mass"]]}, out=tmp_path, workers=0)
    assert other.outcomes == {"completed": 1}  # found by its identity


def test_warnings_by_kind_and_errors_of_totals_are_columns_of_a_sweep(yielding, tmp_path):
    yielding = yielding.changed({"output.interval": 0.0, "output.sections": []})
    sweep = si.sweep(yielding, {"striker.mass": [0.05, 1.6], "striker.velocity": [2.0, 24.0]}, out=tmp_path, workers=0)
    kinds = sweep.runs["warnings"].fillna("")
    for number in range(4):
        alone = si.run(sweep.plan.case_of(number), body_errors=False)
        assert len(list(filter(None, kinds[number].split(";")))) == len(alone.summary["warnings"])
        for column, total in (("max_force_error_N", "peak_force_N"), ("impulse_error_Ns", "impulse_Ns"), ("restitution_error", "restitution")):
            error = alone.summary["totals"].get(total, {"error": None})["error"]
            assert sweep.runs[column][number] == pytest.approx(np.nan if error is None else error, rel=1e-12, nan_ok=True)
    assert kinds[0] == "" and "rotations" in kinds[3].split(";")


def test_a_sweep_of_which_most_cases_are_refused_says_why_and_fails(plan_file):
    plan_file.write_text(PLAN.replace("[axes]", '[axes]\ncontact.law = ["foundation", "curve", "hertz"]').replace("n = 10", "n = 2"))
    done = command(plan_file, "--out", plan_file.parent / "out")
    assert done.returncode == 3 and "32 refused" in done.stdout
    assert "32 of 48 cases refused, the first of them run 0: " in done.stderr and "contact.stiffness" in done.stderr
    with open(plan_file.parent / "out" / "runs.csv") as file:
        first = next(csv.DictReader(file))
    assert first["message"] in done.stderr and "," in first["message"]


def test_the_command_parts_and_merges(plan_file, tmp_path):
    assert command(plan_file, "--out", tmp_path / "whole").returncode == 0
    for part in ("0:150", "150:300", "300:"):
        assert command(plan_file, "--only", part, "--out", tmp_path / part).returncode == 0
    done = command(plan_file, "--out", tmp_path / "merged", "--merge",
                   *(tmp_path / part for part in ("0:150", "150:300", "300:")))
    assert done.returncode == 0 and "400 cases: 400 completed" in done.stdout
    assert tables(tmp_path / "merged") == tables(tmp_path / "whole")


@pytest.mark.parametrize("options, status, words", [
    (["--workers", -1], 2, "workers is -1"), (["--memory", -1], 2, "memory is -1"),
    (["--memory", 0], 2, "allowed: 0."), (["--memory", 0.0001], 2, "leave it out for no limit"),
    (["--memory", "inf"], 2, "memory is inf"), (["--memory", 1e30], 2, "memory is 1e+30"),
    (["--only", "5"], 2, "0:1000"), (["--only", "5:2"], 2, "0:1000"),
    (["--out", "plan.toml"], 2, "plan.toml: this output directory cannot be made"),
    (["--merge", "nothing"], 2, "nothing: is no directory of a sweep"),
    (["\x1b[31m"], 2, "unrecognized arguments: \\x1b[31m"),
    (["--dask", "tcp://127.0.0.1:1"], 3, "127.0.0.1"),
])
def test_what_cannot_be_done_is_one_message(plan_file, options, status, words, monkeypatch):
    monkeypatch.chdir(plan_file.parent)
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT", "0.5s")
    if "--dask" in options:
        pytest.importorskip("dask.distributed")
    done = command(plan_file, *options)
    assert done.returncode == status, done.stderr
    assert words in done.stderr and "Traceback" not in done.stderr
    assert "\x1b" not in done.stderr


def test_a_full_disk_ends_the_sweep_and_the_next_one_goes_on(population, tmp_path, monkeypatch):
    room = iter(range(1))  # for the beginning of the store

    def fsync(_):
        if next(room, None) is None:
            raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as full:
        full.setattr(os, "fsync", fsync)
        with pytest.raises(si.OutputError, match="make room"):
            si.sweep(population, out=tmp_path / "full", workers=2)
    si.sweep(population, out=tmp_path / "full", workers=0)
    si.sweep(population, out=tmp_path / "whole", workers=0)
    assert tables(tmp_path / "full") == tables(tmp_path / "whole")


def test_two_sweeps_do_not_share_a_directory(population, tmp_path):
    with Store(tmp_path):
        with pytest.raises(si.StoreError, match="is writing into this directory"):
            si.sweep(population, out=tmp_path, workers=0)


def test_a_signal_keeps_the_rows_and_the_same_command_goes_on(plan_file, tmp_path, python):
    number = signal.SIGTERM
    process = python("-m", "subimpact.sweep", plan_file, "--out", tmp_path / "out", "--workers", 2)
    while process.poll() is None and not any(tmp_path.glob("out/sweep.rows")):
        time.sleep(0.01)
    time.sleep(0.3)
    process.send_signal(number)
    output = process.communicate(timeout=60)
    assert process.returncode in (0, 128 + number, -number), output  # the last: after the sweep
    with Store(tmp_path / "out") as store:
        n_rows = len(store.outcomes)
    assert n_rows == 0 or tables(tmp_path / "out")[0].count(b"\n") - 1 == n_rows
    assert process.returncode <= 0 or f"stopped by {number.name}" in output[1]
    assert command(plan_file, "--out", tmp_path / "out").returncode == 0
    command(plan_file, "--out", tmp_path / "whole")
    assert tables(tmp_path / "out") == tables(tmp_path / "whole")


def test_a_signal_to_coordinator_and_workers_ends_a_sweep_of_a_large_plan(plan_file, tmp_path, python):
    """Whose tasks fill the pipe to the workers when these die."""
    text = PLAN.replace("n = 10 }", "n = 5000 }").replace("samples = 4", "samples = 1")
    plan_file.write_text(text)
    process = python("-m", "subimpact.sweep", plan_file, "--out", tmp_path / "out", "--workers", 2,
                     start_new_session=True)
    while process.poll() is None and not has_rows(tmp_path / "out" / "sweep.rows"):
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    output = process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGINT, output
    assert (tmp_path / "out" / "runs.csv").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("workers", [0, 1])
def test_from_python_a_signal_is_a_keyboard_interrupt_after_the_rows_are_kept(
        population, tmp_path, number, workers):
    def stop(n_done, n_all):
        if 0 < n_done < n_all:
            os.kill(os.getpid(), number)

    slow = si.Plan(population.case, population.axes, population.scatter, samples=400)
    before = signal.getsignal(number)
    with pytest.raises(KeyboardInterrupt) as stopped:
        si.sweep(slow, out=tmp_path, workers=workers, progress=stop)
    assert stopped.value.signal == number
    assert signal.getsignal(number) is before
    assert 1 < (tmp_path / "runs.csv").read_bytes().count(b"\n") < len(slow)


def test_a_signal_while_tables_are_written_waits_for_them(population, tmp_path, monkeypatch):
    from subimpact.sweep import tables as module

    write = module._write_rows
    monkeypatch.setattr(module, "_write_rows", lambda *a: (os.kill(os.getpid(), signal.SIGTERM), write(*a))[1])
    with pytest.raises(KeyboardInterrupt) as stopped:
        si.sweep(population, out=tmp_path, workers=0)
    assert stopped.value.signal == signal.SIGTERM
    assert tables(tmp_path)[0].count(b"\n") == 41


def test_a_signal_that_the_process_ignores_ends_no_sweep(population, tmp_path):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        sweep = si.sweep(population, out=tmp_path, workers=1,
                         progress=lambda *_: os.kill(os.getpid(), signal.SIGHUP))
        assert sweep.outcomes == {"completed": 40}
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_cells_hold_no_character_that_breaks_a_table_or_obeys_a_terminal(without_rows, tmp_path):
    """Commas and quotes stay what they are: their cells are quoted."""
    titles = ["a\rb", "a\nb", "\x1b[31m", "\x85", '"q', "a,b", "\0"]
    sweep = si.sweep(without_rows, {"title": titles}, out=tmp_path, workers=0)
    text = (tmp_path / "runs.csv").read_text(encoding="utf-8")
    assert not [c for c in text if c != "\n" and (ord(c) < 32 or 127 <= ord(c) < 160)]
    assert list(sweep.runs["title"]) == ["a b", "a b", "\\x1b[31m", "\\xc2\\x85", '"q', "a,b", "\\x00"]
    assert sweep.outcomes == {"completed": 7}


def test_a_coordinator_killed_at_random_instants_goes_on(plan_file, tmp_path, python):
    """SUBIMPACT_KILLS of them; the bar of the project is 200."""
    command(plan_file, "--out", tmp_path / "whole")
    expected = tables(tmp_path / "whole")
    chance = random.Random(5)
    n_kills = n_whole = 0
    directory = 0
    while n_kills < int(os.environ.get("SUBIMPACT_KILLS", "12")):
        out = tmp_path / str(directory)
        process = python("-m", "subimpact.sweep", plan_file, "--out", out, "--workers", 2,
                         start_new_session=True)
        try:
            process.wait(timeout=chance.uniform(0.05, 2.5))
            assert process.returncode == 0, process.stderr.read()
            assert tables(out) == expected
            n_whole += 1
            directory += 1
        except subprocess.TimeoutExpired:
            process.kill()  # the coordinator alone: its workers have to end by themselves
            process.wait()
            n_kills += 1
        process.stdout.close()
        process.stderr.close()
    out = tmp_path / str(directory)
    assert command(plan_file, "--out", out).returncode == 0
    assert tables(out) == expected
    print(f"{n_kills} kills, {n_whole + 1} sweeps ended")
