"""Programs that ashlar starts (Python for plots, a browser for pictures, ffmpeg): nothing beside a scene is run, they have
the limits of ashlar and one thread for linear algebra, and end with it.

Use: children_test.py ASHLAR
"""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ASHLAR = os.path.abspath(sys.argv[1])
RECORD = "time,acceleration\n" + "".join(f"{k / 100},{(k * 7919) % 13 - 6}\n" for k in range(100))
SCENE = """
analysis = { end_time = 2e-3, time_step = 1e-3 }
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
block = [{ name = "b", material = "m", box = { min = [0, 0, 0], max = [1, 1, 1] } }]
"""
MARKER = "import os, pathlib; pathlib.Path(os.environ['MARKER']).touch()\n"
REPORT = """#!/bin/sh
{ echo "ARGUMENTS $*"; echo "FOLDER $(pwd)"; echo "SPACE $(ulimit -v)"; env; } > "$REPORT"
exit 1
"""
# Starts a process of its own, and both wait.
SLEEPER = """#!/bin/sh
sleep 300 & echo $$ $! > "$PIDS.new"
mv "$PIDS.new" "$PIDS"
wait
"""


def executable(path, text):
    path.write_text(text)
    path.chmod(0o755)
    return path


def is_running(pid):
    try:
        state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state not in "ZX"


def wait_until(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


class ChildrenTest(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.addCleanup(self.kept.cleanup)
        self.folder = pathlib.Path(self.kept.name)
        (self.folder / "record.csv").write_text(RECORD)
        (self.folder / "scene.toml").write_text(SCENE)

    def start(self, *arguments, limit=None, **variables):
        def limited():
            if limit:
                resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        return subprocess.Popen([ASHLAR, *arguments], cwd=self.folder, env={**os.environ, **variables}, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=limited)

    def run_to_end(self, *arguments, seconds=120, **variables):
        child = self.start(*arguments, **variables)
        out, _ = child.communicate(timeout=seconds)
        return child.returncode, out

    def result_folder(self):
        self.assertEqual(self.run_to_end("run", "scene.toml", "--out", "r", "--quiet")[0], 0)

    def test_nothing_beside_a_scene_is_run(self):
        marker = self.folder / "marker"
        for name in ("matplotlib", "io", "json", "numpy", "sitecustomize", "usercustomize", "pathlib"):
            (self.folder / f"{name}.py").write_text(MARKER)
        executable(self.folder / "python3", "#!/bin/sh\ntouch \"$MARKER\"\nexit 1\n")
        (self.folder / "matplotlibrc").write_text("backend: module://matplotlib_evil\nfigure.figsize: none\n")
        for path in (os.environ["PATH"], ".:" + os.environ["PATH"], ":" + os.environ["PATH"]):
            (self.folder / "plot.svg").unlink(missing_ok=True)
            status, out = self.run_to_end("spectrum", "record.csv", "-o", "plot.csv", "--force", MARKER=str(marker),
                                          PATH=path, PYTHONPATH=str(self.folder))
            if status == 2:  # without --force
                status, out = self.run_to_end("spectrum", "record.csv", "-o", "plot.csv", MARKER=str(marker),
                                              PATH=path, PYTHONPATH=str(self.folder))
            self.assertEqual(status, 0, out)
            self.assertFalse(marker.exists(), out)
            self.assertTrue("picture: plot.svg" in out or "No module named 'matplotlib'" in out, out)

    def test_programs_have_limits_one_thread_and_a_folder_of_their_own(self):
        report = self.folder / "report"
        program = executable(self.folder / "program", REPORT)
        limit = 1 << 31
        self.result_folder()
        for variable, command in (("ASHLAR_PYTHON", ("spectrum", "record.csv", "-o", "plot.csv")),
                                  ("ASHLAR_BROWSER", ("picture", "r", "-o", "p.png"))):
            report.unlink(missing_ok=True)
            child = self.start(*command, limit=limit, OPENBLAS_NUM_THREADS="7", OMP_NUM_THREADS="8", REPORT=str(report),
                               **{variable: str(program)})
            out, _ = child.communicate(timeout=120)
            self.assertTrue(report.exists(), out)
            lines = report.read_text().splitlines()
            for threads in ("OPENBLAS", "OMP", "MKL"):
                self.assertEqual([line for line in lines if line.startswith(f"{threads}_NUM_THREADS=")],
                                 [f"{threads}_NUM_THREADS=1"])
            self.assertIn(f"SPACE {limit // 1024}", lines)
            self.assertNotIn(f"FOLDER {self.folder}", lines)
            self.assertEqual("ARGUMENTS -I " in report.read_text(), variable == "ASHLAR_PYTHON", lines)

    def test_plots_end_where_memory_is_limited(self):
        for limit in (1 << 29, 1 << 30, 1 << 31):
            (self.folder / "plot.csv").unlink(missing_ok=True)
            begin = time.monotonic()
            # By itself the library takes a thread, and 128 MiB of addresses, for each processor.
            child = self.start("spectrum", "record.csv", "-o", "plot.csv", limit=limit, OPENBLAS_NUM_THREADS="64")
            out, _ = child.communicate(timeout=120)
            self.assertIn("picture", out)
            self.assertNotIn("did not finish", out)
            self.assertLess(time.monotonic() - begin, 55, out)
            self.assertTrue((self.folder / "plot.csv").exists(), out)

    def expect_ended(self, ending, variable, command):
        pids = self.folder / "pids"
        pids.unlink(missing_ok=True)
        program = executable(self.folder / "program", SLEEPER)
        child = self.start(*command, PIDS=str(pids), **{variable: str(program)})
        self.assertTrue(wait_until(pids.exists))
        running = [int(pid) for pid in pids.read_text().split()]
        self.assertTrue(all(map(is_running, running)))
        child.send_signal(ending)
        child.communicate(timeout=60)
        self.assertTrue(wait_until(lambda: not any(map(is_running, running))), f"{command} {ending} {running}")

    def test_programs_end_with_ashlar(self):
        self.result_folder()
        for ending in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            (self.folder / "plot.csv").unlink(missing_ok=True)
            self.expect_ended(ending, "ASHLAR_PYTHON", ("spectrum", "record.csv", "-o", "plot.csv"))
            self.expect_ended(ending, "ASHLAR_BROWSER", ("picture", "r", "-o", "p.png"))

    def test_a_program_that_cannot_start_is_told(self):
        self.assertIn("cannot start", self.run_to_end("spectrum", "record.csv", "-o", "plot.csv",
                                                      ASHLAR_PYTHON=str(self.folder / "none"))[1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
