#!/usr/bin/env python3
"""Writes the scenes of this folder that consist of many like blocks. Run in this folder; the output is kept beside it."""
import math
import random

HEAD = """{story}title = "{title}"

[analysis]
type = "{kind}"
end_time = {end}
time_step = {step}

[contact]
{contact}
[[material]]
name = "stone"
density = 2500
young_modulus = {modulus}
poisson_ratio = 0.2
"""


def numbers(point):
    return "[" + ", ".join(f"{x:.9g}" for x in point) + "]"


def box(name, low, high, extra="", fixed=False):
    state = "fixed = true" if fixed else 'material = "stone"'
    return f'\n[[block]]\nname = "{name}"\n{state}\nbox = {{ min = {numbers(low)}, max = {numbers(high)} }}\n{extra}'


def hull(name, points, extra="", fixed=False):
    state = "fixed = true" if fixed else 'material = "stone"'
    rows = ",\n".join("  " + numbers(point) for point in points)
    return f'\n[[block]]\nname = "{name}"\n{state}\nhull = {{ points = [\n{rows}\n] }}\n{extra}'


def story(text):
    return "".join(f"# {line}\n" if line else "#\n" for line in text.strip().split("\n"))


def output(every, measures=()):
    text = ""
    for name, block, point in measures:
        text += f'\n[[measure]]\nname = "{name}"\nblock = "{block}"\npoint = {numbers(point)}\n'
    return text + f'\n[output]\nevery = {every}\nfields = ["displacement", "velocity"]\n'


def write(name, text):
    picture = name.replace(".toml", ".png")
    text = text.replace('title = "', f'#\n# Picture: data/pictures/{picture}\ntitle = "', 1)
    with open(name, "w", encoding="utf-8") as file:
        file.write("#:schema ../scene.schema.json\n" + text)


def contact(kn, ks, friction, springs="area"):
    return f'springs = "{springs}"\nnormal_stiffness = {kn}\nshear_stiffness = {ks}\nfriction_angle = {friction}\n'


def columns():
    result = HEAD.format(
        story=story("""
Columns that topple: Goodman and Bray's example, 16 columns on a stepped base that dips 30 degrees.

The high columns in the middle turn over and push the low ones at the toe, which slide. Limit equilibrium puts the
friction angle that just holds them at 38.1 degrees; here it is 33, and the slope fails.
"""), title="Toppling columns", kind="dynamic", end=3.0, step="2e-3", contact=contact("1e11", "1e11", 33, "point"),
        modulus="1e10")
    turn = "rotate = { axis = [0, 1, 0], angle = -30 }\n"
    height = 0.0
    for n in range(1, 17):
        height += 4.0 if n <= 10 else -6.2
        x, base = 10.0 * (n - 1), n - 1.0
        result += box(f"step{n}", (x, -5, base - 5), (x + 10, 15, base), turn, fixed=True)
        result += box(f"column{n}", (x, 0, base), (x + 10, 10, base + height), turn)
    angle = math.radians(30)
    x, z = 95.0, 49.0
    top = (x * math.cos(angle) - z * math.sin(angle), 5, x * math.sin(angle) + z * math.cos(angle))
    write("columns.toml", result + output(25, [("highest", "column10", top)]))


def tower():
    # From rest to 0.3 m and back: u = 0.15 (1 - cos(2 pi t)).
    peak = 0.15 * (2 * math.pi) ** 2
    times = [k / 16 for k in range(65)]
    history = ", ".join(f"[{t:.9g}, {peak * math.cos(2 * math.pi * t):.4f}, 0, 0]" for t in times)
    result = HEAD.format(
        story=story("""
Ten cubes on a base that shakes.

The base follows a record of accelerations, 0.3 m to and fro once a second: up to 5.9 m/s^2, more than friction of
30 degrees hands on (5.7 m/s^2). The lower cubes are dragged along, the upper ones lag behind and hang over further
with each period, until the tower breaks, in the fourth second, and comes down. The base stops after four seconds;
its work is in energy.applied.
"""), title="A tower on a shaking base", kind="dynamic", end=5.5, step="2e-3", contact=contact("5e9", "2e9", 30),
        modulus="1e10")
    fixes = ""
    for z, n in ((-0.5, -1), (0, 1)):
        fixes += (f"\n  [[block.fix]]\n  plane = {{ point = [0, 0, {z}], normal = [0, 0, {n}] }}\n"
                  f"  acceleration_history = [{history}]\n")
    result += box("base", (-3, -2, -0.5), (3, 2, 0), fixes)
    for k in range(10):
        result += box(f"cube{k + 1}", (-0.25, -0.25, 0.5 * k), (0.25, 0.25, 0.5 * (k + 1)))
    write("shaken_tower.toml", result + output(20, [("top", "cube10", (0, 0, 5)), ("base", "base", (0, 0, 0))]))


def rockfall():
    rng = random.Random(1010)
    result = HEAD.format(
        story=story("""
Rockfall: thirty stones of random shape let go above a slope.

Each stone is the hull of random points, 0.4 to 0.9 m across. They drop onto a slope of 40 degrees, bounce, roll and
slide down to a level ground with a wall at its end that stops them.
"""), title="Rockfall", kind="dynamic", end=3.0, step="2e-3", contact=contact("2e9", "1e9", 30), modulus="5e9")
    result += hull("slope", [(x, y, z) for y in (-6, 6) for x, z in ((0, 10.07), (12, 0), (12, -1), (-1, -1), (-1, 10.07))],
                   fixed=True)
    result += box("ground", (12, -6, -1), (24, 6, 0), fixed=True)
    result += box("wall", (24, -6, -1), (25, 6, 3), fixed=True)
    for k in range(30):
        row, column = divmod(k, 5)
        center = (1.0 + 1.3 * row, -3.0 + 1.5 * column + rng.uniform(-0.15, 0.15), 0.0)
        ground = 10.07 * (1 - center[0] / 12)
        radius = rng.uniform(0.2, 0.45)
        points = []
        for _ in range(14):
            d = [rng.gauss(0, 1) for _ in range(3)]
            size = math.sqrt(sum(x * x for x in d))
            points.append((center[0] + radius * d[0] / size, center[1] + radius * d[1] / size,
                           ground + 1.3 + radius * d[2] / size))
        result += hull(f"stone{k + 1}", [tuple(round(x, 4) for x in p) for p in points])
    write("rockfall.toml", result + output(20))


def wedge():
    def normal(dip, direction):
        a, b = math.radians(dip), math.radians(direction)
        return (math.sin(a) * math.sin(b), math.sin(a) * math.cos(b), math.cos(a))
    def cross(u, v):
        return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    def dot(u, v):
        return sum(x * y for x, y in zip(u, v))
    def plus(*terms):
        return tuple(sum(s * v[k] for s, v in terms) for k in range(3))
    n1, n2 = normal(40, 130), normal(60, 220)
    line = cross(n1, n2)
    size = math.sqrt(dot(line, line)) * (1 if line[2] < 0 else -1)
    line = tuple(x / size for x in line)
    d1, d2 = cross(n1, line), cross(n2, line)
    d1 = d1 if dot(d1, n2) > 0 else plus((-1, d1))
    d2 = d2 if dot(d2, n1) > 0 else plus((-1, d2))
    result = HEAD.format(
        story=story("""
A rock wedge on two joint planes, 40/130 and 60/220 (dip/dip direction), that slides along their line of intersection.

The friction angle that just holds it is 33.36 degrees; here it is 20, and the wedge goes down the line with
0.269 g: 1.32 m in the first second.
"""), title="Wedge", kind="dynamic", end=1.0, step="2e-3", contact=contact("2e10", "1e8", 20), modulus="1e10")
    for name, n, d in (("plane1", n1, d1), ("plane2", n2, d2)):
        result += hull(name, [plus((a, line), (u, d), (-h, n)) for a in (-3, 9) for u in (-0.5, 3) for h in (0, 1)],
                       fixed=True)
    result += hull("wedge", [p for a in (-1, 1)
                             for p in (plus((a, line)), plus((a, line), (1, d1)), plus((a, line), (1, d2)))])
    tip = plus((1, line))
    write("wedge.toml", result + output(10, [("tip", "wedge", tip)]))


def pulses():
    # Under half a sine, so that the base is at rest at its end.
    with open("pulses.csv", "w", encoding="utf-8") as file:
        file.write("# Acceleration of a base in g: three cycles of 1 Hz that grow and fade.\nt,a\n")
        for k in range(301):
            t = k / 100
            file.write(f"{t:.2f},{0.35 * math.sin(math.pi * t / 3) * math.sin(2 * math.pi * t):.5f}\n")


if __name__ == "__main__":
    pulses()
    columns()
    tower()
    rockfall()
    wedge()
