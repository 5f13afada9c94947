#!/usr/bin/env python3
"""Kills runs at random moments and resumes them: the results must be those of an uninterrupted run, bit for bit.

    python3 tests/endurance/kills.py --program build/release/apps/ashlar --count 1600 --seed 1
    python3 tests/endurance/kills.py --kinds 'solver_*' 'demo_*' --count 200

The runs are those of kinds.json, one after the other: every demo scene, a scene for each key of contact and joints, each
solver and integrator, statics, stages, searches for a factor. A run is ended several times, by SIGKILL or, one time in
five, by a signal that asks it to stop, and goes on from its checkpoint; where it was killed before the first one it
starts again. One time in ten it is started anew by --force, and killed again. Moments are random shares of the time that
a whole run takes. Each kind comes up at least once. Exit status: 0 all results are the same, 1 some are not, 2 wrong
usage.
"""
import argparse
import filecmp
import fnmatch
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
TABLES = ["history.csv", "contacts.csv"]
ONE_FILE = "results.vtkhdf"
# Conditions of a resumed run: no result depends on them.
MANNERS = [["--checkpoint", "0"], ["--checkpoint", "0.02"], [], ["--checkpoint", "0.01", "--threads", "2"]]
# Keys of the summary for clocks, memory, and work that a resumed run repeats.
MEASURED = ["wall_seconds", "peak_memory_bytes"]
REPEATED = ["symbolic_factorizations", "numeric_factorizations", "numeric_factorizations_reused", "linear_solves",
            "conjugate_gradient_iterations", "predicates_by_filter", "predicates_exact", "share_of_exact_predicates"]
STOPPED = 130
REFUSED = 2


class Failure(Exception):
    """Results or an exit status that must not be."""


class Kind:
    """A run of kinds.json, with the results of an uninterrupted run."""

    def __init__(self, program, name, entry, folder):
        self.name = name
        self.command = [program, "run", str(HERE / entry["scene"]), "--quiet",
                        *(word for key in entry["set"] for word in ("--set", key))]
        self.reference = folder / f"{name}.straight"
        begin = time.monotonic()
        # A run that finds no equilibrium, say, has to end likewise.
        self.status, errors = self.run(self.reference, MANNERS[0])
        self.seconds = time.monotonic() - begin
        if self.status < 0 or self.status in (REFUSED, STOPPED):
            raise Failure(f"exit status {self.status} of a run that is not stopped: {errors}")

    def arguments(self, out, manner):
        return [*self.command, "--out", str(out), *manner]

    def run(self, out, manner):
        """Runs to the end; returns the exit status and the messages."""
        done = subprocess.run(self.arguments(out, manner), capture_output=True, text=True, check=False)
        return done.returncode, done.stderr


def missing(program, names):
    """Kinds that there have to be: of each demo scene, key of contact and joints, and word of the analysis."""
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, text=True, check=True).stdout)
    keys = schema["properties"]
    analysis = keys["analysis"]["properties"]
    needed = ["demo_" + scene.stem for scene in (HERE / "../../data/scenes").glob("*.toml")]
    needed += ["contact_" + key for key in keys["contact"]["properties"]]
    needed += ["joint_" + key for key in keys["joint"]["items"]["properties"] if key not in ("blocks", "cut")]
    for key, start in (("solver", "solver_"), ("integrator", "integrator_"), ("initial_state", "start_"), ("type", "")):
        needed += [start + word.replace("-", "_") for word in analysis[key]["enum"] if word not in ("as-placed", "dynamic")]
    return sorted(set(needed) - set(names))


def end_at(kind, out, manner, moment, ending):
    """Runs until a signal ends it after some seconds; returns "ended", "done" if it was faster, or "unfit" where the
    checkpoint fits to no table."""
    with subprocess.Popen(kind.arguments(out, manner), stderr=subprocess.PIPE, text=True) as process:
        try:
            process.wait(moment)
        except subprocess.TimeoutExpired:
            process.send_signal(ending)
        errors = process.communicate()[1]
    if process.returncode in (-ending, STOPPED):
        return "ended"
    if process.returncode == REFUSED and "cannot resume" in errors:
        return "unfit"
    if process.returncode != kind.status:
        raise Failure(f"exit status {process.returncode}: {errors}")
    return "done"


def differences(a, b):
    """Names of the differences between two result folders."""
    names = sorted(str(p.relative_to(a)) for p in frame_files(a))
    if names != sorted(str(p.relative_to(b)) for p in frame_files(b)):
        return ["the list of frames"]
    files = TABLES + [name for name in names if not name.endswith(".vtkhdf")]
    found = [name for name in files if not filecmp.cmp(a / name, b / name, shallow=False)]
    if ONE_FILE in names and contents(a / ONE_FILE) != contents(b / ONE_FILE):
        found.append(ONE_FILE)
    summaries = [told_by(folder / "summary.json") for folder in (a, b)]
    keys = summaries[0].keys() | summaries[1].keys()
    return found + [f"summary.json: {key}" for key in sorted(keys) if summaries[0].get(key) != summaries[1].get(key)]


def frame_files(folder):
    """Files of frames, those that a killed run leaves included."""
    return [*folder.glob("frames/*"), *folder.glob("*.pvd"), *folder.glob(ONE_FILE + "*")]


def contents(path):
    """Values of every dataset and attribute of an HDF5 file."""
    import h5py
    found = {}

    def add(name, member):
        found[name] = {key: str(value) for key, value in member.attrs.items()}
        if isinstance(member, h5py.Dataset):
            values = member[()]
            found[name]["values"] = list(values) if member.dtype.kind == "O" else (member.shape, values.tobytes())

    with h5py.File(path) as file:
        file.visititems(add)
    return found


def told_by(path):
    """Statements of a summary on the results."""
    summary = json.loads(path.read_text())
    for key in MEASURED:
        del summary[key]
    for key in REPEATED:
        del summary["counts"][key]
    return summary


def goes_on(out):
    return ["--resume"] if (out / "checkpoint").exists() or (out / "factor_trials.json").exists() else []


def trial(kind, chance, most, out):
    """Ends a run several times and lets it end by itself; returns how many times it was ended."""
    ended = 0
    forced = False
    manner = chance.choice(MANNERS)
    for _ in range(chance.randint(1, most)):
        how = ["--force"] if chance.random() < 0.1 else goes_on(out)
        ending = chance.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP]) if chance.random() < 0.2 \
            else signal.SIGKILL
        moment = chance.uniform(0.0, 1.1 * kind.seconds)
        result = end_at(kind, out, manner + how, moment, ending)
        if result == "unfit" and forced:
            # Killed between its new tables and its first checkpoint: the old checkpoint is refused.
            how = ["--force"]
            result = end_at(kind, out, manner + how, moment, ending)
        if result == "unfit":
            raise Failure("a checkpoint that does not fit to its tables")
        ended += result == "ended"
        forced = how == ["--force"] or (forced and result == "ended")
    status, errors = kind.run(out, manner + goes_on(out))
    if status == REFUSED and forced and "cannot resume" in errors:
        status, errors = kind.run(out, manner + ["--force"])
    if status != kind.status:
        raise Failure(f"exit status {status}: {errors}")
    wrong = differences(kind.reference, out)
    if wrong:
        raise Failure(f"{' '.join(manner)}: other results after {ended} kills: {', '.join(wrong)}")
    return ended


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--kinds", nargs="+", default=["*"], help="names or globs of kinds.json")
    parser.add_argument("--count", type=int, default=0, help="kills, at least; every kind has its turn")
    parser.add_argument("--most", type=int, default=6, help="kills of one run")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", help="where results are written; one in memory is faster")
    options = parser.parse_args()
    every = json.loads((HERE / "kinds.json").read_text())
    if missing(options.program, every):
        print(f"kinds.json has nothing of this name: {', '.join(missing(options.program, every))}")
        return 1
    entries = {name: entry for name, entry in every.items()
               if any(fnmatch.fnmatchcase(name, pattern) for pattern in options.kinds)}
    if not entries:
        parser.error("no kind has such a name")
    chance = random.Random(options.seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ashlar-kills-", dir=options.folder))
    kinds = {}
    kills = trials = failures = 0
    while trials < len(entries) or (kills < options.count and failures < len(entries)):
        name = list(entries)[trials % len(entries)]
        trials += 1
        out = folder / f"{name}.{trials}"
        try:
            if name not in kinds:
                kinds[name] = Kind(options.program, name, entries[name], folder)
            kills += trial(kinds[name], chance, options.most, out)
            shutil.rmtree(out)
        except Failure as failure:
            failures += 1
            print(f"{name}: {failure}", flush=True)
        if trials % len(entries) == 0:
            print(f"{kills} kills", flush=True)
    if failures > 0:
        print(f"{failures} of {trials} runs of {len(kinds)} kinds are wrong, results are left in {folder}")
        return 1
    shutil.rmtree(folder)
    print(f"{kills} kills in {trials} runs of {len(kinds)} kinds: all results are those of runs that never stopped")
    return 0


if __name__ == "__main__":
    sys.exit(main())
