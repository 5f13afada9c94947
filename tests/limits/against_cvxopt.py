#!/usr/bin/env python3
"""Load factors of random dry walls by limit analysis against cvxopt's interior point method.

    python3 tests/limits/against_cvxopt.py build/release/apps/ashlar [--count 6] [--seed 1]

A wall of boxes with joints at random on fixed ground bears its weight, and a few point loads that are multiplied. Corners of the
overlaps, equations of balance and friction cones are set up here, from the boxes alone. cvxopt's largest factor has to lie in
the associated bracket of `ashlar run`, and the released factor must not exceed it.

Exit status: 0 all agree, 1 some do not, 77 cvxopt is not there.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

try:
    import cvxopt
except ImportError:
    sys.exit(77)

GRAVITY, DENSITY = 9.81, 2000.0
TOLERANCE = 1e-3  # of the bracket
AGREES = 1e-4  # relative: both programmes end with a gap


def wall(numbers):
    """@return boxes ((x0, x1), (y0, y1), (z0, z1)), the ground first; loads (box, point, force); friction"""
    height, depth, z = numbers.uniform(0.2, 0.5), numbers.uniform(0.4, 0.8), 0.0
    boxes = [((-5.0, 15.0), (-5.0, 5.0), (-1.0, 0.0))]
    for _ in range(numbers.randint(3, 6)):
        joints = [0.0, numbers.uniform(0.6, 1.2), numbers.uniform(1.8, 2.4), 3.0]
        boxes += [((left, right), (0.0, depth), (z, z + height)) for left, right in zip(joints, joints[1:])]
        z += height
    loads = []
    for box in numbers.sample(range(1, len(boxes)), 3):
        (x0, x1), (y0, _), (z0, z1) = boxes[box]
        weight = DENSITY * GRAVITY * (x1 - x0) * depth * height
        direction = [numbers.gauss(0, 1), abs(numbers.gauss(0, 1)), 0.3 * numbers.gauss(0, 1)]
        size = 0.1 * weight / math.sqrt(sum(d * d for d in direction))
        loads.append((box, ((x0 + x1) / 2, y0, (z0 + z1) / 2), [size * d for d in direction]))
    return boxes, loads, numbers.uniform(0.4, 0.9)


def contacts(boxes):
    """Corners of overlaps. @return (first box, second box, place, normal out of the second, two tangents)"""
    found = []
    for a, first in enumerate(boxes):
        for b in range(a + 1, len(boxes)):
            for axis in range(3):
                for one, other, lower in ((a, b, boxes[b]), (b, a, first)):
                    upper = boxes[one]
                    if abs(upper[axis][0] - lower[axis][1]) > 1e-12:
                        continue
                    across = [k for k in range(3) if k != axis]
                    spans = [(max(upper[k][0], lower[k][0]), min(upper[k][1], lower[k][1])) for k in across]
                    if any(low >= high - 1e-12 for low, high in spans):
                        continue
                    unit = [[float(k == j) for j in range(3)] for k in range(3)]
                    center = [sum(span) / 2 for span in spans]
                    share = twist_share(*(high - low for low, high in spans))
                    for u in spans[0]:
                        for v in spans[1]:
                            place, rubs = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
                            place[axis] = rubs[axis] = upper[axis][0]
                            for k, c, value in zip(across, center, (u, v)):
                                place[k], rubs[k] = value, c + share * (value - c)
                            found.append((one, other, place, rubs, unit[axis], unit[across[0]], unit[across[1]]))
    return found


def twist_share(a, b):
    """Mean distance of a rectangle's points from its middle, over that of its corners."""
    p, q = a / 2, b / 2
    mean = math.hypot(p, q) / 3 + p * p / (6 * q) * math.asinh(q / p) + q * q / (6 * p) * math.asinh(p / q)
    return mean / math.hypot(p, q)


def wrench(force, place, middle):
    r = [place[k] - middle[k] for k in range(3)]
    return [*force, r[1] * force[2] - r[2] * force[1], r[2] * force[0] - r[0] * force[2],
            r[0] * force[1] - r[1] * force[0]]


def largest_factor(boxes, loads, friction):
    """The load that both programmes balance: with friction in the corners, and with the twisting resistance of uniform pressure."""
    return min(largest_factor_of(boxes, loads, friction, near) for near in (False, True))


def largest_factor_of(boxes, loads, friction, nearer):
    points = contacts(boxes)
    count = 3 * len(points) + 1
    middle = [[(low + high) / 2 for low, high in box] for box in boxes]
    balance, right = cvxopt.matrix(0.0, (6 * (len(boxes) - 1), count)), cvxopt.matrix(0.0, (6 * (len(boxes) - 1), 1))
    unit = DENSITY * GRAVITY  # of forces, so that numbers are near 1

    def add(box, column, force, place):
        if box > 0:
            for k, value in enumerate(wrench(force, place, middle[box])):
                balance[6 * (box - 1) + k, column] += value

    for n, (one, other, place, rubs, *frame) in enumerate(points):
        for k, direction in enumerate(frame):
            at = rubs if nearer and k > 0 else place
            add(one, 3 * n + k, direction, at)
            add(other, 3 * n + k, [-d for d in direction], at)
    for box, place, force in loads:
        add(box, count - 1, [f / unit for f in force], place)
    for box in range(1, len(boxes)):
        volume = math.prod(high - low for low, high in boxes[box])
        right[6 * (box - 1) + 2] = volume
    cones = []
    for n in range(len(points)):
        cone = cvxopt.spmatrix([-friction, -1.0, -1.0], [0, 1, 2], [3 * n, 3 * n + 1, 3 * n + 2], (3, count))
        cones.append(cone)
    cost = cvxopt.matrix(0.0, (count, 1))
    cost[count - 1] = -1.0
    cvxopt.solvers.options.update({"show_progress": False, "abstol": 1e-9, "reltol": 1e-9, "feastol": 1e-9})
    answer = cvxopt.solvers.socp(cost, Gq=cones, hq=[cvxopt.matrix(0.0, (3, 1))] * len(points),
                                 A=cvxopt.sparse(balance), b=right, kktsolver="ldl")
    return answer["x"][count - 1]


def scene_of(boxes, loads, friction):
    text = (f"[analysis]\ntype = \"capacity\"\nmethod = \"limit\"\ncapacity = {{ lower = 0.01, upper = 1000, tolerance = "
            f"{TOLERANCE} }}\n[contact]\nfriction_angle = {math.degrees(math.atan(friction))!r}\n[[material]]\n"
            f"name = \"stone\"\ndensity = {DENSITY}\nyoung_modulus = 1e10\npoisson_ratio = 0.2\n")
    for n, box in enumerate(boxes):
        text += (f"[[block]]\nname = \"b{n}\"\n" + ("fixed = true\n" if n == 0 else "material = \"stone\"\norder = 0\n")
                 + f"box = {{ min = {[low for low, _ in box]}, max = {[high for _, high in box]} }}\n")
        for loaded, place, force in loads:
            if loaded == n:
                text += f"[[block.load]]\npoint = {list(place)}\nforce = {force}\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for n in range(options.count):
            boxes, loads, friction = wall(random.Random(f"{options.seed} {n}"))
            scene, out = pathlib.Path(folder, "wall.toml"), pathlib.Path(folder, "out")
            scene.write_text(scene_of(boxes, loads, friction), "utf-8")
            subprocess.run([options.program, "run", scene, "--out", out, "--force", "--quiet"], check=True)
            answer = json.loads((out / "summary.json").read_text("utf-8"))["load_factor"]
            expected = largest_factor(boxes, loads, friction)
            lower, upper = answer["associated_bracket"]
            agrees = lower * (1 - AGREES) <= expected <= upper * (1 + AGREES) and answer["upper"] <= upper * (1 + AGREES)
            failed += not agrees
            print(f"{len(boxes) - 1} bricks, friction {friction:.3f}: cvxopt {expected:.6g}, associated {lower:.6g} to "
                  f"{upper:.6g}, released {answer['released']:.6g}: {'ok' if agrees else 'NO'}", flush=True)
    sys.exit(1 if failed else 0)


main()
