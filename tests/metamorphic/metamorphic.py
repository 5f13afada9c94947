#!/usr/bin/env python3
"""Scenes whose answers follow from each other: in another order, mirrored, turned, shifted, heavier, longer, renamed,
with two threads. Answers are the displacements, velocities and turns of blocks in every step, or brackets of factors.

    python3 tests/metamorphic/metamorphic.py --program build/release/apps/ashlar
    python3 tests/metamorphic/metamorphic.py --program build/release/apps/ashlar --scene rigid --relation mirror

Exit status: 0 all relations hold, 1 some do not, 2 wrong usage.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import subprocess
import sys
import tempfile

import relations
import scenes

VECTORS = (("ux", "uy", "uz"), ("vx", "vy", "vz"))
TURNS = (("rx", "ry", "rz"),)

# By which brackets may miss each other. Ends that are values, released and associated, are found to a third of the
# tolerance of a search, 0.01.
BRACKETS = 0.003

# Relations that a scene cannot promise, or that have no meaning there.
LEFT_OUT = {
    ("cut_rock", "axes"): "dips are those of the horizontal plane z = 0",
    ("masonry", "axes"): "columns are upright along z",
    ("slope", "axes"): "dips are those of the horizontal plane z = 0",
    ("generalized_alpha", "mirror"): "2e-4: faces of order 2 are triangles of the mesh, whose diagonals a mirror exchanges",
    ("generalized_alpha", "quarter turn"): "the same: a box that is turned has other diagonals",
}


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def run(program, folder, name, scene, options=("--threads", "1")):
    """@return the folder of its results"""
    path = os.path.join(folder, name + ".toml")
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"{key} = {toml(value)}\n" for key, value in scene.items())
    out = os.path.join(folder, name + ".out")
    done = subprocess.run([program, "run", path, "--out", out, "--quiet", *options],
                          capture_output=True, text=True, check=False, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode != 0:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr.strip()[-500:]}")
    return out


def brackets(*started):
    """Runs a search as run() does. @return (least, largest) of the factor, of released and of associated motion"""
    with open(os.path.join(run(*started), "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    found = summary.get("factor_of_safety", summary.get("load_factor"))
    return [(found["lower"], found["upper"]), (found["released"],) * 2, (found["associated"],) * 2]


def apart(before, after):
    """@return by how much the brackets of two runs miss each other, as a share; a released or proven end by its value"""
    worst = 0.0
    for (low, high), (other_low, other_high) in zip(before, after, strict=True):
        if None in (low, high, other_low, other_high):
            if (low, high) != (other_low, other_high):
                raise ValueError(f"{before} and {after}: an end is missing in one")
            continue
        worst = max(worst, max(low, other_low) / min(high, other_high) - 1.0)
    return worst


def answers(program, folder, name, scene, options=("--threads", "1")):
    """Runs a scene. @return by measure and kind of vector its three components in each row that counts"""
    out = run(program, folder, name, scene, options)
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    # Only the equilibrium of a static analysis counts, not its path.
    if scene["analysis"].get("type") == "static" and "stage" not in scene:
        rows = rows[-1:]
    return {(measure["name"], kind): [[float(row[f"{measure['name']}.{x}"]) for x in kind] for row in rows]
            for measure in scene["measure"] for kind in VECTORS + TURNS}


def difference(before, after, relation):
    """@return largest difference of all kinds of vectors, each as a share of the largest such vector"""
    worst = 0.0
    for kind in VECTORS + TURNS:
        expect = relation.axis if kind in TURNS else relation.vector
        length = 1.0 if kind in TURNS else relation.length
        pairs = [(expect([length * x for x in vector]), other) for (name, what), rows in before.items()
                 if what == kind for vector, other in zip(rows, after[name, what], strict=True)]
        largest = max(abs(x) for vector, _ in pairs for x in vector)
        error = max(abs(x - y) for vector, other in pairs for x, y in zip(vector, other))
        worst = max(worst, error / largest if largest > 0.0 else error)
    return worst


def try_scene(options, name):
    """@return lines of findings, and the number of violated relations"""
    search = name in scenes.SEARCHES
    answer, differ = (brackets, lambda before, after, _: apart(before, after)) if search else (answers, difference)
    scene, lines, failed = (scenes.SEARCHES if search else scenes.SCENES)[name](), [], 0
    chosen = [options.relation] if options.relation else relations.RELATIONS
    with tempfile.TemporaryDirectory() as folder:
        before = answer(options.program, folder, "scene", scene)
        for title in chosen:
            relation = relations.RELATIONS[title]
            if (name, title) in LEFT_OUT:
                lines.append(f"{name}, {title}: left out: {LEFT_OUT[name, title]}")
                continue
            try:
                after = answer(options.program, folder, title.replace(" ", "_"), relation.scene(scene), relation.options)
                found, bound = differ(before, after, relation), BRACKETS if search else relation.bound
                holds = found <= bound
                lines.append(f"{name}, {title}: {found:.2g}{'' if holds else f' WRONG, at most {bound:g}'}")
            except (RuntimeError, ValueError) as error:
                holds = False
                lines.append(f"{name}, {title}: WRONG: {error}")
            failed += not holds
    return lines, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scene", choices=[*scenes.SCENES, *scenes.SEARCHES])
    parser.add_argument("--relation", choices=relations.RELATIONS)
    options = parser.parse_args()
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for lines, wrong in pool.map(lambda name: try_scene(options, name),
                                     [options.scene] if options.scene else [*scenes.SCENES, *scenes.SEARCHES]):
            print("\n".join(lines), flush=True)
            failed += wrong
    print("all right" if failed == 0 else f"{failed} fail")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
