"""A model of the time of a step on several ranks, fitted to runs of scaling.py.

Of one rank, for a step:
    own      = start + block * (own blocks) + ghost * ghosts + point * (contact points made) * (iterations)
               of processor time; start is that of the program over the steps of a run, which a long run does not have
    memory   = base + of_own * (own blocks + ghosts) + of_all * (all blocks)
    bytes    = per_ghost * ghosts + per_solution * ghosts * solutions + per_call * (ranks - 1) * calls
               sent, without results and checkpoints
    calls    = first + per_iteration * iterations + per_solution * solutions    of collective functions
and of the run
    step = largest own + solutions * linear + calls * latency * log2(ranks) + bytes / bandwidth
           + (share of steps that look for ghosts) * box_bytes * (all blocks) / bandwidth
    linear = unknowns of a rank * (set_up + gradient_iterations * per_iteration) + gradient_iterations * 3 latency log2(ranks)
Coefficients of the first four come from the runs by non-negative least squares of relative errors; those of the last two
are assumptions, with their source beside them.
"""
import math

ASSUMED = {
    "latency": (2e-6, "s, of one hop of a collective call: usual for clusters, not measured here"),
    "bandwidth": (5e9, "bytes/s of a rank: a quarter of a link of 200 Gbit/s"),
    "set_up": (1.2e-4, "s per unknown: multigrid of 49,152 unknowns on one rank, solver/notes/rank_solver.md"),
    "per_iteration": (3.6e-6, "s per unknown, the same: memory bound, and no slower with all cores of a machine"),
    "gradient_iterations": (104, "of a solution, the same: hardly more from 12,000 to 96,000 unknowns, assumed so beyond"),
    "box_bytes": (57, "of a block in the search for ghosts"),
}


def least_squares(rows, values, sweeps=20000):
    """Coefficients >= 0 of least sum of squares of (row . x) / value - 1. Rows of value 0 are left out."""
    scaled = [[entry / value for entry in row] for row, value in zip(rows, values) if value > 0]
    if not scaled:
        raise ValueError("no rows with a value above zero")
    size = len(scaled[0])
    normal = [[sum(row[i] * row[j] for row in scaled) for j in range(size)] for i in range(size)]
    right = [sum(row[i] for row in scaled) for i in range(size)]
    x = [0.0] * size
    for _ in range(sweeps):
        change = 0.0
        for i in range(size):
            if normal[i][i] == 0.0:
                continue
            new = max(0.0, x[i] + (right[i] - sum(normal[i][j] * x[j] for j in range(size))) / normal[i][i])
            change = max(change, abs(new - x[i]) * math.sqrt(normal[i][i]))
            x[i] = new
        if change < 1e-13:
            break
    return x


def worst(rows, values, x):
    """Largest relative error of a fit."""
    return max((abs(sum(a * b for a, b in zip(row, x)) / value - 1.0)
                for row, value in zip(rows, values) if value > 0), default=0.0)


# Fitted quantities by name: regressors and value of a rank of a run (scaling.RankRow).
FITS = {
    "own": (("start", "block", "ghost", "point"), lambda r: (1.0, r.blocks, r.ghosts, r.points * r.iterations),
            lambda r: r.own),
    "memory": (("base", "of_own", "of_all"), lambda r: (1.0, r.blocks + r.ghosts, r.all_blocks), lambda r: r.memory),
    "bytes": (("per_ghost", "per_solution", "per_call"),
              lambda r: (r.ghosts, r.ghosts * r.solutions, (r.ranks - 1) * r.calls), lambda r: r.bytes),
    "calls": (("first", "per_iteration", "per_solution"), lambda r: (1.0, r.iterations, r.solutions), lambda r: r.calls),
}


def fitted(ranks):
    """{quantity: ({coefficient: value}, worst relative error)} of rows of ranks of runs on at least 2 ranks."""
    result = {}
    for name, (names, row_of, value_of) in FITS.items():
        rows, values = [row_of(r) for r in ranks], [value_of(r) for r in ranks]
        x = least_squares(rows, values)
        result[name] = (dict(zip(names, x)), worst(rows, values, x))
    return result


def ghosts_of_cube(blocks):
    """Blocks in one layer around a cube of blocks."""
    side = blocks ** (1.0 / 3.0)
    return (side + 2.0) ** 3 - blocks


def step_on(fit, blocks, ranks, per_block, unknowns=12, searches=0.02, assumed=None):
    """Seconds of a step by part, and bytes of memory, of a rank of a large cut cube, shared out in cubes.
    @param per_block {"points", "iterations", "solutions"}: points of a block; iterations and solutions of a step"""
    a = {name: value for name, (value, _) in ASSUMED.items()}
    a.update(assumed or {})
    own = blocks / ranks
    ghosts = ghosts_of_cube(own)
    hops = math.log2(ranks) if ranks > 1 else 0.0
    of = {name: values for name, (values, _) in fit.items()}
    calls = of["calls"]["first"] + of["calls"]["per_iteration"] * per_block["iterations"]
    calls += of["calls"]["per_solution"] * per_block["solutions"]
    sent = (of["bytes"]["per_ghost"] + of["bytes"]["per_solution"] * per_block["solutions"]) * ghosts
    sent += of["bytes"]["per_call"] * (ranks - 1) * calls
    linear = unknowns * own * (a["set_up"] + a["gradient_iterations"] * a["per_iteration"])
    linear += a["gradient_iterations"] * 3 * a["latency"] * hops
    return {
        "own part": of["own"]["block"] * own + of["own"]["ghost"] * ghosts
        + of["own"]["point"] * per_block["points"] * own * per_block["iterations"],
        "linear systems": per_block["solutions"] * linear,
        "waiting for collective calls": calls * a["latency"] * hops,
        "bytes": sent / a["bandwidth"],
        "search for ghosts": searches * a["box_bytes"] * blocks / a["bandwidth"],
        "memory": of["memory"]["base"] + of["memory"]["of_own"] * (own + ghosts) + of["memory"]["of_all"] * blocks,
    }
