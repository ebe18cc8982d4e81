"""Annotations and stubs, checked by mypy against each other and against the module itself."""

import os
import subprocess
import sys

import subimpact

HERE = os.path.dirname(__file__)
PACKAGE = os.path.dirname(os.path.realpath(subimpact.__file__))


def mypy(cache, *arguments):
    environment = {**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(subimpact.__file__)),
                   "MYPY_CACHE_DIR": str(cache)}
    return subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True,
                          env=environment)


def test_the_package_is_typed_without_gaps(tmp_path):
    done = mypy(tmp_path, "mypy", "--config-file", HERE + "/mypy.ini", PACKAGE)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stubs_are_those_of_the_module(tmp_path):
    done = mypy(tmp_path, "mypy.stubtest", "--allowlist", HERE + "/stubtest.allowed", "subimpact._core")
    assert done.returncode == 0, done.stdout + done.stderr
