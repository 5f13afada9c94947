"""Runs of the program on several ranks, and comparisons of their results; for program_test.py."""
import csv
import filecmp
import json
import pathlib
import shlex
import subprocess
import tempfile
import unittest

BAD_INPUT = 2
LONGEST = 240  # s


class Program:
    """Set by program_test.py."""
    mpiexec = ""  # a command with options
    ashlar = ""
    scenes = pathlib.Path()


def command(ranks, *arguments):
    return [*shlex.split(Program.mpiexec), "-n", str(ranks), Program.ashlar, *map(str, arguments)]


def run(ranks, *arguments):
    """Exit status, standard output and errors; without mpiexec for 0 ranks."""
    words = command(ranks, *arguments) if ranks > 0 else [Program.ashlar, *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=LONGEST)
    return done.returncode, done.stdout, done.stderr


def errors_in(text):
    return [line for line in text.splitlines() if "error:" in line]


def table(path):
    with open(path, encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


class RanksTest(unittest.TestCase):
    """Each test has a folder."""

    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.kept.name)

    def tearDown(self):
        self.kept.cleanup()

    def scene(self, name):
        return Program.scenes / f"{name}.toml"

    def expect_same_files(self, one, other):
        names = [str(path.relative_to(one)) for path in [*one.glob("*.csv"), *one.glob("*.pvd"), *one.glob("frames/*")]]
        self.assertIn("history.csv", names)
        for name in names:
            self.assertTrue(filecmp.cmp(one / name, other / name, shallow=False), name)

    def expect_same_motion(self, name, end_time, ranks, states=True):
        """Columns of the history within a millionth of the largest of their measure, of energies within one of the largest
        energy, and 1e-10: the tolerance of the iteration for bricks of a decimetre. Numbers of contact points by state
        jump by one where a force is at its limit to rounding: of a thousand points, one may be in another state.
        @param states false: they are not compared, as upright joints of a wall in equilibrium touch without force"""
        arguments = ["run", self.folder / name if name.endswith(".toml") else self.scene(name), "--set",
                     f"analysis.end_time={end_time}", "--quiet", "--out"]
        straight = self.folder / "1"
        self.assertEqual(run(0, *arguments, straight)[0], 0)
        expected = table(straight / "history.csv")
        kind = {column: column.rsplit(".", 1)[0] for column in expected[0]}
        scale = {}
        for row in expected:
            for column, value in row.items():
                scale[kind[column]] = max(scale.get(kind[column], 0.0), abs(value))
        for count in ranks:
            out = self.folder / str(count)
            status, _, errors = run(count, *arguments, out)
            self.assertEqual(status, 0, errors)
            found = table(out / "history.csv")
            self.assertEqual(len(found), len(expected))
            for column in expected[0]:
                if column.startswith(("iterations", "open_close", "residual")) or (kind[column] == "contacts" and not states):
                    continue
                for a, b in zip(expected, found):
                    allowed = 1e-6 * scale[kind[column]] + 1e-10
                    if kind[column] == "contacts":
                        allowed = 1e-3 * scale[kind[column]]
                    self.assertLessEqual(abs(a[column] - b[column]), allowed, f"{column} on {count} ranks")
            frames = sorted(path.name for path in straight.glob("frames/*"))
            self.assertEqual(sorted(path.name for path in out.glob("frames/*")), frames)

    def assert_same_energies(self, one, other):
        """Energies within a millionth of the largest at any time, on other steps if a run was stopped between them."""
        expected, found = table(one / "history.csv")[-1], table(other / "history.csv")[-1]
        self.assertAlmostEqual(expected["time"], found["time"], 9)
        energies = [column for column in expected if column.startswith("energy.")]
        self.assertTrue(energies, expected.keys())
        largest = max(abs(expected[column]) for column in energies)
        for column in energies:
            self.assertLessEqual(abs(expected[column] - found[column]), 1e-6 * largest, column)

    def write_leaning_wall(self, contact=""):
        scene = self.folder / "leaning.toml"
        scene.write_text('''
analysis = { end_time = 0.05, time_step = 1e-3, gravity = [3, 0, -9.81] }
contact = { friction_angle = 20, CONTACT }
material = [{ name = "brick", density = 2000, young_modulus = 5e7, poisson_ratio = 0.2 }]
block = [{ name = "ground", fixed = true, box = { min = [-1, -1, -0.2], max = [5, 1, 0] } }]
masonry = [{ name = "wall", kind = "wall", material = "brick", length = 2, height = 0.6, brick = [0.5, 0.25, 0.15] }]
measure = [{ name = "storey", drift = { blocks = ["wall.*"], heights = [0.1, 0.5] } },
           { name = "bed", crack = { joints = ["wall.*"] } }]
'''.replace(", CONTACT", f", {contact}" if contact else ""), encoding="utf-8")
        return scene

    def static_end(self, ranks, scene, out, *options):
        """Exit status, summary, last row of the history and messages of a run."""
        status, _, messages = run(ranks, "run", scene, *options, "--out", out)
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        return status, summary, table(out / "history.csv")[-1], messages

    def expect_same_place(self, row, expected, what):
        for column, value in expected.items():
            if column.startswith(("crown.", "pushed.", "storey.")) and column.split(".")[1][0] in "xyzud":
                self.assertLessEqual(abs(row[column] - value), 1e-7, f"{column}: {what}")
