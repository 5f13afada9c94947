#!/usr/bin/env python3
"""Random dry walls: factors and capacities along the load path against motion of the same program.

    python3 tests/limits/against_motion.py build/release/apps/ashlar --count 100 --seed 0
    python3 tests/limits/against_motion.py build/release/apps/ashlar --count 100 --no-motion   # answers and times only

Walls of 9 to 36 bricks in running or stack bond, friction angles of 25 to 45 degrees, pushed or tilted along or across their
plane. A capacity is judged by motion of orders 0 and 1: from the static state under gravity the side loads grow within 0.3 s
to a load, and remain for 0.5 s. Blocks have to stay where they are 1 % below `lower` and to leave 3 % above `upper`. Walls that
are tilted are judged by motion with the reduced strength from its static state, in the same way: friction has several equilibria,
so that motion may stand above `upper`, but has to stay below `lower` with one of both orders.

Exit status: 0 nothing moves below its lower end, and at most a tenth stands above its upper end; 1 otherwise.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import time

G, DENSITY = 9.81, 2500.0
BELOW, ABOVE = 0.99, 1.03  # of lower and upper
GROWN, END, STEP = 0.3, 0.8, 1e-3  # s
LEAVES = 0.02  # of a brick's length: displacement of blocks that leave

HEAD = """title = "wall"
analysis = {{ {analysis} }}
contact = {{ friction_angle = {friction!r}{contact} }}
output = {{ every = 1000000 }}
material = [{{ name = "stone", density = 2500, young_modulus = 1e10, poisson_ratio = 0.2 }}]
block = [
  {{ name = "ground", fixed = true, box = {{ min = [-9, -9, -1], max = [9, 9, 0] }} }},
"""


def wall_of(random_numbers):
    """A wall: its boxes, friction angle (degrees), direction and kind of load."""
    r = random_numbers
    while True:
        length, height, depth = r.uniform(0.3, 0.6), r.uniform(0.12, 0.3), r.uniform(0.15, 0.35)
        running, courses, of_bricks = r.random() < 0.67, r.randint(3, 7), r.choice([2, 2.5, 3, 3.5, 4, 4.5])
        boxes, whole = [], length * of_bricks
        for course in range(courses):
            shift = 0.5 if running and course % 2 else 1.0
            edges = [0.0]
            while (shift + len(edges) - 1) * length < whole * (1 - 1e-9):
                edges.append((shift + len(edges) - 1) * length)
            edges.append(whole)
            boxes += [((a, 0.0, course * height), (b, depth, (course + 1) * height)) for a, b in zip(edges, edges[1:])]
        if 9 <= len(boxes) <= 36:
            break
    in_plane = r.random() < 0.67
    side = (1.0, 0.0, 0.0) if in_plane else (0.0, 1.0, 0.0)
    if r.random() < 0.5:
        side = tuple(-x for x in side)
    friction = r.uniform(25.0, 45.0)
    arm = (whole if in_plane else depth) / (courses * height)
    tilt = r.uniform(0.4, 0.9) * min(math.tan(math.radians(friction)), arm)
    return {"boxes": boxes, "friction": friction, "side": side, "length": length, "tilt": tilt,
            "kind": r.choice(["capacity", "factor-of-safety"]), "in_plane": in_plane, "running": running}


def scene_of(wall, analysis, order, friction, history=None, contact=""):
    text = HEAD.format(analysis=analysis, friction=friction, contact=contact)
    for number, (low, high) in enumerate(wall["boxes"]):
        text += f'  {{ name = "b{number}", material = "stone", order = {order}, box = {{ min = {list(low)}, max = {list(high)} }}'
        if wall["kind"] == "capacity":
            weight = DENSITY * G * math.prod(b - a for a, b in zip(low, high))
            place, force = [0.5 * (a + b) for a, b in zip(low, high)], [weight * x for x in wall["side"]]
            when = f", history = {history}" if history else ""
            text += f", load = [{{ point = {place}, force = {force}{when} }}]"
        text += " },\n"
    return text + "]\n"


def gravity_of(wall):
    share = wall["tilt"] if wall["kind"] != "capacity" else 0.0
    return [share * G * wall["side"][0], share * G * wall["side"][1], -G]


def run(program, folder, name, text):
    """@return the summary, or the message of a run without one"""
    scene, out = folder / f"{name}.toml", folder / f"{name}.out"
    scene.write_text(text)
    done = subprocess.run([program, "run", scene, "--out", out, "--force", "--quiet"], capture_output=True, text=True)
    try:
        return json.loads((out / "summary.json").read_text())
    except FileNotFoundError:
        return {"status": "failed", "message": done.stderr[-300:]}


def leaves(program, folder, wall, factor, order):
    """True if motion under a factor leaves its place; None: there is no motion to judge by."""
    friction, history = wall["friction"], None
    if wall["kind"] == "capacity":
        history = [[0, 0], [GROWN, factor], [END, factor]]
    else:
        friction = math.degrees(math.atan(math.tan(math.radians(friction)) / factor))
    analysis = (f'type = "dynamic", initial_state = "static", end_time = {END}, time_step = {STEP}, '
                f'gravity = {gravity_of(wall)}')
    summary = run(program, folder, f"motion_{order}", scene_of(wall, analysis, order, friction, history, ", augmented = false"))
    if summary["status"] != "completed" or "largest_displacement" not in summary:
        return None
    return summary["largest_displacement"]["value"] > LEAVES * wall["length"]


def judged(program, folder, wall, lower, upper):
    """@return problems of an answer: "moves below", "stands above" """
    below = [leaves(program, folder, wall, BELOW * lower, order) for order in (0, 1)] if lower else []
    above = [leaves(program, folder, wall, ABOVE * upper, order) for order in (0, 1)] if upper else []
    told = [value for value in below if value is not None]
    capacity = wall["kind"] == "capacity"
    problems = []
    if told and (any(told) if capacity else all(told)):
        problems.append("moves below")
    if capacity and above and not any(value is not False for value in above):
        problems.append("stands above")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--no-motion", action="store_true")
    arguments = parser.parse_args()
    unsafe = loose = open_ = 0
    longest = 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(arguments.seed, arguments.seed + arguments.count):
            wall = wall_of(random.Random(seed))
            analysis = f'type = "{wall["kind"]}", method = "limit", gravity = {gravity_of(wall)}'
            began = time.monotonic()
            summary = run(arguments.program, folder, "wall", scene_of(wall, analysis, 0, wall["friction"]))
            seconds = time.monotonic() - began
            longest = max(longest, seconds)
            found = summary.get("load_factor") or summary.get("factor_of_safety") or {}
            lower, upper = found.get("lower"), found.get("upper")
            problems = [] if summary["status"] == "completed" else ["no answer"]
            open_ += len(problems)
            if not problems and not arguments.no_motion:
                problems = judged(arguments.program, folder, wall, lower, upper)
            unsafe += "moves below" in problems
            loose += "stands above" in problems
            print(f'{seed}: {len(wall["boxes"])} bricks, {wall["kind"]}, {"in" if wall["in_plane"] else "out of"} plane, '
                  f'{lower} to {upper}, associated {found.get("associated")}, {seconds:.1f} s {", ".join(problems)}',
                  flush=True)
    print(f"{arguments.count} walls: {open_} without an answer, {unsafe} move below, {loose} stand above, "
          f"at most {longest:.1f} s")
    sys.exit(1 if unsafe or open_ or loose > 0.1 * arguments.count else 0)


if __name__ == "__main__":
    main()
