#!/usr/bin/env python3
"""A run of very many steps: memory stays flat, times do not drift, the history stays small.

    python3 tests/endurance/soak.py --program build/release/apps/ashlar --steps 1000000

Memory is read from /proc while the run goes on; after its first tenth it may grow by 1 MB. Exit status: 0 passes, 1 does
not.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
STEP_MS = 1
ROWS_EVERY = 1000
ALLOWED_GROWTH = 1024  # kB


def resident(pid):
    """kB of memory that the process has now; None: it has ended."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1])
    except OSError:
        pass
    return None


def last_step(history):
    """Of the last whole row."""
    try:
        with open(history, "rb") as file:
            file.seek(max(0, history.stat().st_size - 4096))
            rows = file.read().decode().split("\n")
        return int(rows[-2].split(",")[0])
    except (OSError, ValueError, IndexError):
        return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--steps", type=int, default=1000000)
    options = parser.parse_args()
    faults = []
    with tempfile.TemporaryDirectory(prefix="ashlar-soak-") as folder:
        out = pathlib.Path(folder) / "out"
        begin = time.monotonic()
        memory = []
        with subprocess.Popen([options.program, "run", HERE / "slide.toml", "--out", out, "--quiet", "--threads", "1",
                               "--set", f"analysis.end_time={options.steps * STEP_MS / 1000}"]) as process:
            while process.poll() is None:
                now = resident(process.pid)
                if now:
                    memory.append((last_step(out / "history.csv"), now))
                time.sleep(0.2)
        seconds = time.monotonic() - begin
        if process.returncode != 0:
            faults.append(f"exit status {process.returncode}")
        summary = json.loads((out / "summary.json").read_text())
        if summary["steps"] != options.steps:
            faults.append(f"{summary['steps']} steps, not {options.steps}")
        with open(out / "history.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        wanted = [*range(0, options.steps + 1, ROWS_EVERY)]
        if [int(row["step"]) for row in rows] != wanted + ([options.steps] if wanted[-1] != options.steps else []):
            faults.append("other rows than every thousandth and the last")
        drift = max(abs(float(row["time"]) - int(row["step"]) * STEP_MS / 1000) for row in rows)
        if drift != 0.0:
            faults.append(f"times are off by {drift} s")
        settled = [kb for step, kb in memory if step >= options.steps // 10]
        if not settled:
            faults.append("too fast to see memory, more --steps are needed")
        elif max(settled) - settled[0] > ALLOWED_GROWTH:
            faults.append(f"memory grew from {settled[0]} to {max(settled)} kB")
        if settled:
            print(f"{options.steps} steps in {seconds:.0f} s; memory {settled[0]} kB after a tenth, {max(settled)} kB at "
                  f"most; history.csv {(out / 'history.csv').stat().st_size} bytes")
    for fault in faults:
        print("fault: " + fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
