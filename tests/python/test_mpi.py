"""Sweeps by MPI, on three ranks."""

import shutil
import subprocess
import sys

import pytest

from conftest import ELASTIC, tables
from test_sweeps import PLAN


@pytest.mark.skipif(shutil.which("mpiexec") is None, reason="no mpiexec")
def test_tables_of_three_ranks_are_the_same(tmp_path):
    (tmp_path / "case.toml").write_text(ELASTIC)
    (tmp_path / "plan.toml").write_text(PLAN)
    command = [sys.executable, "-m", "subimpact.sweep", str(tmp_path / "plan.toml")]
    subprocess.run([*command, "--out", str(tmp_path / "serial"), "--workers", "0"], check=True)
    launch = ["mpiexec", "-n", "3", "--oversubscribe", "--allow-run-as-root"]
    command[1:1] = ["-m", "mpi4py.futures"]
    done = subprocess.run([*launch, *command, "--mpi", "--out", str(tmp_path / "mpi")],
                          capture_output=True, text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    assert "2 of the ranks run cases, and one hands them out" in done.stderr
    assert tables(tmp_path / "mpi") == tables(tmp_path / "serial")
