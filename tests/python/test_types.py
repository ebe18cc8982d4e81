"""Annotations and stubs, checked by mypy against each other and against the module itself."""

import os
import subprocess
import sys

import subimpact

HERE = os.path.dirname(__file__)
PACKAGE = os.path.dirname(os.path.realpath(subimpact.__file__))


def mypy(*arguments):
    environment = {**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(subimpact.__file__))}
    return subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True,
                          env=environment)


def test_the_package_is_typed_without_gaps(tmp_path):
    done = mypy("mypy", "--config-file", HERE + "/mypy.ini", "--cache-dir", str(tmp_path), PACKAGE)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stubs_are_those_of_the_module():
    done = mypy("mypy.stubtest", "--allowlist", HERE + "/stubtest.allowed", "subimpact._core")
    assert done.returncode == 0, done.stdout + done.stderr
