"""The stubs say what the module has."""
import importlib.util
import os
import subprocess
import sys

import pytest


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not there")
def test_stubs_are_those_of_the_module(tmp_path):
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "ashlar", "--ignore-missing-stub"], cwd=tmp_path,
                          env={**os.environ, "MYPYPATH": os.environ.get("PYTHONPATH", "")}, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stdout + done.stderr
