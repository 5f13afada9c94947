"""The stubs say what the module has."""
import importlib.util
import os
import pathlib
import subprocess
import sys

import ashlar
import pytest

# Of the extension: pybind11's metaclass, and constructors that only refuse.
KNOWN = "ashlar.Block\nashlar.Block.__init__\nashlar.Block.__new__\n"


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not there")
def test_stubs_are_those_of_the_module(tmp_path):
    place = str(pathlib.Path(ashlar.__file__).resolve().parents[1])
    (tmp_path / "known.txt").write_text(KNOWN)
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "ashlar", "--ignore-missing-stub", "--allowlist",
                           "known.txt", "--ignore-unused-allowlist"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": place, "MYPYPATH": place},
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
