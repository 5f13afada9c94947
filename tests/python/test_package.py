"""`pip install .` without a network: the source distribution, the wheel, and the installed files."""
import os
import pathlib
import subprocess
import sys
import tarfile
import venv
import zipfile

import pytest

ROOT = pathlib.Path(__file__).parents[2]
BUILD = os.environ.get("ASHLAR_BUILD_DIR")
OFFLINE = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}

pytestmark = pytest.mark.skipif(BUILD is None, reason="ASHLAR_BUILD_DIR names no build")


def run(*command, **more):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **more)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def sdist(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sdist")
    name = run(sys.executable, "-c", "import sys, build_backend; print(build_backend.build_sdist(sys.argv[1]))", folder,
               cwd=ROOT, env={**OFFLINE, "PYTHONPATH": str(ROOT / "apps" / "python")}).split()[-1]
    with tarfile.open(folder / name) as archive:
        archive.extractall(folder)
    return folder / name.removesuffix(".tar.gz")


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder, system_site_packages=True, with_pip=False, symlinks=True)
    return folder / "bin" / "python3"


@pytest.fixture(scope="module")
def wheel(sdist, python, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    run(python, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", folder, sdist, env=OFFLINE)
    (path,) = folder.glob("*.whl")
    return path


def test_the_source_is_complete(sdist, tmp_path):
    for folder in ("geometry", "mechanics", "solver", "apps"):
        sources = {path.relative_to(ROOT) for path in (ROOT / folder).rglob("*.?pp")}
        assert sources == {path.relative_to(sdist) for path in (sdist / folder).rglob("*.?pp")}
    assert "Name: ashlar" in (sdist / "PKG-INFO").read_text()
    run("cmake", "-S", sdist, "-B", tmp_path, "-DASHLAR_BUILD_TESTS=OFF", "-DASHLAR_BUILD_BENCHMARKS=OFF",
        "-DASHLAR_PYTHON=ON")


def test_the_wheel_has_what_the_module_needs(wheel):
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    assert wheel.name.startswith("ashlar-") and f"-{tag}-{tag}-linux" in wheel.name
    names = zipfile.ZipFile(wheel).namelist()
    for name in ("ashlar/__init__.py", "ashlar/__init__.pyi", "ashlar/_history.py", "ashlar/_key_tables.py", "ashlar/_notebook.py", "ashlar/_pictures.py", "ashlar/_toml.py",
                 "ashlar/compas.py", "ashlar/keys.py", "ashlar/py.typed"):
        assert name in names
    assert sum(name.startswith("ashlar/_core.") and name.endswith(".so") for name in names) == 1
    assert any(name.endswith("/LICENSE") for name in names)


def test_it_installs_and_runs(wheel, python, tmp_path):
    run(python, "-m", "pip", "install", "--no-deps", "--ignore-installed", wheel, env=OFFLINE)
    (tmp_path / "tetrahedron.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    clean = {key: value for key, value in OFFLINE.items() if key != "PYTHONPATH"}
    said = run(python, "-c", "import ashlar; print(ashlar.__file__, ashlar.integrate('tetrahedron.off', 0)[0, 0, 0])",
               cwd=tmp_path, env=clean).split()
    assert pathlib.Path(said[0]).is_relative_to(python.parents[1])
    assert float(said[1]) == 1 / 6


def test_a_python_without_numpy_is_named():
    code = "import sys; sys.modules['numpy'] = None; import ashlar"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert told.returncode == 1
    assert f"needs numpy, which this Python has not ({sys.executable})" in told.stderr
