#!/usr/bin/env python3
"""Lets the n-th write of a command fail, for all n: what was written is whole, the command says so and fails, and the same
command, or the run when it is resumed, then has the results of one that never failed.

    python3 tests/writing/writing.py ASHLAR FAILING_WRITES_LIBRARY [--cases NAME...] [--step N] [--first N] [--last N]

A case is a command with files of one kind: runs with frames in VTU files and in one VTKHDF file, with checkpoints, trials and
drawings; pages, tables with plots, models, sweeps and new scenes. Each write fails once, and once with all later ones, as on
a full disk. Exit status: 0 no faults, 1 some.
"""
import argparse
import filecmp
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "endurance"))
import kills  # noqa: E402  (comparison of result folders)

DATA = HERE.parents[1] / "data"
JOINTS = HERE.parent / "endurance" / "joints.toml"
STAGES = HERE.parent / "endurance" / "stages.toml"
# In place of an interpreter with matplotlib, which takes a second: the command writes what it draws.
ARTIST = """#!/bin/sh
for file in "$@"; do
  case $file in
    *.svg) echo '<svg xmlns="http://www.w3.org/2000/svg"/>' > "$file" ;;
    *.png) printf '\\211PNG and more' > "$file" ;;
  esac
done
"""
SHORT = ["--set", "analysis.end_time=0.01", "--checkpoint", "0", "--quiet"]
FACTOR = 'analysis={type="factor-of-safety", method="elastic", end_time=0.1, time_step=0.001, safety={tolerance=0.1}}'
NO_SPACE = "No space left on device"
# Words by which a command that goes on without a picture says so.
WITHOUT_PICTURE = "no picture: "


def run_case(scene, *more):
    return [], ["run", str(scene), "--out", "out", *more]


CASES = {
    "run_vtu": run_case(JOINTS, *SHORT, "--set", "output.every=2"),
    "run_vtkhdf": run_case(JOINTS, *SHORT, "--set", "output.every=2", "--set", "output.format=vtkhdf"),
    "run_stages": run_case(STAGES, "--quiet", "--checkpoint", "0"),
    "run_thrust": run_case(DATA / "scenes/arch_stands.toml", "--quiet", "--set", "analysis={type=\"thrust\"}"),
    "run_factor": run_case(DATA / "scenes/incline.toml", "--quiet", "--set", FACTOR),
    "view": ([["run", str(JOINTS), "--out", "r", *SHORT]], ["view", "r", "-o", "page.html"]),
    "spectrum": ([], ["spectrum", str(DATA / "scenes/pulses.csv"), "--time", "t", "--column", "a", "--periods", "5",
                      "-o", "x.csv"]),
    "blocks": ([], ["blocks", str(DATA / "scenes/wedge.toml"), "-o", "model"]),
    "sweep": ([], ["sweep", str(DATA / "scenes/incline.toml"), "--vary", "contact.friction_angle=10,40", "--set",
                   "analysis.end_time=0.01", "-j", "1", "-o", "s.csv", "--picture", "s.svg"]),
    "new": ([], ["new", "wall", "w.toml"]),
    "import": ([], ["import", str(DATA / "meshes/l_prism.ply"), "-o", "i.toml"]),
}


class Fault(Exception):
    """A result or an exit status that must not be."""


class Trial:
    def __init__(self, program, library, folder, name):
        self.program, self.library, self.root, self.name = program, library, folder, name
        self.before, self.command = CASES[name]
        self.artist = folder / "artist"
        self.artist.write_text(ARTIST)
        self.artist.chmod(0o755)
        self.is_run = self.command[0] == "run"
        self.reference = self.prepared("reference")
        status, told = self.start(self.reference, self.command)
        if status != 0:
            raise Fault(f"exit status {status} of {self.command}: {told}")

    def prepared(self, name):
        folder = self.root / name
        shutil.rmtree(folder, ignore_errors=True)
        if self.before and name != "prepared":
            if not (self.root / "prepared").exists():
                self.prepared("prepared")
            return pathlib.Path(shutil.copytree(self.root / "prepared", folder))
        folder.mkdir()
        for command in self.before:
            if self.start(folder, command)[0] != 0:
                raise Fault(f"{command} fails")
        return folder

    def start(self, folder, command, at=0, on=False):
        """Exit status, what the command says, and the calls that failed."""
        log = self.root / "log"
        log.unlink(missing_ok=True)
        variables = {"LD_PRELOAD": self.library, "FAILING_WRITES_FOLDER": f"{folder}/", "FAILING_WRITES_AT": str(at),
                     "FAILING_WRITES_ON": str(int(on)), "FAILING_WRITES_LOG": str(log)} if at else {}
        done = subprocess.run([self.program, *command], cwd=folder, capture_output=True, text=True, check=False, timeout=300,
                              env={**os.environ, "ASHLAR_PYTHON": str(self.artist), **variables})
        self.failed = log.read_text().split() if log.exists() else []
        return done.returncode, done.stdout + done.stderr

    def trial(self, at, on):
        """@return False if the command has fewer writes"""
        folder = self.prepared("trial")
        status, told = self.start(folder, self.command, at, on)
        failed = self.failed
        if not failed:
            if status != 0:
                raise Fault(f"exit status {status} without a failed write: {told}")
            return False
        self.check_end(status, told, failed)
        self.check_whole(folder)
        self.go_on(folder)
        return True

    def check_end(self, status, told, failed):
        if status == 0 and WITHOUT_PICTURE in told:
            return
        if status == 0 and not self.is_lost(failed):
            return
        if status != 1:
            raise Fault(f"exit status {status} after {failed}: {told}")
        # A run of a sweep says so in its log.
        if NO_SPACE not in told and "failed, see " not in told:
            raise Fault(f"no word of the reason after {failed}: {told}")

    def is_lost(self, failed):
        """False if the program may do without what failed: a second name of a file, or space that it reserves."""
        return not set(failed) <= {"link", "copy_file_range", "sendfile"} and not self.same_as_reference(self.root / "trial")

    def check_whole(self, folder):
        for path in folder.rglob("*"):
            if not path.is_file() or path.name.endswith((".tmp", ".log", ".next", ".old")) or "checkpoint" in path.name:
                continue
            if path.suffix in (".pvd", ".svg"):
                xml.etree.ElementTree.parse(path)
            elif path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix == ".csv" and path.stat().st_size > 0 and (self.name != "sweep" or path.parent != folder):
                self.check_table(path)
            elif path.suffix == ".vtkhdf":
                self.check_values(path)
            elif path.suffix in (".vtu", ".toml", ".obj", ".stl", ".msh", ".html", ".py", ".png"):
                other = self.reference / path.relative_to(folder)
                if self.name == "sweep" and path.parent == folder:
                    continue  # they tell of runs that failed
                if not filecmp.cmp(path, other, shallow=False):
                    raise Fault(f"{path.name} is not whole")

    def check_table(self, path):
        text = path.read_text()
        whole = (self.reference / path.relative_to(self.root / "trial")).read_text()
        if not text.endswith("\n") or not whole.startswith(text):
            raise Fault(f"{path.name} is not whole rows of its table")

    @staticmethod
    def check_values(path):
        """Values of frames are numbers, but for fields that a frame lacks."""
        import h5py
        with h5py.File(path) as file:
            for series in file["VTKHDF"].values():
                if not isinstance(series, h5py.Group) or "Steps" not in series:
                    continue
                steps = series["Steps"]
                for k in range(int(steps.attrs["NSteps"])):
                    start = int(steps["PointOffsets"][k])
                    part = int(steps["PartOffsets"][k])
                    points = series["Points"][start:start + int(series["NumberOfPoints"][part])]
                    if not all(math.isfinite(value) for value in points.flat):
                        raise Fault(f"{path.name} has a frame with places that are no numbers")
                if not all(math.isfinite(value) for value in steps["Values"][:]):
                    raise Fault(f"{path.name} has times that are no numbers")

    def go_on(self, folder):
        command = list(self.command)
        if self.is_run:
            out = folder / "out"
            command += kills.goes_on(out) or (["--force"] if out.exists() else [])
        elif command[0] in ("new", "import"):
            command.append("--force")
        elif command[0] == "sweep":
            shutil.rmtree(folder / "s.runs", ignore_errors=True)  # it keeps runs that failed, as told in its table
        status, told = self.start(folder, command)
        if status != 0:
            raise Fault(f"exit status {status} of {command}: {told}")
        if not self.same_as_reference(folder):
            raise Fault(f"{command} has other results: {self.difference}")

    def same_as_reference(self, folder):
        if self.is_run:
            if not (folder / "out/summary.json").exists():
                return False
            self.difference = differences_of_runs(self.reference / "out", folder / "out")
            return not self.difference
        files = {path.relative_to(self.reference) for path in self.reference.rglob("*") if is_result(path)}
        found = {path.relative_to(folder) for path in folder.rglob("*") if is_result(path)}
        self.difference = [str(path) for path in sorted(files ^ found)]
        self.difference += [str(path) for path in sorted(files & found)
                            if not filecmp.cmp(self.reference / path, folder / path, shallow=False)]
        return not self.difference


def differences_of_runs(a, b):
    for name in kills.TABLES:
        if (a / name).exists() != (b / name).exists():
            return [name]
    if all((a / name).exists() for name in kills.TABLES):
        found = kills.differences(a, b)
    else:
        summaries = [kills.told_by(folder / "summary.json") for folder in (a, b)]
        found = [] if summaries[0] == summaries[1] else ["summary.json"]
    return found + [path.name for path in a.glob("*.svg") if not filecmp.cmp(path, b / path.name, shallow=False)]


def is_result(path):
    """False for folders, clocks and what depends on these."""
    return path.is_file() and path.suffix != ".log" and path.name not in ("summary.json", "checkpoint", ".ashlar") \
        and "r/" not in str(path.parent)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("library")
    parser.add_argument("--cases", nargs="*", default=list(CASES), choices=list(CASES))
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--last", type=int, default=10**9)
    parser.add_argument("--step", type=int, default=1)
    arguments = parser.parse_args()
    faults = 0
    for name in arguments.cases:
        with tempfile.TemporaryDirectory() as folder:
            trial = Trial(os.path.abspath(arguments.program), os.path.abspath(arguments.library), pathlib.Path(folder), name)
            count = 0
            at = arguments.first
            while at <= arguments.last:
                there = True
                for on in (False, True):
                    try:
                        there = trial.trial(at, on)
                        count += there
                    except (Fault, ValueError, OSError, xml.etree.ElementTree.ParseError,
                            subprocess.TimeoutExpired) as fault:
                        faults += 1
                        print(f"{name}: write {at}{' and later' if on else ''} ({' '.join(trial.failed[:3])}): {fault}",
                              flush=True)
                if not there:
                    break
                at += arguments.step
            print(f"{name}: {count} failures of writes up to the {at - 1}th", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
