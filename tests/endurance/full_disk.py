"""Runs on a file system that becomes full: state and summary of the last accepted step exist, and the run is resumed
from them once there is space. Skipped (77) where no small file system can be mounted.

Use: full_disk.py ASHLAR
"""
import filecmp
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
MOUNTED = "ASHLAR_FULL_DISK"
SKIPPED = 77
# A checkpoint of 424,000 bytes beside the files of the first steps.
SPACE = 620 * 1024


def run(scene, out, *more):
    done = subprocess.run([sys.argv[1], "run", str(scene), "--out", str(out), "--quiet", *more], capture_output=True,
                          text=True, check=False)
    return done.returncode, done.stderr


class FullDiskTest(unittest.TestCase):
    def fill(self, disk, left):
        """Leaves so many bytes free."""
        free = os.statvfs(disk)
        with open(disk / "filler", "ab") as file:
            file.write(b"x" * max(0, free.f_bavail * free.f_frsize - left))

    def expect_saved(self, more, left):
        disk = pathlib.Path(os.environ[MOUNTED])
        out = disk / "out"
        end = ["--set", "analysis.end_time=1", *more]
        with tempfile.TemporaryDirectory() as folder:
            straight = pathlib.Path(folder) / "straight"
            self.assertEqual(run(HERE / "bounce.toml", straight, *end)[0], 0)
            self.fill(disk, left)
            status, errors = run(HERE / "bounce.toml", out, *end)
            self.assertEqual(status, 1, errors)
            self.assertIn("No space left on device", errors)
            self.assertIn("the last accepted state is in", errors)
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(summary["status"], "failed")
            self.assertGreater(summary["steps"], 10)
            self.assertLess(summary["steps"], 1000)
            os.remove(disk / "filler")
            status, errors = run(HERE / "bounce.toml", out, *end, "--resume")
            self.assertEqual(status, 0, errors)
            for name in ["history.csv", "contacts.csv", "blocks.pvd", "contacts.pvd",
                         *("frames/" + path.name for path in (straight / "frames").iterdir())]:
                self.assertTrue(filecmp.cmp(straight / name, out / name, shallow=False), name)
        subprocess.run(["rm", "-rf", out], check=True)

    def test_table_fills_the_disk(self):
        self.expect_saved(["--set", "output.every=1000000"], SPACE)

    def test_contacts_come_after_the_only_checkpoint_that_was_due(self):
        self.expect_saved(["--set", "output.every=1000000", "--checkpoint", "1000000"], SPACE)

    def test_frames_fill_the_disk(self):
        self.expect_saved(["--set", "output.history_every=1000000"], SPACE)

    def test_checkpoints_on_the_way(self):
        self.expect_saved(["--set", "output.every=5", "--checkpoint", "0"], SPACE)

    def test_a_disk_without_space_at_the_start_is_told(self):
        disk = pathlib.Path(os.environ[MOUNTED])
        self.fill(disk, 40 * 1024)
        status, errors = run(HERE / "bounce.toml", disk / "none")
        self.assertIn(status, (1, 2), errors)
        self.assertIn("No space left on device", errors)
        os.remove(disk / "filler")
        subprocess.run(["rm", "-rf", disk / "none"], check=True)


def main():
    if MOUNTED in os.environ:
        unittest.main(argv=sys.argv[:1])
    with tempfile.TemporaryDirectory() as disk:
        mount = f'mount -t tmpfs -o size=64m tmpfs "{disk}" && exec env {MOUNTED}="{disk}" "$0" "$@"'
        probe = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
        if subprocess.run([*probe, f'mount -t tmpfs -o size=64m tmpfs "{disk}"'], capture_output=True,
                          check=False).returncode != 0:
            print("no small file system can be mounted here")
            return SKIPPED
        return subprocess.run([*probe, mount, sys.executable, __file__, *sys.argv[1:]], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
