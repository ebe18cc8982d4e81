"""Cases that crash, hang or exhaust the memory: each is a row, and the others are run."""

import csv
import os
import signal
import time

import pytest

import subimpact as si
from conftest import tables
from subimpact.sweep import worker

POISON = 17


def outcomes(directory):
    with open(directory / "runs.csv") as file:
        return [row["outcome"] for row in csv.DictReader(file)]


def poisoned(monkeypatch, what):
    """Workers do `what` at one case; they inherit it, being forked."""
    run_case = worker.run_case

    def run(plan, number):
        if number == POISON:
            what()
        return run_case(plan, number)

    monkeypatch.setattr(worker, "run_case", run)


def exhaust():
    held = bytearray(1)
    while True:
        held += bytearray(2**26)


@pytest.mark.parametrize("what, outcome", [
    (lambda: os.kill(os.getpid(), signal.SIGSEGV), "crashed"),
    (lambda: os._exit(7), "crashed"),
    (lambda: signal.pause(), "crashed"),  # deaf to its own clock
], ids=["segfault", "exit", "hang"])
def test_a_case_that_kills_its_worker_is_a_row(population, tmp_path, monkeypatch, what, outcome):
    si.sweep(population, out=tmp_path / "sound", workers=2)
    poisoned(monkeypatch, what)
    monkeypatch.setattr(worker, "_patience", lambda timeout: 1.0)
    si.sweep(population, out=tmp_path / "poisoned", workers=2)
    expected = outcomes(tmp_path / "sound")
    expected[POISON] = outcome
    assert outcomes(tmp_path / "poisoned") == expected
    sound, found = (tables(tmp_path / name)[0].splitlines() for name in ("sound", "poisoned"))
    assert [a for a, b in zip(sound, found) if a != b] == [sound[POISON + 1]]
    monkeypatch.undo()
    si.sweep(population, out=tmp_path / "poisoned", workers=2, retry=True)
    assert tables(tmp_path / "poisoned") == tables(tmp_path / "sound")


def test_a_case_that_exhausts_the_memory_is_a_row(population, tmp_path, monkeypatch):
    run = worker._core.run

    def exhausting(case, *arguments):
        if case.value("striker.mass") == 0.4 and case.value("striker.velocity") == 16.0:
            exhaust()
        return run(case, *arguments)

    monkeypatch.setattr(worker._core, "run", exhausting)
    si.sweep(population, out=tmp_path, workers=2, memory=1.5)
    assert outcomes(tmp_path) == ["completed"] * 38 + ["out_of_memory"] * 2


def test_a_case_that_takes_too_long_is_a_row(population, tmp_path):
    start = time.monotonic()
    si.sweep(population.case, {"time.end": [1e-3, 1000.0, 2e-3]}, out=tmp_path, workers=2, timeout=1.0,
             error_bars="off")
    assert time.monotonic() - start < 20
    assert outcomes(tmp_path) == ["completed", "timed_out", "completed"]
