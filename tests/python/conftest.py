"""What the tests of the package share."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import subimpact as si

README_STRIKE = (Path(__file__).parents[2] / "README.md").read_text().split("```toml\n")[1].split("```")[0]

PROGRAM = os.environ.get("SUBIMPACT_PROGRAM", "subimpact")

ELASTIC = """
beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, youngs_modulus = 71.96e9 }
striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }
contact = { law = "hertz", stiffness = 5e9 }
model = { mesh = "cells", segments = 51 }
solver = { method = "exponential" }
time = { end = 2e-3 }
output = { interval = 1e-5, sections = [0.5], points = [0.0, 0.5], shapes = 1e-4 }
"""

YIELDING = """
beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, youngs_modulus = 71.96e9, yield_stress = 150e6 }
striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }
model = { segments = 101 }
solver = { method = "central-difference" }
time = { end = 2e-3 }
output = { interval = 1e-5, sections = [0.5] }
"""


def pytest_configure(config):
    config.addinivalue_line("filterwarnings", "error::RuntimeWarning")  # of NumPy, which tell users nothing


@pytest.fixture
def elastic():
    return si.Case.from_text(ELASTIC, "elastic.toml")


@pytest.fixture
def yielding():
    return si.Case.from_text(YIELDING, "yielding.toml")


@pytest.fixture
def program():
    """Runs the program subimpact and returns its output."""

    def run(*arguments, status=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done

    return run


@pytest.fixture
def python():
    """Starts Python with arguments."""

    def start(*arguments, **options):
        return subprocess.Popen([sys.executable, *map(str, arguments)], text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    return start


@pytest.fixture
def without_rows(elastic):
    """The elastic case without history, to 1 ms."""
    return elastic.changed({"output.interval": 0.0, "output.sections": [], "output.points": [],
                            "output.shapes": 0.0, "time.end": 1e-3})


@pytest.fixture
def population(without_rows):
    """Forty quick cases."""
    return si.Plan(
        without_rows,
        {"striker.mass": [0.05, 0.1, 0.2, 0.4], "striker.velocity": [1.0, 2.0, 4.0, 8.0, 16.0]},
        scatter={"beam.thickness": 0.01},
        samples=2,
    )


def tables(directory):
    """The bytes of both tables of a sweep."""
    return [(directory / name).read_bytes() for name in ("runs.csv", "sub_impacts.csv")]
