#!/usr/bin/env python3
"""Random rock slopes: factors of safety of the limit method against motion from rest.

    python3 tests/networks/limits.py --program build/release/apps/ashlar --out /tmp/limits.out --seed 1 --count 30
    python3 tests/networks/limits.py --references          # only the references, no factors of safety

Each network is a slope of rigid blocks between fixed ground, back and walls, cut by 2 to 4 sets of joints with friction.
Its reference is the least factor by which friction is divided at which a block sets off: two steps of motion from rest,
without forces of contact at the start. As outcomes may alternate, factors are tried from below, then bisected to 0.5 %.
Scenes and references are kept in the folder and used again. A block that nothing else holds (`ashlar blocks --removable`)
is a second bound. Where it is below the reference by more than 1 %, motion is "jammed"; there, and where runs fail ("no
reference"), factors are held against upper bounds only, and the row says so.

Exit status: 0 no factor fails what it could be compared with, which for jammed networks is upper bounds only; 1 some do.
"""
import argparse
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

STEP, STEPS = 1e-3, 2  # s, of motion: steps of 10 ms need ten times the iterations
SETS_OFF = 5e-4  # displacement of a block over that of free fall; 0.2 % above the factor of known slopes it is passed
LEAST, MOST = 0.15, 5.0  # factors; networks that move at the first or stand up to the last are drawn again
COARSE, FINE, BRACKET = 1.1, 1.025, 1.005
MOST_REJECTED, MOST_FAILED, MOST_SECONDS = 6, 6, 30.0  # steps of a run, runs of a network, seconds of a run
TOLERANCE, REMOVABLE_TOLERANCE = 0.01, 0.005  # of released factors
MOVING = 20, 60  # blocks

SCENE = """title = "{title}"
parameters = {{ factor = 1.0 }}
analysis = {{ type = "dynamic", end_time = {end}, time_step = {step}, initial_state = "as-placed" }}
contact = {{ friction_angle = {rest}, augmented = true, penetration_tolerance = 1e-10 }}
material = [{{ name = "rock", density = 2600, young_modulus = 1e10, poisson_ratio = 0.25 }}]
output = {{ every = 1000000, fields = ["displacement"] }}
cut = [
{cuts}]
joint = [
{joints}]
block = [
  {{ name = "ground", fixed = true, box = {{ min = [{behind}, -2, -2], max = [6, {beyond}, 0] }} }},
  {{ name = "back", fixed = true, box = {{ min = [{behind}, -2, 0], max = [{back}, {beyond}, {height}] }} }},
  {{ name = "right", fixed = true, box = {{ min = [{back}, -2, 0], max = [2, 0, {height}] }} }},
  {{ name = "left", fixed = true, box = {{ min = [{back}, {width}, 0], max = [2, {beyond}, {height}] }} }},
  {{ name = "rock", material = "rock", order = 0, hull = {{ points = [
    [0, 0, 0], [{crest}, 0, {height}], [{back}, 0, {height}], [{back}, 0, 0],
    [0, {width}, 0], [{crest}, {width}, {height}], [{back}, {width}, {height}], [{back}, {width}, 0]] }} }},
]
"""


def scene_of(title, shape, sets, rest):
    """@param sets name, dip, direction, point, spacing, persistence, friction angle, more; @param rest other friction"""
    (height, width, length, crest), cuts, joints = shape, "", ""
    weakened, least = '"= atan(tan({:.6g}*deg)/factor)/deg"'.format, height * width * length / 2000
    for name, dip, direction, point, spacing, persistence, friction, more in sets:
        cuts += (f'  {{ name = "{name}", blocks = ["rock"], dip = {dip:.6g}, dip_direction = {direction % 360:.6g}, '
                 f"point = [{', '.join(f'{x:.6g}' for x in point)}], spacing = {spacing:.6g}, "
                 f"persistence = {persistence:.3g}, min_volume = {least:.3g}{more} }},\n")
        joints += f'  {{ cut = "{name}", friction_angle = {weakened(friction)} }},\n'
    return SCENE.format(title=title, end=STEP * STEPS, step=STEP, rest=weakened(rest), cuts=cuts, joints=joints,
                        behind=-length - 3, beyond=width + 2, back=-length, height=height, width=width, crest=-crest)


def random_slope(numbers, kind, scale):
    """@return shape and sets; the face looks east. The same draws whatever the scale of the spacings."""
    u = numbers.uniform
    height, width, length = 10.0, u(8, 12), u(13, 17)
    crest = height / math.tan(math.radians(u(60, 82)))
    friction = sorted(u(20, 45) for _ in range(4))
    numbers.shuffle(friction)
    if numbers.random() < 0.4:
        friction = [friction[0]] * 4
    drawn = {
        "wedge": [("left", u(42, 66), 90 - u(25, 60), u(3, 4.5), 1), ("right", u(42, 66), 90 + u(25, 60), u(3, 4.5), 1),
                  ("flat", u(0, 18), u(0, 360), u(4, 6), 1), ("steep", u(70, 88), 270 + u(-20, 20), u(5, 7), 0.8)],
        "plane": [("bedding", u(22, 42), 90 + u(-20, 20), u(2.5, 3.5), 1),
                  ("steep", u(62, 86), 270 + u(-20, 20), u(3, 4.5), 1), ("cross", u(75, 90), u(-15, 15), u(4, 6), 1)],
        "topple": [("columns", u(62, 82), 270 + u(-12, 12), u(1.3, 2.2), 1),
                   ("base", u(12, 32), 90 + u(-12, 12), u(4, 6), 1), ("cross", u(80, 90), u(-10, 10), u(5, 7), 0.7)],
        "steps": [("bedding", u(22, 40), 90 + u(-25, 25), u(2.2, 3.2), 1),
                  ("risers", u(68, 90), 90 + u(-25, 25), u(2.5, 4), 0.6), ("cross", u(75, 90), u(-15, 15), u(5, 7), 0.8)],
    }[kind]
    if numbers.random() < (0.4 if kind == "wedge" else 0.35):
        drawn.pop()
    drawn[2:3] = drawn[2:3] if kind != "wedge" or numbers.random() >= 0.3 else []
    sets = [(name, dip, direction, (-u(0, 4), u(0, width), u(0.3, 2.5)), spacing * scale, persistence, angle,
             f", seed = {numbers.randrange(1000)}")
            for (name, dip, direction, spacing, persistence), angle in zip(drawn, friction)]
    return (height, width, length, crest), sets, u(20, 45)


def summary_of(options, scene, settings, seconds=MOST_SECONDS):
    """@return summary.json of a run, or None where it failed; the messages"""
    folder = os.path.join(options.out, "run.out")
    shutil.rmtree(folder, ignore_errors=True)
    command = [options.program, "run", scene, "--out", folder, "--quiet", *(f"--set={setting}" for setting in settings)]
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None, f"not done in {seconds:g} s"
    if result.returncode != 0:
        return None, result.stderr.strip()[-300:]
    return json.loads(pathlib.Path(folder, "summary.json").read_text("utf-8")), ""


class Motion:
    """True for factors at which blocks of a scene begin to move."""

    def __init__(self, options, scene):
        self.options, self.scene, self.moving, self.runs, self.rejected, self.failed = options, scene, "", 0, 0, []

    def sets_off(self, factor):
        """@return None where the run fails or cuts steps again and again"""
        self.runs += 1
        summary, _ = summary_of(self.options, self.scene, [f"parameters.factor={factor!r}"])
        if summary is None or summary["status"] != "completed" or summary["rejected_steps"]["count"] > MOST_REJECTED:
            self.failed.append(factor)
            return None
        self.rejected += summary["rejected_steps"]["count"]
        largest = summary["largest_displacement"]
        if largest["value"] <= SETS_OFF * 9.81 * summary["time"] ** 2 / 2:
            return False
        self.moving = largest["block"]
        return True

    def least(self):
        """@return a bracket of the least factor that moves, 0.5 % wide unless runs fail; None: there is none"""
        if self.sets_off(LEAST) is not False:
            return None
        stands, moves = LEAST, MOST
        for ratio in COARSE, FINE:
            factor = stands * ratio
            while factor < moves and len(self.failed) < MOST_FAILED:
                answer = self.sets_off(factor)
                if answer is not None:
                    stands, moves = (stands, factor) if answer else (factor, moves)
                factor *= ratio
            if moves == MOST:
                return None
        while moves > stands * BRACKET:
            factor = math.sqrt(stands * moves)
            answer = self.sets_off(factor)
            if answer is None:
                break
            stands, moves = (stands, factor) if answer else (factor, moves)
        return stands, moves


def network_of(options, scene, title, kind, seed):
    """Writes a scene. @return report of its blocks, or None where there are too few or too many"""
    scale = 1.0
    for _ in range(12):
        pathlib.Path(scene).write_text(scene_of(title, *random_slope(random.Random(seed), kind, scale)), "utf-8")
        result = subprocess.run([options.program, "blocks", scene, "--removable", "0,0,-1", "--json", "--out",
                                 os.path.join(options.out, "blocks.out")], capture_output=True, text=True, check=False)
        report = json.loads(result.stdout) if result.returncode == 0 else {"count": 0}
        if MOVING[0] <= report["count"] - 4 <= MOVING[1]:
            return report
        scale *= 1.12 if report["count"] - 4 > MOVING[1] else 1 / 1.12
    return None


def reference_of(options, name, kind):
    """Draws slopes until one has enough blocks, stands with the largest strength and moves with the least."""
    scene, started = os.path.join(options.out, name + ".toml"), time.time()
    for attempt in range(40):
        report = network_of(options, scene, f"{name}: {kind}", kind, f"{options.seed} {name} {attempt}")
        motion = Motion(options, scene)
        bracket = motion.least() if report else None
        if bracket:
            keys = [(block["key"]["factor_of_safety"], block["name"]) for block in report["blocks"] if "key" in block
                    and block["key"]["removable"] and block["key"]["mode"] != "stable"]
            removable, alone = min((key for key in keys if key[0] is not None), default=(None, ""))
            (stands, moves), blocks = bracket, report["count"] - 4
            return {"kind": kind, "blocks": blocks, "stands": stands, "moves": moves, "removable": removable,
                    "exists": moves <= stands * 1.01 and min(motion.failed, default=MOST) > stands, "alone": alone,
                    "jammed": removable is not None and removable < 0.99 * stands, "moving": motion.moving,
                    "attempt": attempt, "runs": motion.runs, "rejected": motion.rejected, "failed": motion.failed,
                    "seconds": round(time.time() - started, 1)}
    raise SystemExit(f"{name}: no network in 40 attempts")


def number(value):
    return f"{value:.4f}" if isinstance(value, (int, float)) else str(value or "-")


def text_of(name, of):
    bracket = f"{of['stands']:.4f}-{of['moves']:.4f}" if of["exists"] else "no reference"
    return f"{name} {of['kind']:6s} {of['blocks']:3d} blocks  {bracket:13s}{' jammed' if of['jammed'] else ''}"


def compared(options, name, of):
    """@return text of a row, whether it passes"""
    started, faults = time.time(), []
    summary, said = summary_of(options, os.path.join(options.out, name + ".toml"), [
        'analysis.type="factor-of-safety"', "analysis.method=limit", "analysis.safety.tolerance=0.002"], 600)
    seconds, answer = time.time() - started, (summary or {}).get("factor_of_safety") or {}
    released, numbers = answer.get("released"), [number(answer.get(k)) for k in ("lower", "upper", "associated")]
    if not isinstance(released, (int, float)):
        faults.append(said or "no released factor")
    else:
        above, below = 100 * (released / of["moves"] - 1), 100 * (1 - released / of["stands"])
        if of["exists"] and above > 100 * TOLERANCE:
            faults.append(f"{above:.1f} % ABOVE")
        if of["exists"] and not of["jammed"] and below > 100 * TOLERANCE:
            faults.append(f"{below:.1f} % below")
        if of["removable"] is not None and released > of["removable"] * (1 + REMOVABLE_TOLERANCE):
            faults.append(f"ABOVE {of['alone']} alone, {of['removable']:.4f}")
    passed = "ok" if of["exists"] and not of["jammed"] else "not above upper bounds, NOT COMPARED else"
    return (f"{text_of(name, of)}  released {number(released)} [{numbers[0]}, {numbers[1]}]  associated {numbers[2]}"
            f"  {seconds:.1f} s  {'; '.join(faults) or passed}"), not faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/apps/ashlar")
    parser.add_argument("--out", default="/tmp/limits.out", help="folder of scenes and references")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=30, help="networks")
    parser.add_argument("--references", action="store_true", help="stop when there are references")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    cache, failed = pathlib.Path(options.out, f"references_{options.seed}.json"), 0
    references = json.loads(cache.read_text("utf-8")) if cache.exists() else {}
    for index in range(options.count):
        name, kind = f"limits_{options.seed}_{index:02d}", ("wedge", "plane", "topple", "steps")[index % 4]
        if name not in references:
            references[name] = reference_of(options, name, kind)
            cache.write_text(json.dumps(references, indent=1), "utf-8")
        of = references[name]
        row, passes = compared(options, name, of) if not options.references else (
            f"{text_of(name, of)}  {of['moving']}, alone {number(of['removable'])} {of['alone']}, {of['runs']} runs, "
            f"{of['rejected']} steps rejected, {len(of['failed'])} failed, {of['seconds']} s", True)
        print(row, flush=True)
        failed += not passes
    both = sum(of["exists"] and not of["jammed"] for of in list(references.values())[:options.count])
    verdict = "nothing compared" if options.references else f"{failed or 'none'} of {options.count} fail"
    print(f"{verdict}, {both} have references from both sides")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
