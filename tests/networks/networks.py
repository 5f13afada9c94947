#!/usr/bin/env python3
"""Random joint networks: cuts a cube by 3 to 6 sets of joints and checks that the blocks fill it.

    python3 tests/networks/networks.py --program build/release/apps/ashlar --out /tmp/networks.out --seed 1 --count 20
    python3 tests/networks/networks.py --growth            # time and memory of one network with more and more blocks
    python3 tests/networks/networks.py --special           # sets with a common line, planes through corners and edges, ...

Exit status: 0 all networks pass, 1 some fail, 2 wrong usage.
"""
import argparse
import collections
import itertools
import json
import math
import os
import random
import resource
import shutil
import subprocess
import sys

SIDE = 10.0  # m, of the cube
MOST_SECONDS = 10.0  # of processor time, for cutting and measuring 10,000 blocks
VOLUME_ERROR = 1e-12  # of the sum

HEAD = """[analysis]
end_time = 1e-4
time_step = 1e-4
gravity = [0, 0, -9.81]
[contact]
friction_angle = 35
[[material]]
name = "rock"
density = 2700
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "rock"
material = "rock"
order = {order}
box = {{ min = [0, 0, 0], max = [{side}, {side}, {side}] }}
"""


def normal_of(dip, direction):
    """Upward unit normal: x east, y north, z up."""
    d, a = math.radians(dip), math.radians(direction)
    return math.sin(d) * math.sin(a), math.sin(d) * math.cos(a), math.cos(d)


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


def expected_blocks(normals, spacing):
    """1 + planes + lines + points in the cube, as each cell of an arrangement in a convex body counts for one of them."""
    planes = sum(SIDE * sum(map(abs, n)) / spacing for n in normals)
    points = sum(abs(determinant(*three)) for three in itertools.combinations(normals, 3)) * (SIDE / spacing) ** 3
    lines = 0.0
    for a, b in itertools.combinations(normals, 2):
        cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        # The area of the cube's shadow along the line, times lines per area across them.
        lines += SIDE ** 2 * sum(map(abs, cross)) / spacing ** 2
    return 1 + planes + lines + points


def random_network(numbers, sets, blocks):
    """@return a list of (dip, dip direction, point), and the spacing that gives about so many blocks"""
    network = []
    for _ in range(sets):
        point = [SIDE * numbers.random() for _ in range(3)]
        network.append((math.degrees(math.acos(numbers.random())), 360 * numbers.random(), point))
    normals = [normal_of(dip, direction) for dip, direction, _ in network]
    low, high = 1e-3 * SIDE, 10 * SIDE
    while high > low * (1 + 1e-9):
        middle = math.sqrt(low * high)
        if expected_blocks(normals, middle) > blocks:
            low = middle
        else:
            high = middle
    return network, high


def scene_of(network, spacing, order=0, min_volume=0.0):
    text = HEAD.format(side=SIDE, order=order)
    for k, (dip, direction, point) in enumerate(network):
        text += (f'[[cut]]\nname = "set {k + 1}"\nblocks = ["rock"]\ndip = {dip!r}\ndip_direction = {direction!r}\n'
                 f"point = {point}\nspacing = {spacing!r}\nmin_volume = {min_volume!r}\n")
    return text


def run(command):
    """@return exit status, output, messages on stderr, seconds of processor time"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        out, said = child.communicate()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return child.returncode, out, said, seconds


def write_scene(options, name, text):
    path = os.path.join(options.out, name + ".toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def faults_of(report):
    """Mismatches between the blocks of a scene, by the numbers of `ashlar blocks --json` alone."""
    faults = []
    error = abs(math.fsum(block["volume"] for block in report["blocks"]) / SIDE ** 3 - 1)
    if error > VOLUME_ERROR:
        faults.append(f"volumes add up to {error:.2g} too much or too little")
    if min(block["volume"] for block in report["blocks"]) <= 0:
        faults.append("a block without volume")
    areas = collections.defaultdict(float)
    for block in report["blocks"]:
        for neighbour in block["neighbours"]:
            areas[block["name"], neighbour["block"], neighbour["cut"]] += neighbour["area"]
    for (a, b, cut), area in areas.items():
        if areas.get((b, a, cut)) != area:
            faults.append(f"{a} and {b} do not share the same face of {cut}")
            break
    return faults


def try_network(options, name, text):
    """@return dict: blocks, seconds, faults"""
    scene = write_scene(options, name, text)
    status, out, said, seconds = run([options.program, "blocks", scene, "--json"])
    if status != 0:
        return {"blocks": 0, "seconds": seconds, "faults": [f"blocks: exit status {status}: {said.strip()}"]}
    report = json.loads(out)
    result = {"blocks": report["count"], "seconds": seconds, "faults": faults_of(report)}
    if seconds > MOST_SECONDS * max(1.0, report["count"] / 1e4):
        result["faults"].append(f"takes {seconds:.1f} s")
    if options.run:
        folder = os.path.join(options.out, name + ".out")
        shutil.rmtree(folder, ignore_errors=True)
        status, _, said, result["run"] = run([options.program, "run", scene, "--out", folder, "--quiet",
                                              "--set", "analysis.memory_limit=2e10"])
        if status != 0:
            result["faults"].append(f"run: exit status {status}: {said.strip()[:500]}")
        shutil.rmtree(folder, ignore_errors=True)
    return result


def random_networks(options):
    failed = 0
    for index in range(options.count):
        numbers = random.Random(f"{options.seed} {index}")
        sets = 3 + index % 4
        network, spacing = random_network(numbers, sets, options.blocks)
        result = try_network(options, f"network_{options.seed}_{index:02d}", scene_of(
            network, spacing, options.order, options.min_volume * SIDE ** 3 / options.blocks))
        ran = f", run {result['run']:.1f} s" if "run" in result else ""
        print(f"{index:3d}: {sets} sets, {result['blocks']} blocks, {result['seconds']:.2f} s{ran}: "
              f"{'; '.join(result['faults']) or 'ok'}", flush=True)
        failed += bool(result["faults"])
    return failed


def growth(options):
    """The exponent of time and memory over the number of blocks, from 4,000 on."""
    points = []
    for blocks in (1000, 4000, 16000, 64000):
        numbers = random.Random(options.seed)
        network, spacing = random_network(numbers, 4, blocks)
        scene = write_scene(options, f"growth_{blocks}", scene_of(network, spacing))
        command = ["/usr/bin/time", "-f", "%M", options.program, "blocks", scene, "--json"]
        status, out, said, seconds = run(command)
        if status != 0:
            print(f"exit status {status}: {said}")
            return 1
        megabytes = int(said.split()[-1]) / 1024
        points.append((json.loads(out)["count"], seconds, megabytes))
        print("{} blocks: {:.2f} s, {:.0f} MB".format(*points[-1]), flush=True)
    (n, s, m), (n2, s2, m2) = points[1], points[-1]
    power = math.log(s2 / s) / math.log(n2 / n), math.log(m2 / m) / math.log(n2 / n)
    print(f"time grows with the {power[0]:.2f}th, memory with the {power[1]:.2f}th power of the blocks")
    return int(max(power) > 1.25)


def special_networks():
    """Name, cuts, and how many blocks there are, or None where it may be refused with the cut's name."""
    middle = [SIDE / 2] * 3
    corner = [0.0] * 3
    tilted = math.degrees(math.atan(math.sqrt(2)))  # the plane x + y + z = const, as nearly as degrees say it

    def cut(dip, direction, point, spacing=None):
        text = f"dip = {dip!r}\ndip_direction = {direction!r}\npoint = {point}\n"
        return text + (f"spacing = {spacing!r}\n" if spacing else "")

    yield "three planes through a line along an axis", [cut(90, a, middle) for a in (0, 30, 60)], 6
    yield "eight planes through a line along an axis", [cut(90, 22.5 * k, middle) for k in range(8)], 16
    yield "planes through corners", [cut(tilted, 45, corner), cut(tilted, 45, [SIDE] * 3)], 1
    yield "planes through opposite edges", [cut(45, 0, [0, 0, SIDE]), cut(45, 180, corner)], 4
    yield "planes through edges", [cut(45, 0, [0, 0, SIDE]), cut(90, 0, corner), cut(0, 0, corner)], 2
    yield "planes in faces", [cut(0, 0, corner), cut(90, 90, [SIDE] * 3), cut(90, 0, corner)], 1
    yield "planes that miss", [cut(30, 40, [0, 0, 100.0]), cut(90, 10, [-50.0, 0, 0])], 1
    yield "spacing of 1e-9 of the cube", [cut(30, 40, middle, 1e-9 * SIDE)], None
    yield "two planes 1e-9 of the cube apart", [cut(30, 40, middle), cut(30, 40, [5, 5, 5 + 1e-8])], 3
    yield "three sets through one tilted line", [cut(30, 0, middle, 2.0), cut(50, 0, middle, 2.0),
                                                 cut(70, 0, middle, 2.0)], None
    yield "a set twice", [cut(37, 110, middle, 1.5), cut(37, 110, middle, 1.5)], None


def special(options):
    failed = 0
    for index, (name, cuts, blocks) in enumerate(special_networks()):
        text = HEAD.format(side=SIDE, order=1)
        for k, lines in enumerate(cuts):
            text += f'[[cut]]\nname = "set {k + 1}"\nblocks = ["rock"]\n{lines}'
        result = try_network(options, f"special_{index}", text)
        faults = result["faults"]
        refused = len(faults) == 1 and "exit status 2" in faults[0] and "set " in faults[0]
        wrong = blocks is not None and result["blocks"] != blocks
        if blocks is None and refused:
            verdict = faults[0]
        elif wrong or faults:
            verdict = f"WRONG, {blocks} blocks expected; " + "; ".join(faults)
            failed += 1
        else:
            verdict = "ok"
        print(f"{name}: {result['blocks']} blocks: {verdict}", flush=True)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--out", default="/tmp/networks.out", help="folder of scenes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20, help="networks")
    parser.add_argument("--blocks", type=int, default=10000, help="in each, about")
    parser.add_argument("--order", type=int, default=0, help="of the blocks of the run")
    parser.add_argument("--min-volume", type=float, default=0.0,
                        help="smaller pieces are glued, of the mean volume")
    parser.add_argument("--run", action="store_true", help="take one step with each, too: 20 s each")
    parser.add_argument("--growth", action="store_true")
    parser.add_argument("--special", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    if options.growth:
        failed = growth(options)
    elif options.special:
        failed = special(options)
    else:
        failed = random_networks(options)
    print("all right" if failed == 0 else f"{failed} fail")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
