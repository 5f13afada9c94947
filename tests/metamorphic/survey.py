#!/usr/bin/env python3
"""Every demo scene in the coordinates of a survey: moved far from the origin it has the same verdict, the same iterations
and the same answers, in the coordinates of the user, as at the origin with its coordinates rounded alike.

    python3 tests/metamorphic/survey.py --program build/release/apps/ashlar
    python3 tests/metamorphic/survey.py --program build/release/apps/ashlar --scene bolted_roof --whole

Demos are shortened as in tests/endurance/kinds.json; --whole runs them to their ends.
Exit status: 0 all are the same, 1 some are not, 2 wrong usage.
"""
import argparse
import concurrent.futures
import copy
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

import metamorphic

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "data/scenes"
SHIFTS = {"UTM": (5e5, 5.3e6, 400.0), "1e7 m": (1e7, 1e7, 1e7)}
LENGTH_SHARE = 1e-9  # of the size of the model
OTHER_SHARE = 1e-4   # of the largest value of such columns; forces within the tolerance of contact iterations
ITERATIONS = 0.02    # share of their number, and one
# Shares of lengths, and of other values, of scenes that are not the same scene far away.
OTHER_SCENES = {"wedge": (1e-6, 1e-2)}  # there the faces of its hulls, flat to nine digits, are flat to rounding
# Columns with one unit, which have one largest value.
FAMILIES = [re.compile(pattern) for pattern in (
    r"momentum\.[xyz]$", r"angular_momentum\.[xyz]$", r"energy\.", r".*\.s[xyz][xyz]$", r".*\.v[xyz]$", r".*\.u[xyz]$", r".*\.r[xyz]$",
    r".*\.(axial|shear|normal)_force$")]
# Rounding decides the state of a point at a limit.
STATES = re.compile(r"contacts\.(open|locked|sliding)$|open_close\.iterations$")
# Energy against gravity and angular momentum are about the origin of the model.
ABOUT_ORIGIN = re.compile(r"energy\.gravity|angular_momentum\.[xyz]|energy\.(residual|numerical|redetection_.*)$")


class Mover:
    """The scene elsewhere: absent positions get the moved default."""

    def __init__(self, shift, back=False):
        """@param back true: the coordinates are moved there and back, so that they are rounded alike"""
        self.shift, self.back = shift, back

    def added(self, value, way):
        """A number or formula that is larger."""
        if isinstance(value, str):
            return f"= ({value[1:]}) + {way!r}" + (f" - {way!r}" if self.back else "")
        return value + way - way if self.back else value + way

    def moved(self, point):
        return [self.added(x, way) for x, way in zip(point, self.shift)]

    def point(self, table, key, default=None):
        if key in table or default is not None:
            table[key] = self.moved(table.get(key, default))

    def formula(self, value):
        """A number, or a formula of the place x, y, z."""
        if not isinstance(value, str) or self.back:
            return value
        return re.sub(r"\b[xyz]\b", lambda name: f"({name[0]} - {self.shift['xyz'.index(name[0])]!r})", value)

    def where(self, table):
        if "traction" in table:
            table["traction"] = [self.formula(value) for value in table["traction"]]
        self.point(table, "point")
        if "plane" in table:
            self.point(table["plane"], "point")

    def shape(self, table):
        for key in ("min", "max"):
            self.point(table.get("box", {}), key)
        if "hull" in table:
            table["hull"]["points"] = [self.moved(point) for point in table["hull"]["points"]]
        if "sphere" in table:
            self.point(table["sphere"], "center", [0.0, 0.0, 0.0])
        self.point(table.get("halfspace", {}), "point")

    def block(self, table):
        self.shape(table)
        if "mesh" in table:
            self.point(table, "translate", [0.0, 0.0, 0.0])
        elif "rotate" in table:
            self.point(table["rotate"], "about", [0.0, 0.0, 0.0])
        self.actions(table)

    def actions(self, table):
        self.inside(table)
        for entry in table.get("fix", []) + table.get("load", []):
            self.inside(entry)
            self.where(entry)

    def inside(self, table):
        if "inside" in table:
            self.shape(table["inside"])

    def masonry(self, table):
        self.point(table, "origin" if table["kind"] == "wall" else "center", [0.0, 0.0, 0.0])
        if "fill" in table:
            table["fill"]["top"] = self.added(table["fill"]["top"], self.shift[2])

    def cut(self, table):
        self.inside(table)
        if "dip" in table:
            self.point(table, "point", [0.0, 0.0, 0.0])
        self.shape(table.get("solid", {}))

    def support(self, table):
        for key in ("from", "to"):
            self.point(table, key)
        self.where(table.get("pattern", {}))

    def scene(self, scene):
        scene = copy.deepcopy(scene)
        each = {"block": self.block, "masonry": self.masonry, "assign": self.actions, "cut": self.cut,
                "bolt": self.support, "prop": self.support, "joint": self.inside, "boundary": self.where,
                "water": lambda table: self.point(table["level"], "point")}
        for part in [scene, *scene.get("stage", [])]:
            for key, move in each.items():
                for table in part.get(key, []):
                    move(table)
            for entry in part.get("fix", []) + part.get("load", []):
                if "path" in entry:
                    entry["path"] = [[row[0], *self.moved(row[1:])] for row in entry["path"]]
                else:
                    self.inside(entry)
                    self.where(entry)
        for measure in scene.get("measure", []):
            self.inside(measure)
            self.point(measure, "point")
            if "drift" in measure:
                measure["drift"]["heights"] = [self.added(x, self.shift[2]) for x in measure["drift"]["heights"]]
        if "k0" in scene.get("initial_stress", {}):
            stress = scene["initial_stress"]
            stress["surface"] = self.added(stress.get("surface", 0.0), self.shift[2])
        return scene


def run(program, folder, name, scene, sets):
    """@return summary, rows of the history by column"""
    path = folder / f"{name}.toml"
    path.write_text("".join(f"{key} = {metamorphic.toml(value)}\n" for key, value in scene.items()), encoding="utf-8")
    out = folder / f"{name}.out"
    options = [word for key in sets for word in ("--set", key)]
    done = subprocess.run([program, "run", path, "--out", out, "--quiet", "--threads", "1", *options],
                          capture_output=True, text=True, check=False, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode > 1:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr.strip()[-300:]}")
    with open(out / "history.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return json.loads((out / "summary.json").read_text()), rows


def differences_of_verdicts(was, now, size, shares):
    """Of motion: the same blocks, numbers as near as those of the rows."""
    found = [f"verdict.{key}: {was[key]} and {now[key]}" for key in ("state", "moving", "fastest", "displaced") if was[key] != now[key]]
    if [fall["block"] for fall in was["fallen"]] != [fall["block"] for fall in now["fallen"]]:
        return found + ["verdict.fallen"]
    pairs = [(was["speed"], now["speed"], shares[1] * abs(was["speed"]))]
    for one, two in zip(was["fallen"], now["fallen"]):
        pairs.append((one["time"], two["time"], shares[1] * one["time"]))
        pairs += [(one[key], two[key], shares[0] * size) for key in ("drop", "distance")]
    return found + [f"verdict: {x} and {y}" for x, y, allowed in pairs if not abs(x - y) <= allowed]


def differences(before, after, shift, shares):
    """@return what differs, in words; empty: nothing"""
    (was, rows_before), (now, rows_after) = before, after
    found = []
    # The message of a motion has the rounded numbers of its verdict.
    if "verdict" in was and "verdict" in now:
        found += differences_of_verdicts(was["verdict"], now["verdict"], size_of(was), shares)
    elif was.get("message") != now.get("message"):
        found.append(f"message: {was.get('message')} and {now.get('message')}")
    for key in ("status", "steps", "unknowns", "blocks", "moving", "displaced"):
        one, two = was.get(key), now.get(key)
        if key in ("moving", "displaced"):
            one, two = ([entry["block"] for entry in part or []] for part in (one, two))
        if one != two:
            found.append(f"{key}: {one} and {two}")
    one, two = was["counts"]["open_close_iterations"], now["counts"]["open_close_iterations"]
    if abs(one - two) > 1 + ITERATIONS * one:
        found.append(f"iterations: {one} and {two}")
    if len(rows_before) != len(rows_after):
        return found + [f"rows: {len(rows_before)} and {len(rows_after)}"]
    found += differences_of_rows(rows_before, rows_after, shift, was, shares)
    return found


def differences_of_rows(before, after, shift, summary, shares, skipped=(ABOUT_ORIGIN, STATES)):
    found, kinds = [], {}
    names = {measure["name"] for measure in summary["scene"].get("measure", [])}
    for column in before[0] if before else []:
        if any(pattern.match(column) for pattern in skipped):
            continue
        family = next((pattern.pattern for pattern in FAMILIES if pattern.match(column)), column)
        kinds.setdefault(family, []).append(column)
    for columns in kinds.values():
        largest = worst = 0.0
        name, _, part = columns[0].rpartition(".")
        place = part in ("x", "y", "z") and name in names
        way = shift["xyz".index(part)] if place else 0.0
        for column in columns:
            for one, two in zip(before, after):
                x, y = float(one[column]), float(two[column]) - way
                if math.isnan(x) and math.isnan(y):
                    continue
                largest, worst = max(largest, abs(x)), max(worst, abs(x - y))
        is_length = place or part in ("ux", "uy", "uz") or columns[0] == "penetration.max"
        allowed = shares[0] * size_of(summary) if is_length else shares[1] * largest
        if not worst <= allowed:
            found.append(f"{columns[0]}: {worst:.2g}, at most {allowed:.2g}")
    return found


def size_of(summary):
    """Of the boxes and hulls of a scene, m; at least 1."""
    points = []
    for block in summary["scene"]["block"]:
        offset = block.get("translate", [0.0, 0.0, 0.0])
        corners = list(block.get("box", {}).values()) + block.get("hull", {}).get("points", [])
        points += [[x + way for x, way in zip(corner, offset)] for corner in corners]
    return max([1.0] + [max(axis) - min(axis) for axis in zip(*points)])


def try_scene(options, name):
    """@return lines of findings, and whether all is the same"""
    kinds = json.loads((ROOT / "tests/endurance/kinds.json").read_text())
    sets = [] if options.whole else kinds[f"demo_{name}"]["set"]
    scene = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    lines, good = [], True
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        for file in SCENES.glob("*.csv"):
            (folder / file.name).write_bytes(file.read_bytes())
        for number, (title, shift) in enumerate(SHIFTS.items()):
            try:
                before = run(options.program, folder, f"near_{number}", Mover(shift, back=True).scene(scene), sets)
                after = run(options.program, folder, f"far_{number}", Mover(shift).scene(scene), sets)
                found = differences(before, after, shift, OTHER_SCENES.get(name, (LENGTH_SHARE, OTHER_SHARE)))
            except RuntimeError as error:
                found = [str(error)]
            lines.append(f"{name}, {title}: {'; '.join(found) or 'the same'}")
            good = good and not found
    return lines, good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = sorted(path.stem for path in SCENES.glob("*.toml"))
    parser.add_argument("--program", required=True)
    parser.add_argument("--scene", choices=names, action="append")
    parser.add_argument("--whole", action="store_true", help="run demos to their ends")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for lines, good in pool.map(lambda name: try_scene(options, name), options.scene or names):
            print("\n".join(lines), flush=True)
            failed += not good
    print("all right" if failed == 0 else f"{failed} fail")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
