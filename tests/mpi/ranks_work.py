"""Work of several ranks: what they send, who has which blocks, the end of one of them."""
import json
import os
import pathlib
import signal
import subprocess
import time

from ranks_runs import BAD_INPUT, LONGEST, Program, RanksTest, command, run, table


class WorkTest(RanksTest):
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
        if int(fields[1]) == parent and name == pathlib.Path(Program.ashlar).name[:15]:
            below.append(int(path.name))
    return below
