"""Cost of a step from Python relative to the program: processor time on one thread, as a ratio.

Each side runs a scene twice, for a few steps and for many; the difference is that of the steps alone, without start, reading
and building. Both sides take turns, and the least of each counts. Times are of this machine, their ratio is not.

use: PYTHONPATH=BUILD/apps/python python3 python_step.py BUILD [--scene SCENE] [--steps FEW MANY] [--rounds N]
"""
import argparse
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEPS = """
import sys
import ashlar
sim = ashlar.Scene.load(sys.argv[1], overrides=sys.argv[3:]).simulation()
for _ in range(int(sys.argv[2])):
    sim.step()
"""


def processor_seconds(*command):
    """Of a program that ends well: user and system time."""
    arguments = [str(part) for part in command]
    child = os.posix_spawnp(arguments[0], arguments, os.environ)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{' '.join(arguments)}: status {status}")
    return usage.ru_utime + usage.ru_stime


def seconds_of(side, steps, options, folder):
    step = 2e-3
    overrides = [f"analysis.time_step={step}", f"analysis.end_time={steps * step}",
                 "output.every=1000000"]
    if side == "python":
        return processor_seconds(sys.executable, "-c", STEPS, options.scene, steps, *overrides)
    changes = [part for override in overrides for part in ("--set", override)]
    return processor_seconds(pathlib.Path(options.build) / "apps/ashlar", "run", options.scene, "--threads", 1, "--quiet",
                             "--force", "--out", pathlib.Path(folder) / "out", *changes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("build", help="folder of a release build")
    parser.add_argument("--scene", default=ROOT / "data/scenes/wall.toml")
    parser.add_argument("--steps", type=int, nargs=2, default=(5, 65), metavar=("FEW", "MANY"))
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    few, many = options.steps
    least = {(side, steps): float("inf") for side in ("program", "python") for steps in (few, many)}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for side, steps in least:
                least[side, steps] = min(least[side, steps], seconds_of(side, steps, options, folder))
    cost = {side: (least[side, many] - least[side, few]) / (many - few) for side in ("program", "python")}
    for side, seconds in cost.items():
        print(f"{side}: {1e3 * seconds:.2f} ms a step")
    print(f"python / program: {cost['python'] / cost['program']:.3f}")


main()
