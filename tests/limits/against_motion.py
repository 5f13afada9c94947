#!/usr/bin/env python3
"""Random dry structures: factors and capacities along the load path against motion of the same program.

    python3 tests/limits/against_motion.py build/release/apps/ashlar --family walls --count 100 --seed 0
    python3 tests/limits/against_motion.py build/release/apps/ashlar --family arches --no-motion   # answers and times only
    python3 tests/limits/against_motion.py build/release/apps/ashlar --elastic 1 --no-motion       # and method = "elastic", order 1

Walls of 9 to 36 bricks, arches and portals (structures.py). A capacity is judged by motion of orders 0 and 1: from the static
state under gravity the side loads grow within 0.3 s to a load, and remain for 0.5 s. Blocks have to stay where they are 1 % below
`lower` and to leave 3 % above `upper`. Walls that are tilted are judged by motion with the reduced strength from its static state,
in the same way: friction has several equilibria, so that motion may stand above `upper`, but has to stay below `lower` with one of
both orders. Arches and portals, whose blocks hinge on their edges, move in contact by multipliers: springs yield under the
pressure of an edge, so that blocks begin to move up to 2.5 % below the limit of rigid ones. The lower end of `method = "elastic"` is within 3 % of that of rigid blocks, or its message says how much it differs.

Exit status: 0 nothing moves below its lower end, at most a tenth stands above its upper end, no difference between methods is
silent; 1 otherwise.
"""
import argparse
import collections
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import time

import structures

BELOW, ABOVE, ALIKE = 0.99, 1.03, 1.03  # of lower and upper; of both methods
GROWN, END, STEP = 0.3, 0.8, 2e-3  # s
LEAVES = 0.02  # of a block's length: displacement of blocks that leave


def run(program, folder, name, text):
    """@return the summary, or the message of a run without one"""
    scene, out = folder / f"{name}.toml", folder / f"{name}.out"
    scene.write_text(text)
    done = subprocess.run([program, "run", scene, "--out", out, "--force", "--quiet"], capture_output=True, text=True)
    try:
        return json.loads((out / "summary.json").read_text())
    except FileNotFoundError:
        return {"status": "failed", "message": done.stderr[-300:]}


def answer(program, folder, structure, method, order):
    """@return problems of the run, what it found, its message"""
    analysis = f'type = "{structure["kind"]}", method = "{method}", gravity = {structures.gravity_of(structure)}'
    scene = structures.scene_of(structure, analysis, order, structure["friction"])
    summary = run(program, folder, method, scene)
    found = summary.get("load_factor") or summary.get("factor_of_safety") or {}
    return ([] if summary["status"] == "completed" else [f"no answer ({method})"]), found, summary.get("message", "")


def leaves(program, folder, structure, factor, order):
    """True if motion under a factor leaves its place; None: there is no motion to judge by."""
    friction, history = structure["friction"], None
    if structure["kind"] == "capacity":
        history = [[0, 0], [GROWN, factor], [END, factor]]
    else:
        friction = math.degrees(math.atan(math.tan(math.radians(friction)) / factor))
    analysis = (f'type = "dynamic", initial_state = "static", end_time = {END}, time_step = {STEP}, '
                f'gravity = {structures.gravity_of(structure)}')
    scene = structures.scene_of(structure, analysis, order, friction, history,
                                ", augmented = true" if structure["hinges"] else ", augmented = false")
    summary = run(program, folder, f"motion_{order}", scene)
    if summary["status"] != "completed" or "largest_displacement" not in summary:
        return None
    return summary["largest_displacement"]["value"] > LEAVES * structure["length"]


def judged(program, folder, structure, lower, upper):
    """@return problems of an answer: "moves below", "stands above" """
    below = [leaves(program, folder, structure, BELOW * lower, order) for order in (0, 1)] if lower else []
    above = [leaves(program, folder, structure, ABOVE * upper, order) for order in (0, 1)] if upper else []
    told = [value for value in below if value is not None]
    capacity = structure["kind"] == "capacity"
    problems = [] if told or not below else ["motion fails"]
    if told and (any(told) if capacity else all(told)):
        problems.append("moves below")
    if capacity and above and not any(value is not False for value in above):
        problems.append("stands above")
    return problems


def compared(program, folder, structure, order, rigid):
    """@return the lower end of method = "elastic", and problems: "silent difference" """
    problems, found, message = answer(program, folder, structure, "elastic", order)
    lower = found.get("lower")
    alike = lower and rigid and max(lower, rigid) <= ALIKE * min(lower, rigid)
    if not problems and not alike and (lower or rigid) and "rigid blocks" not in message:
        problems.append("silent difference")
    return lower, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--family", choices=list(structures.FAMILIES), default="walls")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--no-motion", action="store_true")
    parser.add_argument("--elastic", type=int, metavar="ORDER", help='compare with method = "elastic", blocks of this order')
    arguments = parser.parse_args()
    told, seconds = collections.Counter(), []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(arguments.seed, arguments.seed + arguments.count):
            structure = structures.FAMILIES[arguments.family](random.Random(seed))
            began = time.monotonic()
            problems, found, _ = answer(arguments.program, folder, structure, "limit", 0)
            seconds.append(time.monotonic() - began)
            lower, upper, beside = found.get("lower"), found.get("upper"), ""
            if arguments.elastic is not None and not problems:
                elastic, more = compared(arguments.program, folder, structure, arguments.elastic, lower)
                problems, beside = problems + more, f", elastic {elastic}"
            if not problems and not arguments.no_motion:
                problems = judged(arguments.program, folder, structure, lower, upper)
            told.update(problems)
            print(f'{seed}: {structure["label"]}, {structure["kind"]}, {lower} to {upper}, '
                  f'associated {found.get("associated")}{beside}, {seconds[-1]:.1f} s {", ".join(problems)}', flush=True)
    seconds.sort()
    print(f'{arguments.count} {arguments.family}: {", ".join(f"{n} {what}" for what, n in told.items()) or "no problem"}; '
          f"median {seconds[len(seconds) // 2]:.1f} s, at most {seconds[-1]:.1f} s")
    allowed = {"stands above": 0.1 * arguments.count, "motion fails": 0.1 * arguments.count}
    sys.exit(1 if any(n > allowed.get(what, 0) for what, n in told.items()) else 0)


if __name__ == "__main__":
    main()
