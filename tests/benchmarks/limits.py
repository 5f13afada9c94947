"""Times limit analysis of cut slopes of growing width, and of the rock slope of the demos.

use: python3 tests/benchmarks/limits.py build/release/apps/ashlar [--widths 12 48] [--tolerance 0.001]

A row per scene: blocks, the bracket of the factor of safety, seconds of the run and the mean of its trials, and the exponent
of growth against the row before. Slopes beyond --bracket-up-to blocks are tried between two factors beside the known limit.
"""
import argparse
import json
import math
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SLOPE = ROOT / "tests/networks/cut_slope.toml"
LIMIT = math.tan(math.radians(32)) / math.tan(math.radians(30))


def run_of(program, scene, settings, out):
    started = time.perf_counter()
    said = subprocess.run([program, "run", scene, "--out", out, "--force", *(f"--set={s}" for s in settings)],
                          check=True, capture_output=True, text=True).stderr
    seconds = time.perf_counter() - started
    blocks = int(re.search(r"estimate: (\d+) blocks", said).group(1))
    return json.loads(pathlib.Path(out, "summary.json").read_text("utf-8"))["factor_of_safety"], blocks, seconds


def row(name, blocks, factor, seconds, before):
    growth = math.log(seconds / before[1]) / math.log(blocks / before[0]) if before and blocks > before[0] else math.nan
    trials = factor["trials"]
    text = " to ".join("-" if factor[end] is None else f"{factor[end]:.5g}" for end in ("lower", "upper"))
    print(f"{name:24s} {blocks:6d} blocks  {text:20s} {len(trials):3d} trials  {seconds:8.2f} s"
          f"  {seconds / max(len(trials), 1):7.2f} s a trial  exponent {growth:.2f}", flush=True)
    return blocks, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("program")
    parser.add_argument("--widths", nargs="+", type=float, default=[12, 48],
                        help="of the slope, m; 257 blocks at 12 m, 10,240 and more than ten minutes at 480 m")
    parser.add_argument("--tolerance", type=float, default=0.001)
    parser.add_argument("--bracket-up-to", type=int, default=2000, metavar="BLOCKS")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        out, before = str(pathlib.Path(folder, "out")), None
        for width in options.widths:
            settings = [f"parameters.width={width}", f"analysis.safety.tolerance={options.tolerance}",
                        "analysis.method=limit"]
            if width * 257 / 12 > options.bracket_up_to:
                settings += [f"analysis.safety.lower={LIMIT * 0.999:.6f}", f"analysis.safety.upper={LIMIT * 1.001:.6f}"]
            factor, blocks, seconds = run_of(options.program, str(SLOPE), settings, out)
            before = row(f"cut slope, {width:g} m", blocks, factor, seconds, before)
        scene = ROOT / "data/scenes/rock_slope.toml"
        settings = ["analysis.type=factor-of-safety", "analysis.method=limit"]
        factor, blocks, seconds = run_of(options.program, str(scene), settings, out)
        row("rock_slope", blocks, factor, seconds, None)


main()
