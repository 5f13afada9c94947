#!/usr/bin/env python3
"""Mutated scenes: every key of the schema with values that nobody means, and scenes that are damaged.

    python3 tests/fuzz/mutations.py build/release/apps/ashlar [--first 0] [--count 3000] [--jobs 2] [--keep FOLDER]

Mutation n is the same on every machine: a demo or a scene of the endurance tests, shortened, with one to three changes. A change
gives some key of the schema a value, changes a value that is there, removes, repeats or exchanges entries, or damages the text.
The command is `ashlar check`, and for every second scene that it accepts `ashlar run`, interrupted after 2 s. A finding is

    an end by a signal, or an exit status other than 0, 1, 2 and that of an interrupted run,
    20 s without an end, of a run after the interrupt; 120 s with cuts, of which 100,000 blocks take 40 s,
    a refusal without a message, or a message in words of a library,
    a completed run whose summary.json has no JSON, or another number than the scene for a key that was changed.

Findings are kept in the folder. Exit status: 0 none, 1 some.
"""
import argparse
import concurrent.futures
import copy
import json
import math
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/metamorphic"))
from metamorphic import toml  # noqa: E402

ENDURANCE = ROOT / "tests/endurance"
MOST_SECONDS, MOST_SECONDS_OF_CUTS, RUN_SECONDS, MOST_BYTES = 20, 120, 2, 8 << 30
RUN_EACH = 2
INTERRUPTED = 130
# Words of libraries and of the language, which say nothing to a user.
RAW = re.compile(r"what\(\)|terminate called|basic_string|std::|vector::|stoi|stod|json\.exception|HDF5-DIAG|CGAL|Eigen|"
                 r"Assertion|core dumped|AddressSanitizer|runtime error|toml::|map::at|bad optional|invalid_argument")
NUMBERS = [0, -1, 1, 2, 3, 7, -0.0, 0.5, 1e-3, 1e3, 1e6, 1e9, 1e12, 1e-12, 1e-300, 5e-324, 1e300, -1e300, 1.7e308, math.nan,
           math.inf, -math.inf, 2**31, 2**32, 2**53 + 1, 2**63 - 1, -2**63, 45, 89.999999, 90, 91, 180, 360, 1e-9, 0.1, 1e5]
TEXTS = ["", " ", "a", "*", "?", "[", "..", "/", "/dev/null", "/dev/zero", "no_such_file", "scene.toml", "wall.*", "b" * 5000,
         "\u00e9\u4e2d\U0001f600", "a\nb", "\x07", "= 1", "= 1/0", "= x", "= (", "= 1e999", "= pi", "true", "1", "nan", "box",
         "static", "dynamic", "thrust", "capacity", "factor-of-safety", "elastic", "limit", "%s%n", "{}", "../../../etc/passwd"]


def text_of(scene):
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in scene.items())


def with_setting(scene, setting):
    """A.B=VALUE as the program has it, for tables and elements by number or name."""
    path, value = setting.split("=", 1)
    try:
        value = tomllib.loads(f"v = {value}")["v"]
    except tomllib.TOMLDecodeError:
        pass
    at = scene
    names = path.split(".")
    for name in names[:-1]:
        if isinstance(at, list):
            at = at[int(name)] if name.isdigit() else next(one for one in at if one.get("name") == name)
        else:
            at = at.setdefault(name, {})
    at[names[-1]] = value


def base_scenes():
    scenes = []
    for name, kind in json.loads((ENDURANCE / "kinds.json").read_text()).items():
        file = (ENDURANCE / kind["scene"]).resolve()
        scene = tomllib.loads(file.read_text())
        for setting in kind.get("set", []):
            with_setting(scene, setting)
        scenes.append((name, file.parent, scene))
    return scenes


def leaves(schema, path=()):
    """(path, schema of the value) of all keys; a list is "*"."""
    for one in schema.get("anyOf", []):
        yield from leaves(one, path)
    if schema.get("type") == "object":
        for name, inner in schema.get("properties", {}).items():
            yield path + (name,), inner
            yield from leaves(inner, path + (name,))
    if schema.get("type") == "array" and isinstance(schema.get("items"), dict):
        yield from leaves(schema["items"], path + ("*",))


class Mutator:
    def __init__(self, number, scenes, keys):
        self.random = random.Random(number)
        name, self.folder, scene = self.random.choice(scenes)
        self.name = name
        self.scene = copy.deepcopy(scene)
        self.keys = keys
        self.changed = []  # (path, number) of numbers
        for _ in range(self.random.choice([1, 1, 1, 2, 3])):
            self.random.choice([self.set_key, self.set_key, self.change_value, self.change_value, self.change_entries])()
        self.text = text_of(self.scene)
        if self.random.random() < 0.1:
            self.damage()

    def scalar(self):
        kind = self.random.random()
        if kind < 0.6:
            return self.random.choice(NUMBERS)
        if kind < 0.9:
            return self.random.choice(TEXTS)
        return self.random.choice([True, False, [], {}, [[]], [{}]])

    def value_like(self, schema, depth=0):
        """Mostly of the kind that the schema asks for."""
        if self.random.random() < 0.15 or depth > 4:
            return self.scalar()
        if "anyOf" in schema:
            return self.value_like(self.random.choice(schema["anyOf"]), depth)
        if "enum" in schema:
            return self.random.choice(schema["enum"])
        kind = schema.get("type")
        if kind in ("number", "integer"):
            return self.random.choice(NUMBERS)
        if kind == "string":
            return self.random.choice(TEXTS)
        if kind == "boolean":
            return self.random.random() < 0.5
        if kind == "array":
            count = schema.get("minItems", self.random.randint(0, 3))
            return [self.value_like(schema.get("items", {}), depth + 1) for _ in range(min(count, 6))]
        if kind == "object":
            names = list(schema.get("properties", {}))
            chosen = set(self.random.sample(names, min(len(names), self.random.randint(0, 3)))) | set(schema.get("required", []))
            return {name: self.value_like(schema["properties"][name], depth + 1) for name in sorted(chosen)}
        return self.scalar()

    def set_key(self):
        path, schema = self.random.choice(self.keys)
        at, place = self.scene, []
        for name in path[:-1]:
            if name == "*":
                if not isinstance(at, list):
                    return
                if not at:
                    at.append({})
                index = self.random.randrange(len(at))
                place.append(index)
                at = at[index]
            elif isinstance(at, dict):
                at = at.setdefault(name, [] if path[path.index(name) + 1] == "*" else {})
                place.append(name)
            else:
                return
        if not isinstance(at, dict):
            return
        at[path[-1]] = self.value_like(schema)
        self.note([*place, path[-1]], at[path[-1]])

    def note(self, place, value):
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            self.changed.append((place, value))

    def places(self, value, place=()):
        yield place, value
        for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else []:
            yield from self.places(value[key], place + (key,))

    def holder(self, place):
        at = self.scene
        for key in place[:-1]:
            at = at[key]
        return at

    def change_value(self):
        found = [place for place, value in self.places(self.scene) if place and not isinstance(value, (dict, list))]
        if not found:
            return
        place = self.random.choice(found)
        holder = self.holder(place)
        old = holder[place[-1]]
        if isinstance(old, (int, float)) and not isinstance(old, bool) and self.random.random() < 0.4:
            new = old * self.random.choice([-1, 0.1, 10, 1e-6, 1e6, 1 + 1e-12])
        else:
            new = self.random.choice(NUMBERS) if isinstance(old, (int, float)) and self.random.random() < 0.8 else self.scalar()
        holder[place[-1]] = new
        self.note(list(place), new)

    def change_entries(self):
        found = [place for place, value in self.places(self.scene) if isinstance(value, (dict, list)) and value]
        at = self.scene
        for key in self.random.choice(found):
            at = at[key]
        self.changed.clear()
        keys = list(at) if isinstance(at, dict) else list(range(len(at)))
        key = self.random.choice(keys)
        how = self.random.randrange(3)
        if how == 0:
            del at[key]
        elif how == 1 and isinstance(at, list):
            at.insert(self.random.randrange(len(at) + 1), copy.deepcopy(at[key]))
        else:
            other = self.random.choice(keys)
            at[key], at[other] = at[other], at[key]

    def damage(self):
        self.changed.clear()
        lines = self.text.splitlines(keepends=True)
        at = self.random.randrange(len(lines))
        how = self.random.randrange(5)
        if how == 0:
            del lines[at]
        elif how == 1:
            lines.insert(at, lines[self.random.randrange(len(lines))])
        elif how == 2:
            lines[at] = lines[at][:self.random.randrange(len(lines[at]) + 1)]
        elif how == 3:
            cut = self.random.randrange(len(lines[at]) + 1)
            lines[at] = lines[at][:cut] + self.random.choice(["\"", "[", "}", "\\", "\x00", "#", "'''", "="]) + lines[at][cut:]
        else:
            lines[at] = lines[at].replace(self.random.choice("0123456789.,"), self.random.choice("0123456789.,eE-+_x"), 1)
        self.text = "".join(lines)


def values_at(scenes, place):
    """Values of several scenes at a place, or None where one lacks it or has another entry of a list there: arrays and cuts
    of blocks add some."""
    for key in place:
        for at in scenes:
            if not (isinstance(at, dict) and key in at or isinstance(at, list) and isinstance(key, int) and key < len(at)):
                return None
        scenes = [at[key] for at in scenes]
        if isinstance(key, int) and len({at.get("name") for at in scenes if isinstance(at, dict)}) > 1:
            return None
    return scenes


class Program:
    def __init__(self, program):
        self.program = program

    def start(self, *command):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
        with subprocess.Popen([self.program, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=limit,
                              env={**os.environ, "OMP_NUM_THREADS": "1"}) as child:
            try:
                if command[0] == "run":
                    try:
                        child.wait(RUN_SECONDS)
                    except subprocess.TimeoutExpired:
                        child.send_signal(signal.SIGINT)
                told = child.communicate(timeout=self.most_seconds)[0]
            except subprocess.TimeoutExpired:
                child.kill()
                return None, ""
        return child.returncode, told.decode(errors="replace")

    def judge(self, mutation, number):
        """@return what is wrong, or None"""
        with tempfile.TemporaryDirectory() as folder:
            # Beside links to the files that the scene names.
            work = pathlib.Path(folder)
            for other in mutation.folder.iterdir():
                (work / other.name).symlink_to(other)
            for other in mutation.folder.parent.iterdir():
                if other.is_dir():
                    mutation.text = mutation.text.replace(f"../{other.name}/", f"{other}/")
            self.most_seconds = MOST_SECONDS_OF_CUTS if "cut" in mutation.scene else MOST_SECONDS
            scene = work / "mutation.toml"
            scene.write_text(mutation.text, encoding="utf-8")
            wrong = self.ended(*self.start("check", str(scene)))
            if not wrong and number % RUN_EACH == 0 and self.status == 0:
                wrong = self.ended(*self.start("run", str(scene), "--out", str(work / "o"), "--quiet", "--checkpoint", "0"))
                if not wrong and self.status == 0:
                    wrong = self.told(work / "o/summary.json", mutation)
            return wrong

    def ended(self, status, told):
        self.status = status
        if status is None:
            return f"no end within {self.most_seconds} s"
        if status not in (0, 1, 2, INTERRUPTED):
            return f"exit status {status}: {told[-300:]}"
        if RAW.search(told):
            return f"a raw message: {RAW.search(told).group()} in {told[-300:]}"
        if status != 0 and "error" not in told and "ashlar:" not in told:
            return f"exit status {status} without a reason: {told[-300:]}"
        return None

    @staticmethod
    def told(file, mutation):
        def refuse(text):
            raise ValueError(f"{text} in {file.name}")
        try:
            summary = json.loads(file.read_text(), parse_constant=refuse)
        except ValueError as fault:
            return str(fault)
        for place, value in mutation.changed:
            values = values_at([mutation.scene, summary.get("scene", {})], place)
            if values is None or values[0] is not value:
                continue  # changed again
            read = values[1]
            if isinstance(read, (int, float)) and not isinstance(read, bool) and float(read) != float(value):
                return f"{place} = {value} was read as {read}"
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    scenes = base_scenes()
    keys = sorted(set(map(json.dumps, leaves(json.loads((ROOT / "data/scene.schema.json").read_text())))))
    keys = [(tuple(path), schema) for path, schema in map(json.loads, keys)]
    program = os.path.abspath(arguments.program)
    statuses, faults = {}, 0

    def one(number):
        mutation, judge = Mutator(number, scenes, keys), Program(program)
        return number, mutation, judge.judge(mutation, number), judge.status

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for number, mutation, wrong, status in pool.map(one, range(arguments.first, arguments.first + arguments.count)):
            statuses[status] = statuses.get(status, 0) + 1
            if wrong:
                faults += 1
                print(f"{number} ({mutation.name}): {wrong}", flush=True)
                if arguments.keep:
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    (arguments.keep / f"{number}.toml").write_text(mutation.text, encoding="utf-8")
    print(f"{arguments.count} mutations of {len(scenes)} scenes over {len(keys)} keys, exit statuses {statuses}: {faults} findings")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
