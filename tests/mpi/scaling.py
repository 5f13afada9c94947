"""Scaling of runs on several ranks: strong, weak, counts of a rank up to many ranks, and a fitted model of a step.

Use: scaling.py MPIEXEC ASHLAR [--scenes wall:10,wall:20,cube:6] [--ranks 1,2,4] [--many 8,16,32,64] [--many-scene wall:10]
     [--weak wall:10@1,wall:14@2,wall:20@4] [--steps 5] [--longest SECONDS] [--markdown FILE]
MPIEXEC is a command, e.g. "mpiexec --oversubscribe --bind-to none". wall:N is a wall of N courses of N bricks, cube:N a
cube cut by three joint sets into N^3 blocks. --many runs a scene on more ranks than there are cores: its counts are
those of as many cores, its times are not.
"""
import argparse
import dataclasses
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

import cost_model


@dataclasses.dataclass
class RankRow:
    """A rank of a run; counts and times are of one step, on average."""
    scene: str
    ranks: int
    all_blocks: int
    blocks: int
    ghosts: int
    points: float
    iterations: float
    unknowns: int
    solutions: float
    calls: float
    messages: float
    bytes: float
    result_bytes: float
    own: float         # s, processor time without messages and shared systems
    shared: float      # s, processor time in shared systems, waiting included
    waiting: float     # s, processor time in messages
    memory: int        # bytes


@dataclasses.dataclass
class RunRow:
    scene: str
    ranks: int
    all_blocks: int
    steps: int
    wall: float        # s per step, of all phases
    phases: dict
    imbalance: float
    memory: int        # bytes, of the largest rank
    rows: list


def scene_text(name, steps):
    kind, size = name.split(":")
    n = int(size)
    head = (f"analysis = {{ end_time = {steps}e-3, time_step = 1e-3 }}\n"
            "output = { every = 1000000, history_every = 1000000 }\n"
            "contact = { friction_angle = 35 }\n")
    if kind == "wall":
        return head + (
            'material = [{ name = "brick", density = 2000, young_modulus = 5e7, poisson_ratio = 0.2 }]\n'
            f'block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -0.2], max = [{0.5 * n + 1}, 1, 0] }} }}]\n'
            f'masonry = [{{ name = "wall", kind = "wall", material = "brick", length = {0.5 * n}, height = {0.15 * n}, '
            'brick = [0.5, 0.25, 0.15] }]\n')
    if kind == "cube":
        sets = ", ".join(f'{{ name = "{joint}", blocks = ["rock*"], dip = {dip}, dip_direction = {to}, spacing = 1, '
                         f'point = [0, 0, 0] }}' for joint, dip, to in (("flat", 0, 0), ("east", 90, 90), ("north", 90, 0)))
        return head + (
            'material = [{ name = "rock", density = 2500, young_modulus = 5e7, poisson_ratio = 0.2 }]\n'
            f"cut = [{sets}]\n"
            f'block = [{{ name = "ground", fixed = true, box = {{ min = [-1, -1, -1], max = [{n + 1}, {n + 1}, 0] }} }}, '
            f'{{ name = "rock", material = "rock", box = {{ min = [0, 0, 0], max = [{n}, {n}, {n}] }} }}]\n')
    raise ValueError(f"scene {name}: wall:N and cube:N are known")


def rows_of(name, ranks, summary):
    """RunRow of a summary.json."""
    steps = max(summary["steps"], 1)
    seconds = summary["wall_seconds"]
    phases = {key: value / steps for key, value in seconds.items() if key not in ("total", "setup", "output")}
    counts = summary["counts"]
    each = summary.get("ranks", [])
    rows = []
    for rank in each:
        results = rank["for_results"]
        rows.append(RankRow(
            scene=name, ranks=ranks, all_blocks=summary["blocks"], blocks=rank["blocks"], ghosts=rank["ghosts"],
            points=rank["contact_points"] / steps, iterations=counts["open_close_iterations"] / steps,
            unknowns=rank["unknowns"], solutions=rank["shared_systems"]["solutions"] / steps,
            calls=(rank["collective_calls"] - results["collective_calls"]) / steps,
            messages=(rank["messages_sent"] - results["messages_sent"]) / steps,
            bytes=(rank["bytes_sent"] - results["bytes_sent"]) / steps, result_bytes=results["bytes_sent"] / steps,
            own=rank["processor_seconds"]["own_part"] / steps, shared=rank["processor_seconds"]["shared_systems"] / steps,
            waiting=rank["processor_seconds"]["in_messages"] / steps, memory=rank["peak_memory_bytes"]))
    return RunRow(name, ranks, summary["blocks"], steps, sum(phases.values()), phases,
                  summary.get("rank_imbalance", 0.0), max([row.memory for row in rows] or [summary.get("peak_memory_bytes", 0)]), rows)


def run(mpiexec, ashlar, name, ranks, steps, longest):
    with tempfile.TemporaryDirectory() as kept:
        folder = pathlib.Path(kept)
        scene = folder / "scene.toml"
        scene.write_text(scene_text(name, steps), encoding="utf-8")
        words = [*shlex.split(mpiexec), "-n", str(ranks), ashlar, "run", str(scene), "--quiet", "--checkpoint", "1e9",
                 "--out", str(folder / "out")]
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=longest)
        if done.returncode != 0:
            raise RuntimeError(f"{name} on {ranks} ranks: status {done.returncode}\n{done.stderr}")
        summary = json.loads((folder / "out" / "summary.json").read_text(encoding="utf-8"))
    row = rows_of(name, ranks, summary)
    print(f"{name} on {ranks}: {row.wall:.3g} s a step", file=sys.stderr, flush=True)
    return row


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def most(rows, name):
    return max((getattr(row, name) for row in rows), default=0)


def times_table(runs):
    """Wall time of a step by phase, against the first run of the same scene."""
    base = {}
    result = []
    for run_row in runs:
        first = base.setdefault(run_row.scene, run_row)
        result.append((run_row.scene, run_row.all_blocks, run_row.ranks, f"{run_row.wall:.3g}",
                       f"{first.wall / run_row.wall:.2f}",
                       *(f"{run_row.phases.get(phase, 0.0):.3g}" for phase in ("contact_search", "contact_points", "solve")),
                       f"{100 * run_row.imbalance:.0f} %", f"{run_row.memory / 2**20:.0f}"))
    return table(("scene", "blocks", "ranks", "step, s", "speed-up", "search", "points", "solve", "imbalance",
                  "memory of a rank, MiB"), result)


def counts_table(runs):
    """Work and traffic of the busiest rank, a step."""
    result = []
    for run_row in runs:
        rows = run_row.rows
        if not rows:
            continue
        result.append((run_row.scene, run_row.ranks, most(rows, "blocks"), most(rows, "ghosts"),
                       f"{most(rows, 'points'):.0f}", f"{rows[0].iterations:.1f}", f"{rows[0].solutions:.1f}",
                       f"{most(rows, 'calls'):.0f}", f"{most(rows, 'messages'):.0f}", f"{most(rows, 'bytes') / 1e3:.0f}",
                       f"{most(rows, 'own') * 1e3:.1f}", f"{most(rows, 'memory') / 2**20:.0f}"))
    return table(("scene", "ranks", "blocks", "ghosts", "points", "iterations", "solutions", "calls", "messages", "kB sent",
                  "own part, ms", "memory, MiB"), result)


def model_text(rows):
    """Fitted coefficients, and the step of 10^6 blocks on 1000 cores."""
    fit = cost_model.fitted(rows)
    lines = [table(("fitted", "coefficient", "value", "largest error of a rank"),
                   [(quantity, name, f"{value:.3g}", f"{100 * error:.0f} %")
                    for quantity, (values, error) in fit.items() for name, value in values.items()])]
    cubes = [row for row in rows if row.scene.startswith("cube")] or rows
    last = max(cubes, key=lambda row: row.all_blocks)
    run_rows = [row for row in cubes if row.scene == last.scene and row.ranks == last.ranks]
    per_block = {"points": sum(row.points for row in run_rows) / last.all_blocks, "iterations": last.iterations,
                 "solutions": last.solutions}
    lines.append(table(("assumed", "value", "source"),
                       [(name, f"{value:.3g}", source) for name, (value, source) in cost_model.ASSUMED.items()]
                       + [("points of a block", f"{per_block['points']:.1f}", last.scene),
                          ("iterations, solutions of a step", f"{per_block['iterations']:.1f}, {per_block['solutions']:.1f}",
                           f"{last.scene}; assumed not to grow with the number of blocks")]))
    cases = [(10**6, ranks) for ranks in (1, 10, 100, 1000)]
    steps = [cost_model.step_on(fit, blocks, ranks, per_block) for blocks, ranks in cases]
    parts = [part for part in steps[0] if part != "memory"]
    lines.append(table(("blocks", "ranks", *(f"{part}, s" for part in parts), "step, s", "memory of a rank, GiB"),
                       [(f"{blocks:,}", ranks, *(f"{step[part]:.3g}" for part in parts),
                         f"{sum(step[part] for part in parts):.3g}", f"{step['memory'] / 2**30:.1f}")
                        for (blocks, ranks), step in zip(cases, steps)]))
    return "\n".join(lines)


def listed(text, of=str):
    return [of(item) for item in text.split(",") if item]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mpiexec")
    parser.add_argument("ashlar")
    parser.add_argument("--scenes", default="wall:10,wall:20,cube:6", type=listed)
    parser.add_argument("--ranks", default="1,2,4", type=lambda text: listed(text, int))
    parser.add_argument("--many", default="8,16,32,64", type=lambda text: listed(text, int))
    parser.add_argument("--many-scene", default="wall:10")
    parser.add_argument("--weak", default="wall:10@1,wall:14@2,wall:20@4", type=listed)
    parser.add_argument("--steps", default=5, type=int)
    parser.add_argument("--longest", default=3600, type=float, help="seconds of a run")
    parser.add_argument("--markdown", type=pathlib.Path)
    options = parser.parse_args()

    def runs(cases):
        """Those that ended well: one that has failed is told, and left out."""
        done = []
        for name, ranks in cases:
            try:
                done.append(run(options.mpiexec, options.ashlar, name, ranks, options.steps, options.longest))
            except (RuntimeError, subprocess.TimeoutExpired) as error:
                print(f"{name} on {ranks} is left out: {error}", file=sys.stderr, flush=True)
        return done

    strong = runs([(name, ranks) for name in options.scenes for ranks in options.ranks])
    weak = runs([(name, int(ranks)) for name, ranks in (case.split("@") for case in options.weak)])
    many = runs([(options.many_scene, ranks) for ranks in options.many])
    text = "## Strong scaling\n\n" + times_table(strong)
    if weak:
        text += "\n## Weak scaling\n\n" + times_table(weak)
    text += "\n## Counts of the busiest rank, a step\n\n" + counts_table(strong + many)
    rows = [row for run_row in strong + weak + many for row in run_row.rows]
    if rows:
        text += "\n## Model\n\n" + model_text(rows)
    if options.markdown:
        options.markdown.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
