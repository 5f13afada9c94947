"""Stages of runs on several ranks."""
import json
import pathlib

from ranks_runs import RanksTest, run


class StagesTest(RanksTest):
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
