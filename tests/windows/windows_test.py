#!/usr/bin/env python3
"""The program for Windows, in Wine, against the program for Linux: see --help.

    python3 tests/windows/windows_test.py build/windows/apps/ashlar.exe build/release/apps/ashlar
    python3 tests/windows/windows_test.py ASHLAR.EXE ASHLAR -k resume        one test
    python3 tests/windows/windows_test.py ASHLAR.EXE ASHLAR --demos wall dome

Exit status 77: there is no Wine. Demos have the same verdicts, and numbers that differ by less than 1e-9 of the size of
the model, or of the largest of their unit (tests/metamorphic/survey.py).
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tests/metamorphic"))
import survey  # noqa: E402

SCENES = PROJECT / "data" / "scenes"
SKIPPED = 77
INTERRUPTED = 130
TOLERANCE = 1e-9
# s; longer cases of `verify` and longer demos are left out.
LONGEST_CASE = 10
LONGEST_DEMO = 120
# Wine and a slow machine.
PATIENCE = 20
# Of clocks, memory, machine and libraries; counts of work depend on rounding.
OWN_KEYS = {"wall_seconds", "peak_memory_bytes", "versions", "counts", "command", "host", "program", "threads", "machine"}

# Sums of rounding errors, and work that depends on them.
OF_ROUNDING = re.compile(r"energy\.(residual|numerical)|open_close")

OPTIONS = argparse.Namespace()


def environment():
    """Wine without its messages, with a folder of its own beside the program, and one set of BLAS kernels."""
    return {"WINEPREFIX": str(OPTIONS.program.parent / "wine"), **os.environ, "WINEDEBUG": "-all",
            "OPENBLAS_CORETYPE": "Haswell"}


def windows(*words, folder, limit=600):
    """Runs the program for Windows; returns (exit status, output, messages)."""
    done = subprocess.run([OPTIONS.wine, str(OPTIONS.program), *map(str, words)], cwd=folder, env=environment(),
                          capture_output=True, timeout=limit, check=False)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8", "replace")


def linux(*words, folder, limit=600):
    """The same for the program for Linux."""
    done = subprocess.run([str(OPTIONS.native), *map(str, words)], cwd=folder, env=environment(), capture_output=True,
                          timeout=limit, check=False)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8", "replace")


def table(path):
    """Columns by name."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def column_difference(one, other):
    """Largest difference, of the largest number; infinite where texts or lengths differ."""
    if len(one) != len(other):
        return math.inf
    numbers = [(number(a), number(b)) for a, b in zip(one, other)]
    if any(a is None or b is None for a, b in numbers):
        return 0.0 if one == other else math.inf
    size = max((abs(a) for a, _ in numbers if math.isfinite(a)), default=0.0)
    return max((abs(a - b) for a, b in numbers), default=0.0) / (size if size > 0.0 else 1.0)


def differences_of_histories(one, other, summary):
    """Differences between two files, in words, by columns of one unit: rounding errors are no part of the largest of them."""
    if not one.exists() and not other.exists():
        return []
    rows, others = (list(csv.DictReader(file.read_text(encoding="utf-8").splitlines())) for file in (one, other))
    if len(rows) != len(others):
        return [f"rows: {len(rows)} and {len(others)}"]
    if rows and rows[0].keys() != others[0].keys():
        return ["columns"]
    return survey.differences_of_rows(rows, others, (0.0, 0.0, 0.0), summary, (TOLERANCE, TOLERANCE), (OF_ROUNDING,))


def verdict(summary):
    """What a run has found, in words."""
    if isinstance(summary, dict):
        return {key: verdict(value) for key, value in summary.items() if key not in OWN_KEYS}
    if isinstance(summary, list):
        return [verdict(value) for value in summary]
    return summary if isinstance(summary, (str, bool)) else None


class Folder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)

    def run_scene(self, *words, status=0, **options):
        found, out, errors = windows("run", *words, folder=self.folder, **options)
        self.assertEqual(found, status, errors)
        return out, errors

    def short_run(self):
        """A scene of some seconds, beside which results are written."""
        shutil.copy(SCENES / "incline.toml", self.folder / "incline.toml")
        return "incline.toml"

    def expect_same(self, one, other, files=("history.csv", "contacts.csv")):
        for name in files:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)


class Program(Folder):
    def test_version_and_help(self):
        status, out, errors = windows("--version", folder=self.folder)
        self.assertEqual((status, errors), (0, ""))
        self.assertIn("ashlar", out)
        self.assertNotIn("\r", out)
        self.assertEqual(windows("--help", folder=self.folder)[1], linux("--help", folder=self.folder)[1])

    def test_refusals(self):
        (self.folder / "bad.toml").write_text("[analysis]\ntype = 3\n", encoding="utf-8")
        self.assertEqual(windows("check", "bad.toml", folder=self.folder), linux("check", "bad.toml", folder=self.folder))
        self.assertEqual(windows("check", "none.toml", folder=self.folder)[0], 2)

    def test_mcp_is_refused(self):
        status, _, errors = windows("mcp", "--folder", ".", folder=self.folder)
        self.assertEqual(status, 1)
        self.assertIn("Windows", errors)

    def test_check_of_all_demos(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.stem):
                status, out, _ = windows("check", scene.name, folder=SCENES)
                self.assertEqual((status, out), linux("check", scene.name, folder=SCENES)[:2])

    def test_integrals_and_contacts(self):
        meshes = [PROJECT / "data" / "meshes" / name for name in ("frame.obj", "stone.off", "l_prism.ply", "cube.stl")]
        for mesh in meshes:
            for words in (("integrate", mesh, "--degree", "4"), ("contacts", mesh, meshes[0])):
                with self.subTest(" ".join(map(str, words))):
                    found = windows(*words, folder=self.folder)
                    self.assertEqual(found[:2], linux(*words, folder=self.folder)[:2])


class Files(Folder):
    def test_blanks_and_other_scripts(self):
        place = self.folder / "zwei Wörter 石 𝄞"
        place.mkdir()
        shutil.copy(SCENES / "incline.toml", place / "плоскость.toml")
        out, errors = self.run_scene(place.relative_to(self.folder) / "плоскость.toml", "--out", "résultats 結果", "--view",
                                     "--set", "analysis.end_time=0.1")
        self.assertTrue((self.folder / "résultats 結果" / "view.html").is_file(), out + errors)
        self.assertIn("résultats 結果", out + errors)

    def test_carriage_returns(self):
        text = (SCENES / "incline.toml").read_text(encoding="utf-8")
        (self.folder / "lf.toml").write_bytes(text.encode())
        (self.folder / "crlf.toml").write_bytes(text.replace("\n", "\r\n").encode())
        for name in ("lf", "crlf"):
            self.run_scene(f"{name}.toml", "--quiet", "--set", "analysis.end_time=0.1")
        self.expect_same(self.folder / "lf.out", self.folder / "crlf.out")
        self.assertNotIn(b"\r", (self.folder / "crlf.out" / "history.csv").read_bytes())

    def test_long_path(self):
        place = self.folder
        while len(str(place)) < 400:
            place /= "a_folder_with_quite_a_long_name"
        place.mkdir(parents=True)
        shutil.copy(SCENES / "incline.toml", place / "incline.toml")
        self.run_scene(place / "incline.toml", "--out", place / "out", "--quiet", "--set", "analysis.end_time=0.1")
        self.assertTrue((place / "out" / "summary.json").is_file())

    def test_one_file_of_frames(self):
        scene = self.short_run()
        words = ["--quiet", "--set", "analysis.end_time=0.1", "--set", "output.format=vtkhdf"]
        self.run_scene(scene, *words, "--out", "öffen")
        self.assertEqual((self.folder / "öffen" / "results.vtkhdf").read_bytes()[:8], b"\x89HDF\r\n\x1a\n")
        status, out, errors = linux("view", "öffen", folder=self.folder)
        self.assertEqual(status, 0, out + errors)

    def test_records_beside_the_scene(self):
        shutil.copy(SCENES / "pulses.csv", self.folder)
        shutil.copy(SCENES / "shaken_tower.toml", self.folder)
        self.assertEqual(windows("check", "shaken_tower.toml", folder=self.folder)[:2],
                         linux("check", "shaken_tower.toml", folder=self.folder)[:2])


class Runs(Folder):
    def start(self, *words):
        process = subprocess.Popen([OPTIONS.wine, str(OPTIONS.program), "run", *words], cwd=self.folder, env=environment(),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, path, process):
        for _ in range(3000):
            if path.exists() and path.stat().st_size > 0:
                return
            self.assertIsNone(process.poll(), "it has ended too early")
            time.sleep(0.02)
        self.fail(f"{path} does not appear")

    def wait_for_rows(self, folder, process):
        """Some steps are written."""
        self.wait_for(self.folder / folder / "checkpoint", process)

    def expect_resumed(self, scene, *words):
        self.run_scene(scene, "--quiet", "--out", "out", "--resume", *words)
        self.run_scene(scene, "--quiet", "--out", "straight", *words)
        self.expect_same(self.folder / "straight", self.folder / "out")

    def test_lock(self):
        scene = self.short_run()
        process = self.start(scene, "--quiet", "--out", "out", "--checkpoint", "0", "--set", "analysis.end_time=20")
        self.wait_for_rows("out", process)
        _, errors = self.run_scene(scene, "--quiet", "--out", "out", "--force", status=2)
        self.assertIn("is in use by process", errors)
        process.kill()
        process.wait()

    def test_kill_and_resume(self):
        scene = self.short_run()
        process = self.start(scene, "--quiet", "--out", "out", "--checkpoint", "0")
        self.wait_for_rows("out", process)
        process.kill()
        process.wait()
        self.expect_resumed(scene)

    def test_interrupt_and_resume(self):
        scene = self.short_run()
        process = self.start(scene, "--quiet", "--out", "out", "--checkpoint", "1000")
        self.wait_for(self.folder / "out" / "history.csv", process)
        process.send_signal(signal.SIGINT)  # Wine makes a Ctrl-C of it
        errors = process.communicate(timeout=100)[1].decode()
        # Wine gives the lowest byte of an exit status.
        self.assertEqual(process.returncode, INTERRUPTED, errors)
        self.assertEqual(json.loads((self.folder / "out" / "summary.json").read_text())["status"], "interrupted")
        self.expect_resumed(scene)

    def test_sweep(self):
        scene = self.short_run()
        words = ("sweep", scene, "--vary", "analysis.end_time=0.05,0.1,0.15", "--out", "table.csv", "--quiet")
        for run, folder in ((windows, "windows"), (linux, "linux")):
            (self.folder / folder).mkdir()
            shutil.copy(self.folder / scene, self.folder / folder / scene)
            status, _, errors = run(*words, folder=self.folder / folder)
            self.assertEqual(status, 0, errors)
        one, other = (table(self.folder / folder / "table.csv") for folder in ("windows", "linux"))
        for name, column in one.items():
            self.assertLess(column_difference(column, other[name]), TOLERANCE, name)


class Answers(Folder):
    def test_verify(self):
        listed = linux("verify", "--list", folder=self.folder)[1]
        for case in (line.split()[0] for line in listed.splitlines() if line.strip()):
            try:
                status = linux("verify", case, folder=self.folder, limit=LONGEST_CASE)[0]
            except subprocess.TimeoutExpired:
                continue
            with self.subTest(case):
                found, out, errors = windows("verify", case, folder=self.folder, limit=PATIENCE * LONGEST_CASE)
                self.assertEqual(found, status, out + errors)

    def test_demos(self):
        for scene in sorted(SCENES.glob("*.toml")):
            if OPTIONS.demos and scene.stem not in OPTIONS.demos:
                continue
            with self.subTest(scene.stem):
                self.compare_demo(scene)

    def compare_demo(self, scene):
        native, other = self.folder / f"{scene.stem}.linux", self.folder / f"{scene.stem}.windows"
        try:
            status = linux("run", scene, "--quiet", "--out", native, folder=self.folder, limit=LONGEST_DEMO)[0]
        except subprocess.TimeoutExpired:
            print(f"{scene.stem}: left out, it takes more than {LONGEST_DEMO} s", flush=True)
            return
        found, _, errors = windows("run", scene, "--quiet", "--out", other, folder=self.folder,
                                   limit=PATIENCE * LONGEST_DEMO)
        self.assertEqual(found, status, errors)
        one, two = (json.loads((folder / "summary.json").read_text(encoding="utf-8")) for folder in (native, other))
        found = differences_of_histories(native / "history.csv", other / "history.csv", one)
        print(f"{scene.stem}: {'; '.join(found) or 'the same'}", flush=True)
        self.assertEqual(verdict(one), verdict(two))
        self.assertEqual(found, [])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="ashlar.exe")
    parser.add_argument("native", type=pathlib.Path, help="ashlar of Linux")
    parser.add_argument("--demos", nargs="+", help="names of demos (default: all)")
    parser.add_argument("-k", dest="tests", action="append", help="tests with this part in their names")
    for name, value in vars(parser.parse_args()).items():
        setattr(OPTIONS, name, value)
    OPTIONS.program, OPTIONS.native = OPTIONS.program.resolve(), OPTIONS.native.resolve()
    OPTIONS.wine = shutil.which("wine64") or shutil.which("wine")
    if OPTIONS.wine is None:
        print("there is no Wine")
        return SKIPPED
    arguments = [sys.argv[0], "-v", *(word for name in OPTIONS.tests or [] for word in ("-k", name))]
    return 0 if unittest.main(argv=arguments, exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
