#!/usr/bin/env python3
"""Changes one operator or constant of a layer's sources at a time and checks that the layer's tests detect it.

    python3 tests/mutants/mutants.py --layer geometry --count 20 --seed 1 --folder /tmp/mutants
    python3 tests/mutants/mutants.py --layer mechanics --count 20 --seed 1 --files 'mechanics/contact/*' --list
    python3 tests/mutants/mutants.py --layer apps --count 10 --seed 1 --files 'apps/scene/*'
    python3 tests/mutants/mutants.py --self-test

The sources are copied to FOLDER/source and built there: the working copy is never changed. A second call with the same
folder goes on with its build. Mutant k of a seed is always the same for the same sources. Each one is built and run
against the tests that cover its file (those of its own test file, or else of its folder), then against all of the layer.
It is killed where a test fails, crashes or takes ten times its processor time; survivors are printed with their
difference and written to FOLDER/results.jsonl with all others. Exit status: 0 no mutant survived, 1 some did, 2 wrong
usage or sources that do not build or fail without a change.
"""
import argparse
import dataclasses
import difflib
import fnmatch
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYERS = ["geometry", "mechanics", "solver", "apps"]
# Sources tested from outside only, not part of the libraries of a layer's test program.
OUTSIDE = ["apps/program/main.cpp", "apps/python/*", "*/windows/*", "*/browser/*"]
MEMORY = 8 << 30  # bytes that a test program may take
# Binary operators stand between spaces, which those of templates, references and pointers do not.
OPERATORS = {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
             " && ": " || ", " || ": " && ", " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ",
             " += ": " -= ", " -= ": " += ", "std::min(": "std::max(", "std::max(": "std::min(",
             "true": "false", "false": "true"}
OPERATOR = re.compile("|".join(re.escape(o) if not o.isalpha() else rf"\b{o}\b"
                               for o in sorted(OPERATORS, key=len, reverse=True)))
NUMBER = re.compile(r"(?<![\w.])(?:\d+\.\d*(?:e[+-]?\d+)?|\d+(?:e[+-]?\d+)?)(?![\w.])")
# Lines whose numbers and operators have no effect on results: storage, text and compile-time decisions.
SKIPPED = re.compile(r"^\s*#|^\s*(?:static_assert|template|using|namespace)\b|\breserve\(|\bthrow\b|operator")


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # relative to the sources
    start: int  # offset of the text that is replaced
    old: str
    new: str

    def apply(self, text):
        assert text[self.start:self.start + len(self.old)] == self.old
        return text[:self.start] + self.new + text[self.start + len(self.old):]

    def line(self, text):
        return text.count("\n", 0, self.start) + 1

    def difference(self, text):
        lines = difflib.unified_diff(text.splitlines(), self.apply(text).splitlines(), n=0, lineterm="")
        return "\n".join(list(lines)[3:])


def masked(text):
    """The text with comments, strings, characters and skipped lines blank, all offsets kept."""
    pattern = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'", re.S)
    blank = pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    return "\n".join(" " * len(line) if SKIPPED.search(line) else line for line in blank.split("\n"))


def other_number(number):
    """Mutant of a number: a whole one plus 1, another one doubled, 1 for 0."""
    if re.fullmatch(r"\d+", number):
        return str(int(number) + 1)
    return "1.0" if float(number) == 0.0 else repr(2.0 * float(number))


def mutants_of(file, text):
    code = masked(text)
    found = [Mutant(file, m.start(), m.group(), OPERATORS[m.group()]) for m in OPERATOR.finditer(code)]
    found += [Mutant(file, m.start(), m.group(), other_number(m.group())) for m in NUMBER.finditer(code)]
    return sorted(found, key=lambda m: m.start)


def run(command, seconds=None, **options):
    """Runs a program. @param seconds of processor time that it may take. @return exit status, negative: a signal"""
    def limit():
        if seconds is not None:
            resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return subprocess.run(command, preexec_fn=limit, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False, **options).returncode


def processor_seconds(command, **options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    status = run(command, **options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return status, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Project:
    """Sources in a folder, how they are built, and the tests that cover a file, nearest first."""

    def __init__(self, source, build, tests):
        self.source = pathlib.Path(source)
        self.build = build
        self.tests = tests
        self.times = {}

    def check(self, file):
        """Builds the sources and runs the tests of a file. @return the fault, or None"""
        if run(self.build, cwd=self.source) != 0:
            return "does not build: " + " ".join(self.build)
        for command in self.tests(file):
            if tuple(command) not in self.times:
                status, seconds = processor_seconds(command, cwd=self.source)
                if status != 0:
                    return "fails without a change: " + " ".join(command)
                self.times[tuple(command)] = seconds
        return None

    def classify(self, mutant):
        """'survived', 'killed by ...' or 'does not build'."""
        path = self.source / mutant.file
        text = path.read_text()
        try:
            path.write_text(mutant.apply(text))
            if run(self.build, cwd=self.source) != 0:
                return "does not build"
            for which, command in zip(["its own tests", "other tests"], self.tests(mutant.file)):
                status = run(command, seconds=10.0 * self.times[tuple(command)] + 5.0, cwd=self.source)
                if status != 0:
                    return f"killed by {which}" + (f" (signal {-status})" if status < 0 else "")
            return "survived"
        finally:
            path.write_text(text)


def suites(path):
    return re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)", path.read_text(), re.M)


def test_filter(source, layer, file):
    """The test suites of a file's own test file, or else of all test files of its folder; None: of neither."""
    inside = pathlib.Path(file).relative_to(layer)
    folder = source / "tests" / "unit" / layer / inside.parent
    own = folder / (inside.stem + "_test.cpp")
    files = [own] if own.exists() else sorted(folder.glob("*_test.cpp"))
    names = sorted({name for f in files for name in suites(f)})
    return ":".join(f"{name}.*:*/{name}.*:{name}/*" for name in names) or None


def copy_sources(folder):
    """Copies the files that are under version control, as they are now, without touching those that are the same."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    for name in filter(None, listed):
        here, there = ROOT / name, folder / name
        if not here.is_file():
            there.unlink(missing_ok=True)
        elif not there.exists() or here.read_bytes() != there.read_bytes():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here, there)


def layer_project(layer, folder, jobs):
    source = folder / "source"
    copy_sources(source)
    if shutil.which("ccache"):
        os.environ.update(CMAKE_C_COMPILER_LAUNCHER="ccache", CMAKE_CXX_COMPILER_LAUNCHER="ccache",
                          CCACHE_BASEDIR=str(source), CCACHE_NOHASHDIR="1")
    # With assertions, so that reads beyond an array are detected.
    if run(["cmake", "--preset", "release", "-DASHLAR_WARNINGS_AS_ERRORS=OFF", "-DASHLAR_BUILD_BENCHMARKS=OFF",
            "-DCMAKE_UNITY_BUILD=OFF", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -D_GLIBCXX_ASSERTIONS"], cwd=source) != 0:
        raise SystemExit(f"error: {source} cannot be configured")
    program = f"build/release/tests/{layer}_tests"
    everything = [program, "--gtest_brief=1", "--gtest_fail_fast"]

    def tests(file):
        chosen = test_filter(source, layer, file)
        return [everything + [f"--gtest_filter={chosen}"]] * (chosen is not None) + [everything]
    return Project(source, ["cmake", "--build", "--preset", "release", f"-j{jobs}", "--target", f"{layer}_tests"], tests)


def choose(layer, pattern, seed, count):
    candidates = []
    for path in sorted((ROOT / layer).rglob("*.cpp")):
        file = str(path.relative_to(ROOT))
        if fnmatch.fnmatch(file, pattern) and not any(fnmatch.fnmatch(file, outside) for outside in OUTSIDE):
            candidates += mutants_of(file, path.read_text())
    random.Random(seed).shuffle(candidates)
    return candidates[:count]


def report(mutant, text, verdict):
    print(f"{mutant.file}:{mutant.line(text)}: {mutant.old.strip()} -> {mutant.new.strip()}: {verdict}", flush=True)
    if verdict == "survived":
        print(mutant.difference(text), flush=True)


def run_all(arguments):
    mutants = choose(arguments.layer, arguments.files, arguments.seed, arguments.count)[arguments.skip:]
    if arguments.list:
        for mutant in mutants:
            report(mutant, (ROOT / mutant.file).read_text(), "listed")
        return 0
    folder = pathlib.Path(arguments.folder or tempfile.mkdtemp(prefix="mutants.")).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    project = layer_project(arguments.layer, folder, arguments.jobs)
    verdicts = []
    for mutant in mutants:
        fault = project.check(mutant.file)
        if fault:
            print(f"error: {fault}", file=sys.stderr)
            return 2
        text = (project.source / mutant.file).read_text()
        verdicts.append(project.classify(mutant))
        report(mutant, text, verdicts[-1])
        with open(folder / "results.jsonl", "a", encoding="utf-8") as results:
            results.write(json.dumps({**dataclasses.asdict(mutant), "line": mutant.line(text), "verdict": verdicts[-1]})
                          + "\n")
    survived = verdicts.count("survived")
    built = len(verdicts) - verdicts.count("does not build")
    print(f"{built} mutants, {built - survived} killed, {survived} survived; {len(verdicts) - built} did not build")
    return 1 if survived else 0


SAMPLE = """// a < b and 1 + 1 in a comment are no code
const char* text() { return "a + b"; }
int larger(int a, int b) { return a < b ? b : a; }
int sum_below(int n) {
  int sum = 0;
  for (int i = 0; i < n; i += 2) sum += i;
  return sum;
}
"""
SAMPLE_TEST = """int larger(int, int);
int sum_below(int);
int main() { return larger(1, 2) == 2 && larger(2, 1) == 2 && sum_below(5) == 6 ? 0 : 1; }
"""
# By hand: larger(2, 2) is the same either way; nothing asks for an even bound; a step of -2 does not end.
EXPECTED = [(3, " < ", "survived"), (5, "0", "killed"), (6, "0", "killed"), (6, " < ", "survived"), (6, " += ", "killed"),
            (6, "2", "killed"), (6, " += ", "killed")]


def self_test():
    """A sample with known mutants and verdicts, built by the C++ compiler alone."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "sample.cpp").write_text(SAMPLE)
        (pathlib.Path(folder) / "test.cpp").write_text(SAMPLE_TEST)
        compiler = os.environ.get("CXX", "c++")
        project = Project(folder, [compiler, "-fwrapv", "-o", "test", "sample.cpp", "test.cpp"],
                          lambda file: [["./test"]])
        assert project.check("sample.cpp") is None
        found = [(m.line(SAMPLE), m.old, project.classify(m).split()[0]) for m in mutants_of("sample.cpp", SAMPLE)]
        assert found == EXPECTED, found
        broken = Mutant("sample.cpp", SAMPLE.index("int larger"), "int", "ink")
        assert project.classify(broken) == "does not build"
        assert (pathlib.Path(folder) / "sample.cpp").read_text() == SAMPLE
    assert other_number("0.0") == "1.0" and other_number("1e-3") == "0.002" and other_number("7") == "8"
    assert test_filter(ROOT, "geometry", "geometry/exact/double_double.cpp").startswith("DoubleDouble.*:")
    assert test_filter(ROOT, "apps", "apps/program/sweep/variants.cpp").startswith("Variants")
    for folder in ("scene", "results", "program/sweep", "run"):
        files = {mutant.file for mutant in choose("apps", f"apps/{folder}/*", 1, 10 ** 6)}
        assert files and all(test_filter(ROOT, "apps", file) for file in files), folder
    assert not choose("apps", "apps/python/*", 1, 1) and not choose("apps", "apps/program/main.cpp", 1, 1)
    print("as expected")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--layer", choices=LAYERS, default="geometry")
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--skip", type=int, default=0, help="of the mutants of this seed, those that were seen before")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--files", default="*", help="pattern of source files, as 'geometry/convex/*'")
    parser.add_argument("--folder", help="of the copy and its build; default: a new one")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--list", action="store_true", help="only say which mutants there would be")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    return self_test() if arguments.self_test else run_all(arguments)


if __name__ == "__main__":
    sys.exit(main())
