"""Random scenes of one block that lands on fixed ground with concave edges.

A scene is made in metres with z upwards; then it is scaled and turned as a whole, gravity too, and written as
scene.toml with its meshes. Scene k of a seed depends on nothing but the two numbers.
"""
import math
import os
import random

from solids import centred, dot, hull, moved, prism, quad, random_rotation, rotation, torus, turned, volume

GROUNDS = ["slope", "groove", "pit", "ridge", "stairs", "terrain", "ring"]
BLOCKS = ["cube", "hull", "tetrahedron", "ell", "ring"]
DEPTH = 1.0  # m, of ground below its lowest surface


# --- grounds: each gives the mesh and (x, y), a place over its concave edges

def on_base(top, width):
    """The prism below a line of (x, z) that runs towards larger x, with a flat bottom."""
    low = min(z for _, z in top) - DEPTH
    return prism([(top[0][0], low), (top[-1][0], low)] + top[::-1], width)


def slope(rng):
    """A slope that ends in a flat."""
    angle, width = math.radians(rng.uniform(20, 65)), rng.uniform(2, 4)
    top = [(-2.0, 2 * math.tan(angle)), (0.0, 0.0), (2.0, 0.0)]
    return on_base(top, width), (rng.uniform(-0.4, 0.1), 0.3 * width * rng.uniform(-1, 1))


def groove(rng):
    """Two slopes that meet in a line."""
    left, right = (math.tan(math.radians(rng.uniform(15, 65))) for _ in range(2))
    width = rng.uniform(2, 4)
    top = [(-1.5, 1.5 * left), (0.0, 0.0), (1.5, 1.5 * right)]
    return on_base(top, width), (rng.uniform(-0.3, 0.3), 0.3 * width * rng.uniform(-1, 1))


def ridge(rng):
    """A roof on a flat: a convex line between two concave ones."""
    half, high = rng.uniform(0.3, 0.9), rng.uniform(0.2, 0.8)
    top = [(-2.0, 0.0), (-half, 0.0), (rng.uniform(-0.3, 0.3) * half, high), (half, 0.0), (2.0, 0.0)]
    return on_base(top, 3.0), (rng.uniform(-1.3, 1.3) * half, rng.uniform(-0.8, 0.8))


def stairs(rng):
    """Steps with upright or leaning risers."""
    run, rise, lean = rng.uniform(0.2, 0.8), rng.uniform(0.15, 0.5), rng.choice([0.0, 0.1])
    top = [(-2.5, 0.0)]
    for i in range(4):
        top += [(-1 + i * run, i * rise), (-1 + i * run + lean * rise, (i + 1) * rise)]
    top.append((2.5, 4 * rise))
    return on_base(top, 3.0), (-1 + rng.choice([0, 1, 2, 3]) * run - rng.uniform(0, 0.3), rng.uniform(-0.8, 0.8))


def pit(rng):
    """A box with a pit in its top: a pyramid upside down, its frustum, or a box."""
    half, deep = rng.uniform(0.25, 0.6), rng.uniform(0.2, 0.7)
    share = rng.choice([0.0, rng.uniform(0.2, 0.9), 1.0])
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    points = [(1.5 * x, 1.5 * y, -deep - DEPTH) for x, y in square] + [(1.5 * x, 1.5 * y, 0.0) for x, y in square]
    points += [(half * x, half * y, 0.0) for x, y in square]
    triangles = quad(3, 2, 1, 0)
    for i in range(4):
        j = (i + 1) % 4
        triangles += quad(i, j, 4 + j, 4 + i) + quad(4 + i, 4 + j, 8 + j, 8 + i)
    if share == 0:
        points.append((0.3 * half * rng.uniform(-1, 1), 0.3 * half * rng.uniform(-1, 1), -deep))
        triangles += [(8 + i, 8 + (i + 1) % 4, 12) for i in range(4)]
    else:
        points += [(share * half * x, share * half * y, -deep) for x, y in square]
        for i in range(4):
            j = (i + 1) % 4
            triangles += quad(8 + i, 8 + j, 12 + j, 12 + i)
        triangles += quad(12, 13, 14, 15)
    return (points, triangles), (0.8 * half * rng.uniform(-1, 1), 0.8 * half * rng.uniform(-1, 1))


def terrain(rng):
    """A height field of 2 x 10 x 10 triangles, cells about as large as the block."""
    n, cell, high = 10, rng.uniform(0.2, 0.4), rng.uniform(0.1, 0.3)
    xy = [((i - n / 2) * cell, (j - n / 2) * cell) for i in range(n + 1) for j in range(n + 1)]
    points = [(x, y, rng.uniform(0, high)) for x, y in xy] + [(x, y, -DEPTH) for x, y in xy]
    row, under, triangles = n + 1, (n + 1) ** 2, []
    for i in range(n):
        for j in range(n):
            a, b, c, d = i * row + j, (i + 1) * row + j, (i + 1) * row + j + 1, i * row + j + 1
            if rng.random() < 0.5:
                a, b, c, d = b, c, d, a
            triangles += quad(a, b, c, d) + quad(under + d, under + c, under + b, under + a)
    rim = [i * row for i in range(n)] + [n * row + j for j in range(n)]
    rim += [i * row + n for i in range(n, 0, -1)] + list(range(n, 0, -1))
    for a, b in zip(rim, rim[1:] + rim[:1]):
        triangles += quad(a, under + a, under + b, b)
    return (points, triangles), (2 * cell * rng.uniform(-1, 1), 2 * cell * rng.uniform(-1, 1))


PLAIN_GROUNDS = {"slope": slope, "groove": groove, "ridge": ridge, "stairs": stairs, "pit": pit, "terrain": terrain}


# --- falling blocks: about 0.3 to 0.5 m, with the centroid at the origin

def falling_block(kind, rng):
    """The block in a random position: mostly turned at will, now and then only about the vertical."""
    size = rng.uniform(0.3, 0.5)
    if kind == "cube":
        mesh = prism([(0, 0), (1, 0), (1, 1), (0, 1)], 1.0)
    elif kind == "hull":
        directions = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(rng.randint(8, 14))]
        mesh = hull([tuple(0.65 * x / math.sqrt(dot(d, d)) * rng.uniform(0.8, 1.0) for x in d) for d in directions])
    elif kind == "tetrahedron":
        corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
        mesh = hull([tuple(0.5 * x + rng.uniform(-0.12, 0.12) for x in p) for p in corners])
    elif kind == "ell":
        t = rng.uniform(0.3, 0.5)
        mesh = prism([(0, 0), (1.2, 0), (1.2, t), (t, t), (t, 1.2), (0, 1.2)], rng.uniform(0.4, 0.8))
    else:
        mesh = torus(0.5, 0.125 * rng.uniform(1.0, 1.4))
    points, triangles = centred(mesh)
    flat = rng.random() < 1 / 6
    rows = rotation((0, 0, 1), rng.uniform(0, 2 * math.pi)) if flat else random_rotation(rng)
    return turned([tuple(size * x for x in p) for p in points], rows), triangles


# --- lowering the block until it touches

def plan_height(triangle, x, y):
    """z of the triangle above or below (x, y), None where it has no point or stands upright."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangle
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return None
    b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    return az + b * (bz - az) + c * (cz - az) if b >= 0 and c >= 0 and b + c <= 1 else None


def plan_crossing(p, q, r, s):
    """z of the lines pq and rs where they cross when seen from above, None if they do not."""
    ux, uy, vx, vy = q[0] - p[0], q[1] - p[1], s[0] - r[0], s[1] - r[1]
    det = ux * vy - uy * vx
    if det == 0:
        return None
    a = ((r[0] - p[0]) * vy - (r[1] - p[1]) * vx) / det
    b = ((r[0] - p[0]) * uy - (r[1] - p[1]) * ux) / det
    if not (0 <= a <= 1 and 0 <= b <= 1):
        return None
    return p[2] + a * (q[2] - p[2]), r[2] + b * (s[2] - r[2])


def corners_and_edges(triangles):
    corners = {p for t in triangles for p in t}
    edges = {(min(p, q), max(p, q)) for t in triangles for p, q in zip(t, t[1:] + t[:1])}
    return corners, edges


def way_down(block, ground):
    """Distance by which the block above the ground can fall before contact; inf if it never touches it."""
    box = [(min(p[k] for p in block[0]), max(p[k] for p in block[0])) for k in (0, 1)]

    def near(points):
        return all(max(p[k] for p in points) >= box[k][0] and min(p[k] for p in points) <= box[k][1] for k in (0, 1))

    upper = [tuple(block[0][i] for i in t) for t in block[1]]
    lower = [t for t in (tuple(ground[0][i] for i in t) for t in ground[1]) if near(t)]
    upper_corners, upper_edges = corners_and_edges(upper)
    lower_corners, lower_edges = corners_and_edges(lower)
    gaps = []
    for corners, triangles, sign in ((upper_corners, lower, 1), (lower_corners, upper, -1)):
        for x, y, z in corners:
            heights = (plan_height(t, x, y) for t in triangles)
            gaps += [sign * (z - height) for height in heights if height is not None]
    for p, q in upper_edges:
        for r, s in (e for e in lower_edges if near(e)):
            heights = plan_crossing(p, q, r, s)
            if heights:
                gaps.append(heights[0] - heights[1])
    return min((gap for gap in gaps if gap > 0), default=math.inf)


def over(ground, block, place):
    """The block, high above a place of the ground."""
    top = max(p[2] for p in ground[0])
    return moved(block[0], (*place, top - min(p[2] for p in block[0]) + 1)), block[1]


def ring_scene(kind, rng):
    """A fixed ring, and a block above it, in its hole, or (a ring) hanging from it like the next link of a chain."""
    block = falling_block(kind, rng)
    reach = math.sqrt(max(dot(p, p) for p in block[0]))
    tube = rng.uniform(0.1, 0.2)
    radius = tube + reach * rng.uniform(0.7, 1.3)
    if rng.random() < 0.5:  # lying
        ground, angle, r = torus(radius, tube), rng.uniform(0, 2 * math.pi), radius * rng.uniform(0, 1.1)
        return ground, over(ground, block, (r * math.cos(angle), r * math.sin(angle))), "lying"
    upright = rotation((1, 0, 0), math.pi / 2)
    if kind == "ring" and rng.random() < 0.6:
        radius, inner = rng.uniform(0.25, 0.35), rng.uniform(0.4, 0.55)
        points, triangles = torus(radius, 0.25 * radius)
        tilt = rotation([rng.gauss(0, 1) for _ in range(3)], math.radians(rng.uniform(0, 12)))
        points = turned(turned(points, rotation((0, 1, 0), math.pi / 2)), tilt)
        points, triangles = centred((points, triangles))
        ring = torus(3 * radius, inner * 0.75 * radius)
        return (turned(ring[0], upright), ring[1]), (moved(points, (0, 0, -3 * radius)), triangles), "linked"
    if rng.random() < 0.5:
        ring = torus(radius, tube)
        ground = turned(ring[0], upright), ring[1]
        return ground, over(ground, block, (0.8 * radius * rng.uniform(-1, 1), 0.6 * tube * rng.uniform(-1, 1))), "top"
    ring = torus(1.1 * (reach + tube) + 0.05, tube)
    return (turned(ring[0], upright), ring[1]), block, "hole"


# --- scenes

def settings(rng):
    """Variations besides the shapes. Times are proportional to the root of the scale, so that steps are similar at all scales."""
    step = rng.choice([1e-3, 1e-3, 1e-4])
    return {"augmented": rng.random() < 0.5, "order": rng.choice([1, 1, 2]), "time_step": step,
            "end_time": 0.08 if step == 1e-4 else round(rng.uniform(0.25, 0.5), 3),
            "every": 20 if step == 1e-4 else 10, "friction_angle": rng.choice([0, 30]),
            "scale": rng.choice([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.01, 100.0]), "turned": rng.random() < 1 / 3}


def make_scene(seed, index):
    """All of scene `index`: settings, meshes as they are written, gravity and velocity."""
    rng = random.Random(f"landings {seed} {index}")
    scene = {"index": index, "ground": GROUNDS[index % len(GROUNDS)], "block": rng.choice(BLOCKS), **settings(rng)}
    where = ""
    down = math.inf
    while math.isinf(down):  # it would fall through the hole of a ring
        if scene["ground"] == "ring":
            ground, block, where = ring_scene(scene["block"], rng)
        else:
            ground, place = PLAIN_GROUNDS[scene["ground"]](rng)
            block = over(ground, falling_block(scene["block"], rng), place)
        down = way_down(block, ground)
    highest = 0.01 if scene["time_step"] == 1e-4 else 0.05
    clearance = min(math.exp(rng.uniform(math.log(0.001), math.log(highest))), 0.9 * down)
    block = moved(block[0], (0, 0, clearance - down)), block[1]
    speed, heading = rng.uniform(0, 0.3), rng.uniform(0, 2 * math.pi)
    velocity = (speed * math.cos(heading), speed * math.sin(heading), 0.0)
    rows = random_rotation(rng) if scene["turned"] else [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    scale, pace = scene["scale"], math.sqrt(scene["scale"])
    scene.update(where=where, clearance=clearance * scale, time_step=scene["time_step"] * pace,
                 end_time=scene["end_time"] * pace, gravity=turned([(0, 0, -9.81)], rows)[0],
                 velocity=tuple(pace * x for x in turned([velocity], rows)[0]))
    for name, (points, triangles) in (("ground_mesh", ground), ("block_mesh", block)):
        scene[name] = turned(moved(points, (0, 0, 0), scale), rows), triangles
    scene["size"] = volume(scene["block_mesh"]) ** (1 / 3)
    return scene


def describe(scene):
    """The parameters of a scene in a line."""
    names = ["block", "order", "augmented", "friction_angle", "time_step", "end_time", "scale", "turned"]
    ground = scene["ground"] + (" " + scene["where"] if scene["where"] else "")
    values = " ".join(f"{name}={scene[name]:.4g}" if isinstance(scene[name], float) else f"{name}={scene[name]}"
                      for name in names)
    return f"{scene['index']:4d} {ground:12s} {values} size={scene['size']:.3g} clearance={scene['clearance']:.3g}"


def numbers(values):
    return "[" + ", ".join(repr(float(x)) for x in values) + "]"


def write_obj(path, mesh):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in (map(float, p) for p in mesh[0]))
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in mesh[1])


def write_scene(scene, folder):
    """Writes scene.toml and its meshes; returns the path of the scene."""
    os.makedirs(folder, exist_ok=True)
    write_obj(os.path.join(folder, "ground.obj"), scene["ground_mesh"])
    if scene["block"] in ("ell", "ring"):
        write_obj(os.path.join(folder, "stone.obj"), scene["block_mesh"])
        shape = 'mesh = { file = "stone.obj" }'
    else:
        rows = ",\n".join("  " + numbers(p) for p in scene["block_mesh"][0])
        shape = f"hull = {{ points = [\n{rows}\n] }}"
    path = os.path.join(folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""# {describe(scene)}
title = "landing {scene['index']}: {scene['block']} on {scene['ground']}"
[analysis]
end_time = {scene['end_time']!r}
time_step = {scene['time_step']!r}
gravity = {numbers(scene['gravity'])}
[contact]
friction_angle = {scene['friction_angle']}
augmented = {str(scene['augmented']).lower()}
[output]
every = {scene['every']}
[[material]]
name = "rock"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
mesh = {{ file = "ground.obj" }}
[[block]]
name = "stone"
material = "rock"
order = {scene['order']}
velocity = {numbers(scene['velocity'])}
{shape}
""")
    return path
