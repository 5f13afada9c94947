"""Build backend for pip and other builders: setuptools, with the extension ashlar._core built by CMake.

The libraries that CMake looks for come from the system (packages.txt). ASHLAR_BUILD_DIR names a build folder whose
module is taken as it is, instead of a new build below build/python.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import setuptools
from setuptools.build_meta import *  # noqa: F403  the hooks of a backend
from setuptools.build_meta import _BuildMetaBackend
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("geometry", "mechanics", "solver", "apps")
FILES = ("CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "packages.txt",
         "pyproject.toml")


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def version():
    return re.search(r"project\(ashlar VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class CMakeBuild(build_ext):
    """Builds the extension by CMake and copies it to where setuptools wants it."""

    def build_extension(self, extension):
        folder = os.environ.get("ASHLAR_BUILD_DIR") or self.built()
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as stage:
            run("cmake", "--install", folder, "--component", "python", "--strip", "--prefix", stage)
            (module,) = pathlib.Path(stage).rglob("_core*.so")
            shutil.copy(module, target)

    def built(self):
        folder = pathlib.Path(self.build_temp) / "cmake"
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        run("cmake", "-S", ROOT, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DASHLAR_BUILD_TESTS=OFF",
            "-DASHLAR_BUILD_BENCHMARKS=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=12",
            "-DASHLAR_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}")
        jobs = subprocess.run(["bash", ROOT / "apps" / "build_jobs.sh"], check=True, capture_output=True, text=True)
        run("cmake", "--build", folder, "--target", "ashlar_python", "--parallel", jobs.stdout.strip())
        return folder


class SourceDistribution(sdist):
    """Sources of the module: the layers below it and its own files."""

    def make_distribution(self):
        found = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))
                 if path.is_file() and "__pycache__" not in path.parts]
        self.filelist.files = [*FILES, *(str(path.relative_to(ROOT)) for path in found)]
        super().make_distribution()


class Backend(_BuildMetaBackend):
    """setuptools' own, which looks for no setup.py."""

    def run_setup(self, setup_script="setup.py"):
        base = pathlib.Path("build") / "python"
        base.mkdir(parents=True, exist_ok=True)
        setuptools.setup(
            version=version(), ext_modules=[setuptools.Extension("ashlar._core", [])],
            cmdclass={"build_ext": CMakeBuild, "sdist": SourceDistribution},
            options={"build": {"build_base": str(base)}, "egg_info": {"egg_base": str(base)}})


_backend = Backend()
get_requires_for_build_wheel = _backend.get_requires_for_build_wheel
get_requires_for_build_sdist = _backend.get_requires_for_build_sdist
prepare_metadata_for_build_wheel = _backend.prepare_metadata_for_build_wheel
build_wheel = _backend.build_wheel
build_sdist = _backend.build_sdist
