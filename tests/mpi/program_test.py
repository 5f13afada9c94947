"""Runs of the program on several ranks: messages once, the same results, the end of a rank.

Use: program_test.py MPIEXEC ASHLAR SCENES [TEST...]; MPIEXEC is a command, e.g. "mpiexec --oversubscribe"
"""
import csv
import filecmp
import json
import os
import pathlib
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest

BAD_INPUT = 2
LONGEST = 240  # s


def command(ranks, *arguments):
    return [*shlex.split(MPIEXEC), "-n", str(ranks), ASHLAR, *map(str, arguments)]


def run(ranks, *arguments):
    """Exit status, standard output and errors; without mpiexec for 0 ranks."""
    words = command(ranks, *arguments) if ranks > 0 else [ASHLAR, *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=LONGEST)
    return done.returncode, done.stdout, done.stderr


def errors_in(text):
    return [line for line in text.splitlines() if "error:" in line]


def table(path):
    with open(path, encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


class RanksTest(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.kept.name)

    def tearDown(self):
        self.kept.cleanup()

    def scene(self, name):
        return SCENES / f"{name}.toml"

    def test_bad_input_is_told_once(self):
        scene = self.folder / "bad.toml"
        scene.write_text('[analysis]\nend_time = -1\n')
        status, _, errors = run(3, "run", scene, "--out", self.folder / "out")
        self.assertEqual(status, BAD_INPUT, errors)
        told = errors_in(errors)
        self.assertTrue(any("bad.toml:2" in line for line in told), errors)
        self.assertEqual(len(told), len(set(told)), errors)
        self.assertFalse((self.folder / "out").exists())

    def test_missing_file_is_told_once(self):
        status, _, errors = run(2, "run", self.folder / "none.toml")
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(len(errors_in(errors)), 1, errors)

    def test_other_commands_are_refused_once(self):
        status, out, errors = run(2, "check", self.scene("wall"))
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(out, "")
        self.assertEqual(errors.count("several processes (mpiexec) share runs only"), 1, errors)
        self.assertEqual(run(1, "check", self.scene("wall"))[0], 0)

    def test_wrong_usage_and_help_are_told_once(self):
        status, _, errors = run(2, "run", self.scene("wall"), "--no-such-option")
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(errors.count("--no-such-option"), 1, errors)
        status, out, errors = run(2, "run", "--help")
        self.assertEqual(status, 0, errors)
        self.assertEqual(out.count("Usage: ashlar run"), 1, out)

    def test_what_ranks_cannot_do_is_refused(self):
        status, _, errors = run(2, "run", self.scene("wall"), "--set", "analysis.type=limit", "--out", self.folder / "out")
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(len(errors_in(errors)), 1, errors)
        status, _, errors = run(2, "run", "-", "--out", self.folder / "out")
        self.assertEqual(status, BAD_INPUT, errors)

    def test_folder_in_use_is_told_once(self):
        out = self.folder / "out"
        short = ["run", self.scene("wall"), "--set", "analysis.end_time=0.01", "--out", out, "--quiet"]
        self.assertEqual(run(0, *short)[0], 0)
        status, _, errors = run(2, *short)
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(len(errors_in(errors)), 1, errors)

    def test_one_rank_has_the_bits_of_a_run_without(self):
        short = ["--set", "analysis.end_time=0.2", "--set", "output.every=50", "--quiet", "--out"]
        self.assertEqual(run(0, "run", self.scene("wall"), *short, self.folder / "plain")[0], 0)
        status, _, errors = run(1, "run", self.scene("wall"), *short, self.folder / "ranked")
        self.assertEqual(status, 0, errors)
        self.expect_same_files(self.folder / "plain", self.folder / "ranked")

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

    def test_wall_moves_alike_on_many_ranks(self):
        self.expect_same_motion("wall", 0.1, [2, 4])

    def test_falling_stones_move_alike_on_many_ranks(self):
        self.expect_same_motion("falling_block", 0.2, [2])

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

    def test_drifts_and_cracks_are_those_of_all_blocks(self):
        self.write_leaning_wall()
        self.expect_same_motion("leaning.toml", 0.05, [2, 4])

    def static_end(self, ranks, scene, out, *options):
        """Exit status, summary, last row of the history and messages of a run."""
        status, _, messages = run(ranks, "run", scene, *options, "--out", out)
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        return status, summary, table(out / "history.csv")[-1], messages

    def expect_same_place(self, row, expected, what):
        for column, value in expected.items():
            if column.startswith(("crown.", "pushed.", "storey.")) and column.split(".")[1][0] in "xyzud":
                self.assertLessEqual(abs(row[column] - value), 1e-7, f"{column}: {what}")

    def expect_same_statics(self, scene, ranks, *options):
        """The same exit status, verdict and message, told once; measures within a millionth of a block's size, here of
        a decimetre or more."""
        status, expected, row, messages = self.static_end(0, scene, self.folder / "alone", *options)
        told = "no equilibrium:" if expected["status"] == "moving" else "stands: static equilibrium"
        self.assertEqual(messages.count(told), 1, messages)
        for count in ranks:
            found = self.static_end(count, scene, self.folder / f"of{count}", *options)
            self.assertEqual(found[0], status, found[3])
            self.assertEqual(found[1]["status"], expected["status"])
            self.assertEqual(found[3].count(told), 1, found[3])
            moving = [[block["block"] for block in summary.get("moving", [])] for summary in (found[1], expected)]
            self.assertEqual(*moving)
            if not moving[0]:
                self.expect_same_place(found[2], row, f"{count} ranks")
        return expected

    def write_wall(self, analysis, push, history="", augmented="false"):
        """A wall in bond. A brick of its second course is pushed across with a force, N."""
        scene = self.folder / "wall.toml"
        scene.write_text(f'''
analysis = {{ {analysis} }}
contact = {{ friction_angle = 30, normal_stiffness = 1e9, shear_stiffness = 5e8, augmented = {augmented} }}
material = [{{ name = "brick", density = 2000, young_modulus = 5e9, poisson_ratio = 0.2 }}]
block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -0.2], max = [5, 1, 0] }} }}]
masonry = [{{ name = "wall", kind = "wall", material = "brick", length = 2, height = 0.6, brick = [0.5, 0.25, 0.15] }}]
assign = [{{ blocks = ["wall.7"], load = [{{ plane = {{ point = [0, 0, 0], normal = [0, -1, 0] }}, force = [0, {push}, 0]{history} }}] }}]
measure = [{{ name = "storey", drift = {{ blocks = ["wall.*"], heights = [0.1, 0.5] }} }},
           {{ name = "pushed", block = "wall.7", point = [1, 0.1, 0.225] }}]
''', encoding="utf-8")
        return scene

    def test_an_arch_stands_alike_on_many_ranks(self):
        summary = self.expect_same_statics(self.scene("arch_stands"), [2, 4], "--set", "contact.augmented=false")
        self.assertEqual(summary["status"], "equilibrium")

    def test_a_pushed_wall_has_the_same_verdict_on_many_ranks(self):
        for push, status, augmented in ((100, "equilibrium", "false"), (100, "equilibrium", "true"), (3000, "moving", "true")):
            scene = self.write_wall('type = "static"', push, augmented=augmented)
            summary = self.expect_same_statics(scene, [2, 4], "--force")
            self.assertEqual(summary["status"], status)

    def test_unsupported_blocks_are_told_once(self):
        scene = self.folder / "flying.toml"
        scene.write_text('''
analysis = { type = "static" }
contact = { augmented = false }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
block = [{ name = "ground", fixed = true, box = { min = [-1, -1, -1], max = [2, 2, 0] } },
         { name = "low", material = "stone", box = { min = [0, 0, 0], max = [1, 1, 1] } },
         { name = "left", material = "stone", box = { min = [0, 0, 3], max = [1, 1, 4] } },
         { name = "right", material = "stone", box = { min = [1, 0, 3], max = [2, 1, 4] } }]
''', encoding="utf-8")
        for count in (1, 2, 3):
            status, _, errors = run(count, "run", scene, "--out", self.folder / "out")
            self.assertEqual(status, BAD_INPUT, errors)
            self.assertEqual(len(errors_in(errors)), 1, errors)
            self.assertIn("block left and 1 more touch each other without a support", errors)

    def test_motion_starts_from_statics_on_many_ranks(self):
        self.write_wall('end_time = 0.05, time_step = 1e-3, initial_state = "static"', 100)
        self.expect_same_motion("wall.toml", 0.05, [2, 4], states=False)

    def test_static_analyses_go_on_from_their_checkpoint(self):
        scene = self.write_wall('type = "static", end_time = 1, time_step = 0.25', 400, ", history = [[0, 0], [1, 1]]")
        out, straight = self.folder / "out", self.folder / "straight"
        self.assertEqual(run(2, "run", scene, "--quiet", "--set", "analysis.end_time=0.5", "--out", out)[0], 0)
        status, _, errors = run(3, "run", scene, "--quiet", "--resume", "--out", out)
        self.assertEqual(status, 0, errors)
        self.assertEqual(run(0, "run", scene, "--quiet", "--out", straight)[0], 0)
        last, expected = table(out / "history.csv")[-1], table(straight / "history.csv")[-1]
        self.assertEqual(last["time"], 1.0)
        self.expect_same_place(last, expected, "resumed")

    def test_multipliers_hold_alike_on_many_ranks(self):
        self.write_leaning_wall("augmented = true")
        self.expect_same_motion("leaning.toml", 0.05, [2, 4])

    def test_blocks_with_multipliers_are_resumed_on_other_ranks(self):
        scene = self.write_leaning_wall("augmented = true")
        run_to = lambda end: ["run", scene, "--set", f"analysis.end_time={end}", "--quiet", "--out"]
        self.assertEqual(run(0, *run_to(0.05), self.folder / "straight")[0], 0)
        out = self.folder / "resumed"
        for count, end in ((2, 0.02), (3, 0.03), (0, 0.04), (2, 0.05)):
            resume = ["--resume"] if end > 0.02 else ["--checkpoint", "0"]
            status, _, errors = run(count, *run_to(end), out, *resume)
            self.assertEqual(status, 0, errors)
        self.assert_same_energies(self.folder / "straight", out)

    def test_tied_blocks_rebound_alike_on_many_ranks(self):
        (self.folder / "falling.toml").write_text('''
analysis = { end_time = 0.25, time_step = 1e-3 }
contact = { friction_angle = 30, restitution = 0.4 }
material = [{ name = "stone", density = 2500, young_modulus = 5e9, poisson_ratio = 0.2 }]
block = [
  { name = "ground", fixed = true, box = { min = [-2, -2, -0.2], max = [5, 2, 0] } },
  { name = "a", material = "stone", box = { min = [0, 0, 0.1], max = [1, 0.5, 0.6] } },
  { name = "b", material = "stone", box = { min = [1, 0, 0.1], max = [2, 0.5, 0.6] } },
  { name = "c", material = "stone", box = { min = [2, 0, 0.1], max = [3, 0.5, 0.6] } },
  { name = "d", material = "stone", box = { min = [0.4, 0.1, 0.75], max = [0.9, 0.4, 1.1] } },
  { name = "e", material = "stone", box = { min = [2.2, 0.1, 0.7], max = [2.7, 0.4, 1.1] } },
]
joint = [{ blocks = ["a", "b"], tied = true }, { blocks = ["b", "c"], tied = true }]
''', encoding="utf-8")
        self.expect_same_motion("falling.toml", 0.25, [2, 3])

    def test_initial_stress_is_the_same_on_many_ranks(self):
        """A column of stones that a pillar stands beside, both under the stress of the ground as it was."""
        stones = ", ".join(f'{{ name = "s{k}", material = "rock", box = {{ min = [0, 0, {0.5 * k}], max = [1, 1, {0.5 * k + 0.5}] }} }}'
                           for k in range(6))
        (self.folder / "stressed.toml").write_text(f'''
analysis = {{ end_time = 0.03, time_step = 1e-3 }}
contact = {{ friction_angle = 30 }}
initial_stress = {{ unit_weight = 25000, k0 = 0.5, surface = 3 }}
material = [{{ name = "rock", density = 2500, young_modulus = 1e9, poisson_ratio = 0.25 }}]
measure = [{{ name = "top", block = "s5", point = [0.5, 0.5, 3] }}]
block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -1], max = [4, 2, 0] }} }},
  {{ name = "pillar", material = "rock", box = {{ min = [1, 0, 0], max = [2, 1, 3] }} }}, {stones}]
''', encoding="utf-8")
        self.expect_same_motion("stressed.toml", 0.03, [3])

    def write_stages(self):
        """A wall that loses a brick of its lowest course, and then gets a block on top that is pushed across."""
        scene = self.folder / "stages.toml"
        scene.write_text('''
analysis = { end_time = 0.02, time_step = 1e-3, initial_state = "static" }
contact = { friction_angle = 30, normal_stiffness = 1e9, shear_stiffness = 5e8, augmented = false }
material = [{ name = "brick", density = 2000, young_modulus = 5e9, poisson_ratio = 0.2 }]
block = [{ name = "ground", fixed = true, box = { min = [-1, -1, -0.2], max = [5, 1, 0] } },
         { name = "late", material = "brick", order = 2, box = { min = [0.6, 0, 0.65], max = [1.1, 0.2, 0.85] } }]
masonry = [{ name = "wall", kind = "wall", material = "brick", length = 2, height = 0.6, brick = [0.5, 0.25, 0.15] }]
measure = [{ name = "storey", drift = { blocks = ["wall.*"], heights = [0.1, 0.5] } }, { name = "crown", block = "wall.16", point = [1, 0.1, 0.6] }]
output = { every = 20 }
[[stage]]
name = "standing"
[[stage]]
name = "undermined"
remove = ["wall.2"]
reset_displacement = true
[[stage]]
name = "loaded"
add = ["late"]
load = [{ blocks = ["late"], point = [0.8, 0, 0.8], force = [0, 100, 0], history = [[0, 0], [0.01, 1]] }]
fix = [{ blocks = ["wall.16"], point = [1, 0.1, 0.5], components = ["x"] }]
joint = [{ blocks = ["wall.*", "wall.*"], friction_angle = 25, normal_stiffness = 1e9 }]
''', encoding="utf-8")
        return scene

    def test_stages_move_alike_on_many_ranks(self):
        self.write_stages()
        self.expect_same_motion("stages.toml", 0.02, [4], states=False)
        expected, found = (json.loads((self.folder / out / "summary.json").read_text()) for out in ("1", "4"))
        self.assertEqual(found["stages"], expected["stages"])
        self.assertEqual([stage["name"] for stage in found["stages"]], ["standing", "undermined", "loaded"])

    def test_a_stage_is_resumed_on_other_ranks(self):
        scene = self.write_stages()
        run_to = lambda end: ["run", scene, "--set", f"stage.2.analysis.end_time={end}", "--quiet", "--out"]
        self.assertEqual(run(0, *run_to(0.02), self.folder / "straight")[0], 0)
        out = self.folder / "resumed"
        for count, end in ((2, 0.01), (3, 0.02)):
            status, _, errors = run(count, *run_to(end), out, *(["--resume"] if end > 0.01 else []))
            self.assertEqual(status, 0, errors)
        self.assert_same_energies(self.folder / "straight", out)

    def test_static_stages_end_alike_on_many_ranks(self):
        """Equilibrium, an excavation that sets blocks in motion, a push."""
        scene = pathlib.Path(__file__).parent.parent / "endurance" / "stages.toml"
        _, expected, row, _ = self.static_end(0, scene, self.folder / "alone")
        status, summary, last, messages = self.static_end(3, scene, self.folder / "shared")
        self.assertEqual(status, 0, messages)
        self.assertEqual(messages.count("stage placed: equilibrium"), 1, messages)
        for found, stage in zip(summary["stages"], expected["stages"]):
            self.assertEqual((found["name"], found["status"], found["time"]), (stage["name"], stage["status"], stage["time"]))
        for column in row:
            if column.startswith("energy."):
                self.assertLessEqual(abs(last[column] - row[column]), 1e-6 * abs(row["energy.kinetic"]), column)

    def test_a_stage_that_cannot_begin_is_told_once(self):
        """Stones fall to where others are added, the third one deepest."""
        box = lambda k, low: f"box = {{ min = [{2 * k}, 0, {low}], max = [{2 * k + 1}, 1, {low + 1}] }}"
        stones = ", ".join(f'{{ name = "stone{k}", material = "stone", {box(k, 2)}, velocity = [0, 0, {-1.52 if k == 2 else -1.5}] }}, '
                           f'{{ name = "late{k}", material = "stone", {box(k, 0)} }}' for k in range(4))
        scene = self.folder / "late.toml"
        scene.write_text(f'''
analysis = {{ end_time = 1, time_step = 0.05, gravity = [0, 0, 0] }}
contact = {{ friction_angle = 30, augmented = false }}
material = [{{ name = "stone", density = 2700, young_modulus = 1e10, poisson_ratio = 0.2 }}]
block = [{stones}]
[[stage]]
name = "falling"
[[stage]]
name = "added"
add = ["late*"]
''', encoding="utf-8")
        told = []
        for count in (0, 3):
            status, _, errors = run(count, "run", scene, "--quiet", "--out", self.folder / str(count))
            self.assertEqual(status, 1, errors)
            told.append([line.split(";")[0] for line in errors.splitlines() if "cannot begin" in line])
        self.assertEqual(len(told[0]), 1, told)
        self.assertIn("adds block late2 where block stone2 is now: they overlap by 0.52 m", told[0][0])
        self.assertEqual(told[1], told[0])

    def test_bolts_and_props_hold_alike_on_many_ranks(self):
        """A bolt down a wall whose grout slips, a tie rod from end to end and a strut."""
        scene = self.write_leaning_wall()
        with open(scene, "a", encoding="utf-8") as file:
            file.write('''
[[bolt]]
name = "pin"
from = [0.3, 0.125, 0.6]
to = [0.3, 0.125, -0.1]
area = 2e-4
bond_stiffness = 1e8
bond_strength = 2e3
shear_stiffness = 1e6
[[bolt]]
name = "tie"
from = [0, 0.125, 0.5]
to = [2, 0.125, 0.5]
anchored = "ends"
area = 1e-4
pretension = 500
[[prop]]
name = "strut"
from = [2, 0.125, 0.375]
to = [2.5, 0.125, 0]
stiffness = 1e6
''')
        scene.write_text(scene.read_text().replace("measure = [", 'measure = [{ name = "pin", bolt = "pin" }, { name = "tie", bolt = "tie" }, '))
        self.expect_same_motion("leaning.toml", 0.03, [3])
        supports = [json.loads((self.folder / str(count) / "summary.json").read_text())["support"] for count in (1, 3)]
        self.assertEqual(supports[0]["states"]["slipped"], 1)
        self.assertEqual(supports[1]["states"], supports[0]["states"])

    def test_more_ranks_than_blocks(self):
        self.expect_same_motion("falling_block", 0.02, [4])

    def test_summary_tells_the_ranks(self):
        out = self.folder / "out"
        status, _, errors = run(2, "run", self.scene("wall"), "--set", "analysis.end_time=0.02", "--quiet", "--out", out)
        self.assertEqual(status, 0, errors)
        ranks = json.loads((out / "summary.json").read_text())["ranks"]
        self.assertEqual(len(ranks), 2)
        blocks = json.loads((out / "summary.json").read_text())["blocks"]
        self.assertEqual(sum(rank["blocks"] for rank in ranks), blocks)
        for rank in ranks:
            self.assertLess(rank["ghosts"], blocks / 2)
            self.assertGreater(rank["bytes_sent"], 0)

    def test_equal_blocks_are_counted_once_on_many_ranks(self):
        """The wall has a ground, whole bricks and halves, a few of each on every rank."""
        counts = {}
        for count in (0, 1, 3):
            out = self.folder / str(count)
            status, _, errors = run(count, "run", self.scene("wall"), "--set", "analysis.end_time=0.002", "--quiet", "--out", out)
            self.assertEqual(status, 0, errors)
            counts[count] = json.loads((out / "summary.json").read_text())["counts"]["different_blocks"]
        self.assertEqual(counts[1], counts[0])
        self.assertEqual(counts[3], counts[0])

    def test_the_memory_limit_is_that_of_a_rank(self):
        """150 bricks: estimated at more than 80 MB for one process, at less for each of four."""
        scene = self.folder / "wall.toml"
        scene.write_text('''
analysis = { end_time = 1e-3, time_step = 1e-3, memory_limit = 8e7 }
contact = { friction_angle = 35 }
material = [{ name = "brick", density = 2000, young_modulus = 5e7, poisson_ratio = 0.2 }]
block = [{ name = "ground", fixed = true, box = { min = [-1, -1, -0.2], max = [7, 1, 0] } }]
masonry = [{ name = "wall", kind = "wall", material = "brick", length = 6, height = 1.8, brick = [0.5, 0.25, 0.15] }]
''', encoding="utf-8")
        status, _, errors = run(0, "run", scene, "--out", self.folder / "alone")
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertIn("scene is too large", errors)
        status, _, errors = run(4, "run", scene, "--out", self.folder / "shared")
        self.assertEqual(status, 0, errors)
        self.assertIn("MB on each of 4 ranks", errors)

    def test_results_are_sent_when_they_are_due(self):
        """Two frames and no rows between them: states and contacts of all blocks are sent for these only."""
        sent = {}
        for every in (1, 20):
            out = self.folder / str(every)
            status, _, errors = run(2, "run", self.scene("wall"), "--set", "analysis.end_time=0.02", "--set",
                                    "analysis.time_step=1e-3", "--set", f"output.every={every}", "--set", f"output.history_every={every}", "--quiet", "--checkpoint",
                                    "1e9", "--out", out)
            self.assertEqual(status, 0, errors)
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(len(table(out / "history.csv")), summary["steps"] // every + 1)
            sent[every] = summary["ranks"][1]["for_results"]["bytes_sent"] / summary["steps"]
        self.assertLess(sent[20], sent[1] / 3)

    def test_blocks_are_shared_out_again(self):
        """Bricks of a wall have more contact points than the first partition expects, cubes in free fall none."""
        cubes = ", ".join(f'{{ name = "cube{k}", material = "brick", box = {{ min = [{10 + 0.5 * k}, 0, 5], '
                          f'max = [{10.2 + 0.5 * k}, 0.2, 5.2] }} }}' for k in range(42))
        (self.folder / "uneven.toml").write_text(f'''
analysis = {{ end_time = 0.12, time_step = 1e-3 }}
contact = {{ friction_angle = 35 }}
material = [{{ name = "brick", density = 2000, young_modulus = 5e7, poisson_ratio = 0.2 }}]
block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -0.2], max = [4, 1, 0] }} }}, {cubes}]
masonry = [{{ name = "wall", kind = "wall", material = "brick", length = 2, height = 0.75, brick = [0.5, 0.25, 0.15] }}]
''', encoding="utf-8")
        self.expect_same_motion("uneven.toml", 0.12, [2])
        summary = json.loads((self.folder / "2" / "summary.json").read_text())
        self.assertEqual(summary["repartitions"], 1)
        weights = [rank["weight"] for rank in summary["ranks"]]
        self.assertLess(max(weights), 1.2 * sum(weights) / 2)
        status, _, errors = run(3, "run", self.folder / "uneven.toml", "--set", "analysis.end_time=0.125", "--quiet", "--resume",
                                "--out", self.folder / "2")
        self.assertEqual(status, 0, errors)

    def start(self, out):
        """A run on 2 ranks, with the process ids of its ranks once it has saved a state."""
        # One process group for all, which a failed test ends.
        process = subprocess.Popen(
            command(2, "run", self.scene("wall"), "--quiet", "--checkpoint", "0", "--out", out),
            stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(end_group, process)
        begun = time.monotonic()
        while not (out / "history.csv").exists() or len((out / "history.csv").read_text().splitlines()) < 6:
            self.assertLess(time.monotonic(), begun + LONGEST)
            self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
            time.sleep(0.05)
        return process, sorted(descendants(process.pid))

    def test_end_of_a_rank_ends_the_run_and_keeps_the_checkpoint(self):
        out = self.folder / "out"
        process, ranks = self.start(out)
        self.assertEqual(len(ranks), 2)
        os.kill(ranks[-1], signal.SIGKILL)
        self.assertNotEqual(process.wait(60), 0)
        self.assertTrue((out / "checkpoint").exists())
        reached = table(out / "history.csv")[-1]["time"]
        for count, more in ((2, 0.01), (1, 0.02), (3, 0.03), (0, 0.04)):
            status, _, errors = run(count, "run", self.scene("wall"), "--set", f"analysis.end_time={reached + more}", "--quiet",
                                    "--resume", "--out", out)
            self.assertEqual(status, 0, errors)
        times = [row["time"] for row in table(out / "history.csv")]
        self.assertEqual(times, sorted(set(times)))


def end_group(process):
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    process.stderr.close()


def descendants(parent):
    """Process ids of ashlar below a process."""
    below = []
    for path in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text().rsplit(")", 1)[1].split()
            name = (path / "comm").read_text().strip()
        except OSError:
            continue
        if int(fields[1]) == parent and name == pathlib.Path(ASHLAR).name[:15]:
            below.append(int(path.name))
    return below


if __name__ == "__main__":
    MPIEXEC, ASHLAR, SCENES = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
