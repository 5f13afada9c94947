"""Motions of blocks on several ranks: those of one."""
import json

from ranks_runs import RanksTest, run


class MotionTest(RanksTest):
    def test_one_rank_has_the_bits_of_a_run_without(self):
        short = ["--set", "analysis.end_time=0.2", "--set", "output.every=50", "--quiet", "--out"]
        self.assertEqual(run(0, "run", self.scene("wall"), *short, self.folder / "plain")[0], 0)
        status, _, errors = run(1, "run", self.scene("wall"), *short, self.folder / "ranked")
        self.assertEqual(status, 0, errors)
        self.expect_same_files(self.folder / "plain", self.folder / "ranked")

    def test_wall_moves_alike_on_many_ranks(self):
        self.expect_same_motion("wall", 0.1, [2, 4])

    def test_falling_stones_move_alike_on_many_ranks(self):
        self.expect_same_motion("falling_block", 0.2, [2])

    def test_drifts_and_cracks_are_those_of_all_blocks(self):
        self.write_leaning_wall()
        self.expect_same_motion("leaning.toml", 0.05, [2, 4])

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
