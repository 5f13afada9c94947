"""Static analyses and starts from statics on several ranks: verdicts and equilibria of one."""
from ranks_runs import BAD_INPUT, RanksTest, errors_in, run, table


class StaticsTest(RanksTest):
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
