#!/usr/bin/env python3
"""The program for browsers, in node, against the program for Linux: see --help.

    python3 tests/browser/program_test.py build/browser build/release/apps/ashlar
    python3 tests/browser/program_test.py BUILD ASHLAR --demos wall dome

Exit status 77: there is no node. No case of the contact oracle is wrong. Demos have the same verdicts, and numbers that differ by
less than 1e-9 of the size of the model, or of the largest of their unit.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "windows"))
from windows_test import differences_of_histories, verdict  # noqa: E402

SCENES = HERE.parents[1] / "data" / "scenes"
SKIPPED = 77
# s; longer demos are left out.
LONGEST_DEMO = 60
# One thread, on a slow machine.
PATIENCE = 30

OPTIONS = argparse.Namespace()


def in_browser(*words, folder, limit=600):
    """Runs the program for browsers; returns (exit status, output, messages)."""
    done = subprocess.run([*OPTIONS.node, HERE / "program_in_node.js", OPTIONS.build / "apps" / "ashlar.js", *map(str, words)],
                          cwd=folder, capture_output=True, text=True, timeout=limit, check=False)
    return done.returncode, done.stdout, done.stderr


def linux(*words, folder, limit=600):
    """The same for the program for Linux, with one set of BLAS kernels."""
    done = subprocess.run([OPTIONS.native, *map(str, words)], cwd=folder, capture_output=True, text=True, timeout=limit, check=False,
                          env={**os.environ, "OPENBLAS_CORETYPE": "Haswell"})
    return done.returncode, done.stdout, done.stderr


class Folder(unittest.TestCase):
    """A test with a folder of its own, in which the demos are."""

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)
        for path in (*SCENES.glob("*.toml"), *SCENES.glob("*.csv")):
            shutil.copy(path, self.folder)


class Program(Folder):
    def test_version_and_schema(self):
        status, out, errors = in_browser("--version", folder=self.folder)
        self.assertEqual((status, errors), (0, ""))
        self.assertIn("ashlar", out)
        self.assertEqual(in_browser("schema", folder=self.folder), linux("schema", folder=self.folder))

    def test_check_of_all_demos(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene.stem):
                found = in_browser("check", scene.name, "--json", folder=self.folder)
                self.assertEqual(found[:2], linux("check", scene.name, "--json", folder=self.folder)[:2])

    def test_what_a_browser_has_not(self):
        for words, said in ((("mcp", "--folder", "."), "mcp"),
                            (("run", "incline.toml", "--set", "output.format=vtkhdf", "--out", "h5"), "no HDF5")):
            with self.subTest(words[0]):
                status, _, errors = in_browser(*words, folder=self.folder)
                self.assertNotEqual(status, 0)
                self.assertIn(said, errors)


class Answers(Folder):
    def test_contact_oracle(self):
        for name in ("oracle_tests", "oracle_comparison_tests"):
            found = [*OPTIONS.build.glob(f"tests/**/{name}.js")]
            self.assertEqual(len(found), 1, f"{name} is not built")
            start = time.monotonic()
            done = subprocess.run([*OPTIONS.node, found[0], "--gtest_brief=1"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            print(f"{name}: {done.stdout.strip().splitlines()[-1]}, {time.monotonic() - start:.0f} s", flush=True)

    def test_demos(self):
        for scene in sorted(SCENES.glob("*.toml")):
            if OPTIONS.demos and scene.stem not in OPTIONS.demos:
                continue
            with self.subTest(scene.stem):
                self.compare_demo(scene)

    def compare_demo(self, scene):
        native, other = f"{scene.stem}.linux", f"{scene.stem}.browser"
        start = time.monotonic()
        try:
            status = linux("run", scene.name, "--quiet", "--out", native, folder=self.folder, limit=LONGEST_DEMO)[0]
        except subprocess.TimeoutExpired:
            print(f"{scene.stem}: left out, it takes more than {LONGEST_DEMO} s", flush=True)
            return
        middle = time.monotonic()
        found, _, errors = in_browser("run", scene.name, "--quiet", "--out", other, folder=self.folder,
                                      limit=PATIENCE * LONGEST_DEMO)
        self.assertEqual(found, status, errors)
        one, two = (json.loads((self.folder / name / "summary.json").read_text(encoding="utf-8")) for name in (native, other))
        differences = differences_of_histories(self.folder / native / "history.csv", self.folder / other / "history.csv", one)
        print(f"{scene.stem}: {'; '.join(differences) or 'the same'}, {middle - start:.1f} s, here {time.monotonic() - middle:.1f} s",
              flush=True)
        self.assertEqual(verdict(one), verdict(two))
        self.assertEqual(differences, [])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="folder of the build for browsers")
    parser.add_argument("native", type=pathlib.Path, help="ashlar of Linux")
    parser.add_argument("--demos", nargs="+", help="names of demos (default: all)")
    parser.add_argument("-k", dest="tests", action="append", help="tests with this part in their names")
    for name, value in vars(parser.parse_args()).items():
        setattr(OPTIONS, name, value)
    OPTIONS.build, OPTIONS.native = OPTIONS.build.resolve(), OPTIONS.native.resolve()
    if shutil.which("node") is None:
        print("there is no node")
        return SKIPPED
    # Its own fetch would be asked for the program.
    OPTIONS.node = ["node", "--no-experimental-fetch"]
    arguments = [sys.argv[0], "-v", *(word for name in OPTIONS.tests or [] for word in ("-k", name))]
    return 0 if unittest.main(argv=arguments, exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
