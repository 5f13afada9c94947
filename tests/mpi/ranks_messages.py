"""Errors and refusals of the program on several ranks: told once."""
from ranks_runs import BAD_INPUT, RanksTest, errors_in, run


class MessagesTest(RanksTest):
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
        status, _, errors = run(2, "run", self.scene("wall"), "--set", "analysis.accuracy=0.01", "--out", self.folder / "out")
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
