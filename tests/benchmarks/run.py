"""Runs the benchmarks of a release build and writes one CSV file, each row with the compiler and the commit.

use: python3 tests/benchmarks/run.py build/release --out benchmarks.csv [--filter REGEX] [--only contact ...]
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ("benchmark", "name", "iterations", "cpu_seconds", "items_per_second", "compiler", "commit", "cpus")


def cache_value(build, key):
    for line in (build / "CMakeCache.txt").read_text().splitlines():
        name, _, value = line.partition("=")
        if name.split(":")[0] == key:
            return value
    sys.exit(f"{build}/CMakeCache.txt: {key} is not there")


def compiler_of(build):
    lines = subprocess.run([cache_value(build, "CMAKE_CXX_COMPILER"), "--version"], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    return lines[0]


def commit():
    def git(*arguments):
        return subprocess.run(["git", "-C", ROOT, *arguments], check=True, capture_output=True, text=True).stdout.strip()
    return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain", "--untracked-files=no") else "")


def rows_of(program, options, context):
    arguments = [program, "--benchmark_format=json"]
    if options.filter:
        arguments.append(f"--benchmark_filter={options.filter}")
    report = json.loads(subprocess.run(arguments, check=True, stdout=subprocess.PIPE, text=True).stdout or "{}")
    seconds = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
    for entry in report.get("benchmarks", []):
        yield {"benchmark": program.name, "name": entry["name"], "iterations": entry["iterations"],
               "cpu_seconds": entry["cpu_time"] * seconds[entry["time_unit"]],
               "items_per_second": entry.get("items_per_second", ""), "cpus": report["context"]["num_cpus"], **context}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("build", type=pathlib.Path, help="folder of a release build")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("benchmarks.csv"))
    parser.add_argument("--filter", help="names of rows, a regular expression")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="benchmarks, without _benchmark")
    options = parser.parse_args()
    programs = [path for path in sorted((options.build / "tests/benchmarks").glob("*_benchmark"))
                if not options.only or path.name.removesuffix("_benchmark") in options.only]
    if not programs:
        sys.exit(f"{options.build}/tests/benchmarks holds no such benchmark")
    context = {"compiler": compiler_of(options.build), "commit": commit()}
    with open(options.out, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        for program in programs:
            for row in rows_of(program, options, context):
                table.writerow(row)
                print(f"{row['name']}: {row['cpu_seconds']:.3g} s", flush=True)


main()
