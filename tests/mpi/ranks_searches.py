"""Searches for a factor and thrust on several ranks: answers, drawings and faults of one."""
import json
import math

from ranks_runs import BAD_INPUT, RanksTest, errors_in, run


class SearchesTest(RanksTest):
    def answer(self, count, scene, *options):
        """summary.json of a search, which ends with status 0, and its folder."""
        out = self.folder / f"{scene.stem}{len(options)}.{count}"
        status, _, errors = run(count, "run", scene, *options, "--out", out, "--force")
        self.assertEqual(status, 0, errors)
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        self.assertEqual(errors.count(summary["message"]), 1, errors)
        return summary, out

    def test_limit_analysis_and_thrust_are_those_of_one(self):
        arch = self.scene("arch_stands")
        for kind, key in (("factor-of-safety", "factor_of_safety"), ("thrust", "thrust")):
            options = ("--set", f"analysis.type={kind}")
            expected, alone = self.answer(0, arch, *options)
            for count in (2, 3):
                found, out = self.answer(count, arch, *options)
                self.assertEqual(found[key], expected[key])
                self.assertEqual(found["message"], expected["message"])
                self.assertEqual(sorted(path.name for path in out.rglob("*.vtu")),
                                 sorted(path.name for path in alone.rglob("*.vtu")))
                self.assertEqual((out / "thrust.svg").exists(), kind == "thrust")

    def test_static_analyses_of_a_search_are_shared(self):
        """A row of cubes, each with its load: they slide at tan(30) over the load of a half of the weight."""
        scene = self.folder / "pushed.toml"
        scene.write_text('''
analysis = { type = "factor-of-safety", method = "elastic", gravity = [0, 0, -10], safety = { tolerance = 0.05 } }
contact = { friction_angle = 30, friction_angle_residual = 29.9 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -1], max = [9, 2, 0] }
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
array = { count = [4], step = [[1, 0, 0]] }
load = [{ plane = { point = [0, 0, 0], normal = [0, 0, -1] }, force = [0, 10000, 0] }]
''', encoding="utf-8")
        expected, _ = self.answer(0, scene)
        sliding = 2 * math.tan(math.pi / 6)
        factor = expected["factor_of_safety"]
        self.assertLess(factor["lower"], 1.001 * sliding)
        self.assertGreater(factor["upper"], 0.995 * sliding)
        trials = [(trial["factor"], trial["outcome"]) for trial in factor["trials"]]
        for count in (2, 4):
            found = self.answer(count, scene)[0]
            self.assertEqual([(trial["factor"], trial["outcome"]) for trial in found["factor_of_safety"]["trials"]], trials)
            self.assertEqual(found["status"], expected["status"])
            self.assertEqual(len(found["ranks"]), count)

    def test_a_search_with_nothing_to_find_is_told_once(self):
        status, _, errors = run(3, "run", self.scene("arch_stands"), "--set", "analysis.type=thrust", "--set",
                                'analysis.movement.supports=["none"]', "--out", self.folder / "out")
        self.assertEqual(status, BAD_INPUT, errors)
        self.assertEqual(len(errors_in(errors)), 1, errors)
        self.assertFalse((self.folder / "out").exists())
