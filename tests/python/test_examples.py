"""Every example runs and says what it should."""
import pathlib
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(__file__).parents[2] / "apps" / "python" / "examples"
SAYS = {
    "falling_block.py": "the top is 1.0",
    "friction_sweep.py": "35 degrees: 0.00",
    "moments.py": "volume 0.16666666666666666 = 1/6",
    "contact_of_meshes.py": "touching",
    "pull_until_it_slips.py": "0.60 of the weight: slips",
}


def test_all_examples_are_tried():
    assert {path.name for path in FOLDER.glob("*.py")} == set(SAYS)


@pytest.mark.parametrize("name", SAYS)
def test_example(name, tmp_path):
    done = subprocess.run([sys.executable, str(FOLDER / name)], capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    assert SAYS[name] in done.stdout
