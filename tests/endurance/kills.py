#!/usr/bin/env python3
"""Kills runs at random moments and lets them go on: the results must be those of a run that never stopped, bit for bit.

    python3 tests/endurance/kills.py --program build/release/apps/ashlar --count 1000 --seed 1

Every run of the scene is ended several times, by SIGKILL or, one time in five, by a signal that asks it to stop, and
goes on from its checkpoint; where it was killed before the first one it starts again. One time in ten it is started
anew by --force, and killed again. Moments are random shares of the time that a whole run takes. Exit status: 0 all
results are the same, 1 some are not, 2 wrong usage.
"""
import argparse
import filecmp
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
TABLES = ["history.csv", "contacts.csv", "blocks.pvd", "contacts.pvd", "joints.pvd"]
VARIANTS = [["--checkpoint", "0"], ["--checkpoint", "0.02"], [],
            ["--checkpoint", "0", "--set", "output.history_every=7"],
            ["--checkpoint", "0.01", "--set", "output.interval=0.0137", "--threads", "2"],
            ["--checkpoint", "0", "--set", "analysis.integrator=generalized-alpha"]]
STOPPED = 130
REFUSED = 2
PROGRESS = 50


class Failure(Exception):
    """Results or an exit status that must not be."""


def command(options, out, variant, more=()):
    return [options.program, "run", str(HERE / "bounce.toml"), "--out", str(out), "--quiet", *variant, *more]


def run(options, out, variant, more=()):
    """Runs to the end; returns the exit status and what was said."""
    done = subprocess.run(command(options, out, variant, more), capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def end_at(options, out, variant, more, moment, ending):
    """Runs until a signal ends it after some seconds; returns "ended", "done" if it was faster, or "unfit" where the
    checkpoint fits to no table."""
    with subprocess.Popen(command(options, out, variant, more), stderr=subprocess.PIPE, text=True) as process:
        try:
            process.wait(moment)
        except subprocess.TimeoutExpired:
            process.send_signal(ending)
        errors = process.communicate()[1]
    if process.returncode in (-ending, STOPPED):
        return "ended"
    if process.returncode == REFUSED and "cannot resume" in errors:
        return "unfit"
    if process.returncode != 0:
        raise Failure(f"exit status {process.returncode}: {errors}")
    return "done"


def differences(a, b):
    """Names of what differs between two result folders."""
    names = sorted(p.name for p in (a / "frames").iterdir())
    if names != sorted(p.name for p in (b / "frames").iterdir()):
        return ["the list of frames"]
    files = TABLES + ["frames/" + name for name in names]
    found = [name for name in files if not filecmp.cmp(a / name, b / name, shallow=False)]
    summaries = [json.loads((folder / "summary.json").read_text()) for folder in (a, b)]
    for key in ("status", "steps", "time", "frames", "penetration_max", "energy_residual", "energy_max"):
        if summaries[0][key] != summaries[1][key]:
            found.append("summary.json: " + key)
    return found


def goes_on(out):
    return ["--resume"] if (out / "checkpoint").exists() else []


def trial(options, chance, variant, reference, seconds, out):
    """Ends a run several times and lets it end by itself; returns how many times it was ended."""
    ended = 0
    forced = False
    for _ in range(chance.randint(1, 6)):
        how = ["--force"] if chance.random() < 0.1 else goes_on(out)
        ending = chance.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP]) if chance.random() < 0.2 \
            else signal.SIGKILL
        moment = chance.uniform(0.0, 1.1 * seconds)
        result = end_at(options, out, variant, how, moment, ending)
        if result == "unfit" and forced:
            # Killed between its new tables and its first checkpoint: the old one is told to fit to nothing.
            how = ["--force"]
            result = end_at(options, out, variant, how, moment, ending)
        if result == "unfit":
            raise Failure("a checkpoint that does not fit to its tables")
        ended += result == "ended"
        forced = how == ["--force"] or (forced and result == "ended")
    status, errors = run(options, out, variant, goes_on(out))
    if status == REFUSED and forced and "cannot resume" in errors:
        status, errors = run(options, out, variant, ["--force"])
    if status != 0:
        raise Failure(f"exit status {status}: {errors}")
    wrong = differences(reference, out)
    if wrong:
        raise Failure(f"{' '.join(variant)}: other results after {ended} kills: {', '.join(wrong)}")
    return ended


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--count", type=int, default=50, help="kills")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", help="where results are written; one in memory is faster")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ashlar-kills-", dir=options.folder))
    references = []
    for k, variant in enumerate(VARIANTS):
        begin = time.monotonic()
        status, errors = run(options, folder / f"straight{k}", variant)
        if status != 0:
            print(errors)
            return 2
        references.append((folder / f"straight{k}", time.monotonic() - begin))
    kills = trials = 0
    try:
        while kills < options.count:
            k = trials % len(VARIANTS)
            out = folder / "out"
            shutil.rmtree(out, ignore_errors=True)
            before = kills
            kills += trial(options, chance, VARIANTS[k], *references[k], out)
            trials += 1
            if kills // PROGRESS > before // PROGRESS:
                print(f"{kills} kills", flush=True)
    except Failure as failure:
        print(f"run {trials + 1}, after {kills} kills before: {failure}\nresults are left in {folder}")
        return 1
    shutil.rmtree(folder)
    print(f"{kills} kills in {trials} runs: all results are those of runs that never stopped")
    return 0


if __name__ == "__main__":
    sys.exit(main())
