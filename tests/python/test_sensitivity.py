"""Derivatives of event times."""

import csv
import os
import signal
import threading

import numpy as np
import pytest

import subimpact as si

NAN = pytest.approx(np.nan, nan_ok=True)
BY = ["striker.velocity", "beam.thickness"]


@pytest.fixture
def strike(without_rows):
    return without_rows.changed({"time.end": 6e-4})


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


def test_one_key_may_be_a_text_and_none_means_all(strike):
    assert si.sensitivity(strike, "striker.mass").keys == ["striker.mass"]
    everything = si.sensitivity(strike.changed({"time.end": 2.5e-4}))
    assert {"beam.length", "striker.velocity", "contact.stiffness"} <= set(everything.keys)


def test_the_base_run_has_what_scatter_leaves_of_it(strike):
    strike["scatter.striker.velocity"] = 0.01
    base = si.sensitivity(strike, "striker.velocity").base
    assert np.isfinite(base.sub_impacts["end_scatter_s"][0]) and base.n_predictable is not None
    assert si.sensitivity(strike, "striker.mass").base.n_predictable is None


@pytest.mark.parametrize("by, words", [("striker.velocty", "did you mean"),
                                       ("striker.gap", "no logarithm"),
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
