"""Random dry structures that are pushed or tilted: walls, arches, portals of rigid or elastic blocks.

A structure is a dictionary: blocks (name, shape in a scene, volume in m^3, centroid in m), fixed blocks likewise, friction (degrees),
hinges (true: collapses about edges of blocks), side (unit vector of the side loads), length (m, size of a block), tilt (side gravity, in g), kind (analysis.type), label.
"""
import math

DENSITY, G = 2500.0, 9.81

HEAD = """title = "structure"
analysis = {{ {analysis} }}
contact = {{ friction_angle = {friction!r}{contact} }}
output = {{ every = 1000000 }}
material = [{{ name = "stone", density = 2500, young_modulus = 1e10, poisson_ratio = 0.2 }}]
block = [
"""


def box(low, high):
    """Shape, volume and centroid of a box."""
    return (f"box = {{ min = {list(low)}, max = {list(high)} }}", math.prod(b - a for a, b in zip(low, high)),
            [0.5 * (a + b) for a, b in zip(low, high)])


def voussoir(first, second, inner, outer, depth):
    """A part of a ring about the y axis between two angles (radians) and two radii, its faces flat."""
    corners = [(r * math.cos(a), r * math.sin(a)) for a, r in
               ((first, inner), (first, outer), (second, outer), (second, inner))]
    area = x = z = 0.0
    for (xa, za), (xb, zb) in zip(corners, corners[1:] + corners[:1]):
        part = 0.5 * (xa * zb - xb * za)
        area, x, z = area + part, x + part * (xa + xb) / 3, z + part * (za + zb) / 3
    points = [[px, y, pz] for px, pz in corners for y in (0.0, depth)]
    return f"hull = {{ points = {points} }}", abs(area) * depth, [x / area, 0.5 * depth, z / area]


def ground():
    return [("ground", box((-9, -9, -1), (9, 9, 0)))]


def wall_of(r):
    """A wall of 9 to 36 bricks in running or stack bond, pushed or tilted along or across its plane."""
    while True:
        length, height, depth = r.uniform(0.3, 0.6), r.uniform(0.12, 0.3), r.uniform(0.15, 0.35)
        running, courses, of_bricks = r.random() < 0.67, r.randint(3, 7), r.choice([2, 2.5, 3, 3.5, 4, 4.5])
        boxes, whole = [], length * of_bricks
        for course in range(courses):
            shift = 0.5 if running and course % 2 else 1.0
            edges = [0.0]
            while (shift + len(edges) - 1) * length < whole * (1 - 1e-9):
                edges.append((shift + len(edges) - 1) * length)
            edges.append(whole)
            boxes += [((a, 0.0, course * height), (b, depth, (course + 1) * height)) for a, b in zip(edges, edges[1:])]
        if 9 <= len(boxes) <= 36:
            break
    in_plane = r.random() < 0.67
    side = (1.0, 0.0, 0.0) if in_plane else (0.0, 1.0, 0.0)
    if r.random() < 0.5:
        side = tuple(-x for x in side)
    friction = r.uniform(25.0, 45.0)
    arm = (whole if in_plane else depth) / (courses * height)
    tilt = r.uniform(0.4, 0.9) * min(math.tan(math.radians(friction)), arm)
    return {"blocks": [(f"b{n}", box(*corners)) for n, corners in enumerate(boxes)], "fixed": ground(),
            "friction": friction, "side": side, "length": length, "tilt": tilt,
            "kind": r.choice(["capacity", "factor-of-safety"]), "hinges": False,
            "label": f'{len(boxes)} bricks, {"in" if in_plane else "out of"} plane'}


def arch_of(r):
    """An arch of 7 to 15 voussoirs on fixed springers, pushed to its side."""
    inner = r.uniform(1.0, 3.0)
    outer, depth, count = inner * r.uniform(1.14, 1.3), r.uniform(0.5, 1.0), r.randint(7, 15)
    first = math.radians(r.uniform(0.0, 35.0))
    angle = (math.pi - 2 * first) / count
    part = [voussoir(first + n * angle, first + (n + 1) * angle, inner, outer, depth) for n in range(-1, count + 1)]
    side = (r.choice([-1.0, 1.0]), 0.0, 0.0)
    friction = r.uniform(30.0, 45.0)
    return {"blocks": [(f"v{n}", one) for n, one in enumerate(part[1:-1])],
            "fixed": [("left", part[-1]), ("right", part[0])], "friction": friction, "side": side,
            "length": min(outer - inner, angle * inner), "tilt": 0.0, "kind": "capacity", "hinges": True,
            "label": f"arch of {count}"}


def portal_of(r):
    """Two piers of 2 to 5 blocks under a lintel, pushed to its side."""
    width, height, depth = r.uniform(0.4, 0.8), r.uniform(0.3, 0.8), r.uniform(0.4, 0.8)
    count, span, rise = r.randint(2, 5), r.uniform(1.0, 2.5), r.uniform(0.3, 0.6)
    blocks = []
    for side, left in (("left", 0.0), ("right", width + span)):
        blocks += [(f"{side}{n}", box((left, 0.0, n * height), (left + width, depth, (n + 1) * height)))
                   for n in range(count)]
    top = count * height
    blocks.append(("lintel", box((0.0, 0.0, top), (2 * width + span, depth, top + rise))))
    return {"blocks": blocks, "fixed": ground(), "friction": r.uniform(25.0, 45.0),
            "side": (r.choice([-1.0, 1.0]), 0.0, 0.0), "length": min(width, height), "tilt": 0.0, "kind": "capacity",
            "hinges": True, "label": f"portal of {len(blocks)}"}


FAMILIES = {"walls": wall_of, "arches": arch_of, "portals": portal_of}


def gravity_of(structure):
    share = structure["tilt"] if structure["kind"] != "capacity" else 0.0
    return [share * G * structure["side"][0], share * G * structure["side"][1], -G]


def scene_of(structure, analysis, order, friction, history=None, contact=""):
    """@param history of the side loads, each the weight of its block; @param contact more keys"""
    text = HEAD.format(analysis=analysis, friction=friction, contact=contact)
    for name, (shape, _, _) in structure["fixed"]:
        text += f'  {{ name = "{name}", fixed = true, {shape} }},\n'
    for name, (shape, volume, place) in structure["blocks"]:
        text += f'  {{ name = "{name}", material = "stone", order = {order}, {shape}'
        if structure["kind"] == "capacity":
            force = [DENSITY * G * volume * x for x in structure["side"]]
            when = f", history = {history}" if history else ""
            text += f", load = [{{ point = {place}, force = {force}{when} }}]"
        text += " },\n"
    return text + "]\n"
