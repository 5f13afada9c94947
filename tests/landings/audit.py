"""Depths of blocks in each other, and rises of energy, from the files of a result folder alone.

Nothing that the program says about its contacts is used. Of each frame the drawn surfaces are read; a point is inside
a block if its winding number is not zero, and as deep as the nearest triangle is far. Asked are all drawn points
(corners, and with blocks of order 2 points between them) and points along the edges between faces, of each block in
each other.
"""
import csv
import json
import math
import os
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib

from solids import cross, dot, sub

SAMPLES = 7          # along each edge, without its ends
ALLOWED_SHARE = 1e-3  # of the size of a block, beyond what the program says that its springs hold
ENERGY_RISE = 1e-4   # of the span of the mechanical energy
DISAGREEMENT = 0.2, 1e-5  # of the depth, and of the size: what the program may say beside the audit

# Points are looked at through this map (of positive determinant), along its third coordinate: in a general
# direction, so that hardly ever a point lies in front of an edge. Which map it is does not matter.
VIEW = [(0.80, -0.53, 0.27), (0.47, 0.27, -0.84), (0.375, 0.80, 0.47)]


# --- reading frames

def arrays_of(path):
    """The arrays of a .vtu file with appended raw zlib blocks, as ashlar writes it: name -> tuple of numbers."""
    with open(path, "rb") as file:
        raw = file.read()
    head = raw[:raw.index(b"<AppendedData")]
    start = raw.index(b"_", len(head)) + 1
    codes = {b"Float64": "d", b"Float32": "f", b"Int32": "i", b"Int64": "q", b"UInt8": "B"}
    arrays = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)"[^>]*? offset="(\d+)"', head):
        at = start + int(offset)
        count = struct.unpack_from("<Q", raw, at)[0]
        sizes, at, data = struct.unpack_from(f"<{count}Q", raw, at + 24), at + 24 + 8 * count, []
        for size in sizes:
            data.append(zlib.decompress(raw[at:at + size]))
            at += size
        data, code = b"".join(data), codes[kind]
        arrays[name.decode()] = struct.unpack(f"<{len(data) // struct.calcsize(code)}{code}", data)
    return arrays


def frames_of(folder):
    """(time, path) of all frames."""
    entries = ElementTree.parse(os.path.join(folder, "blocks.pvd")).iter("DataSet")
    return [(float(e.get("timestep")), os.path.join(folder, e.get("file"))) for e in entries]


def triangles_of(corners, points):
    """A cell, a simple polygon in the plane of its points, as triangles without corners of others."""
    if len(corners) == 3:
        return [tuple(corners)]
    normal = [0.0, 0.0, 0.0]
    for i, j in zip(corners, corners[1:] + corners[:1]):
        normal = [n + x for n, x in zip(normal, cross(points[i], points[j]))]

    def area(i, j, k):
        return dot(normal, cross(sub(points[j], points[i]), sub(points[k], points[i])))

    rest, triangles = list(corners), []
    while len(rest) > 3:
        for n, j in enumerate(rest):
            i, k = rest[n - 1], rest[(n + 1) % len(rest)]
            if area(i, j, k) > 0 and not any(min(area(i, j, m), area(j, k, m), area(k, i, m)) >= 0
                                             for m in rest if m not in (i, j, k)):
                break
        else:
            n = 1  # nothing but flat corners are left
        triangles.append((rest[n - 1], rest[n], rest[(n + 1) % len(rest)]))
        del rest[n]
    return triangles + [tuple(rest)]


def surfaces_of(path):
    """block -> Surface, of a frame."""
    arrays = arrays_of(path)
    flat = arrays["Points"]
    points = list(zip(flat[0::3], flat[1::3], flat[2::3]))
    cells, begin = {}, 0
    for cell, end in enumerate(arrays["offsets"]):
        corners = list(arrays["connectivity"][begin:end])
        cells.setdefault(arrays["block"][cell], []).append((arrays["face"][cell], corners))
        begin = end
    return {block: Surface(points, own) for block, own in cells.items()}


# --- depth in a closed surface

def distance_to_segment(p, a, b):
    d, e = sub(b, a), sub(p, a)
    length = dot(d, d)
    s = min(1.0, max(0.0, dot(d, e) / length)) if length else 0.0
    gap = (e[0] - s * d[0], e[1] - s * d[1], e[2] - s * d[2])
    return math.sqrt(dot(gap, gap))


def distance_to_triangle(p, a, b, c):
    """Over the inside the height above the plane, elsewhere the distance to the nearest side."""
    normal, inside = cross(sub(b, a), sub(c, a)), True
    length = math.sqrt(dot(normal, normal))
    for u, v in ((a, b), (b, c), (c, a)):
        inside = inside and dot(cross(sub(v, u), sub(p, u)), normal) >= 0
    if inside and length:
        return abs(dot(sub(p, a), normal)) / length
    return min(distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a))


def solid_angle(p, a, b, c):
    """Of a triangle seen from p; van Oosterom and Strackee."""
    a, b, c = sub(a, p), sub(b, p), sub(c, p)
    la, lb, lc = (math.sqrt(dot(x, x)) for x in (a, b, c))
    below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return 2 * math.atan2(dot(a, cross(b, c)), below)


class Surface:
    """The closed surface of a block, with a grid over its picture through VIEW that finds triangles above a point."""

    def __init__(self, points, cells):
        used = sorted({i for _, corners in cells for i in corners})
        self.points = [points[i] for i in used]
        self.triangles = [tuple(points[i] for i in t) for _, corners in cells for t in triangles_of(corners, points)]
        self.low = tuple(min(p[k] for p in self.points) for k in range(3))
        self.high = tuple(max(p[k] for p in self.points) for k in range(3))
        self.edges = self.edges_between_faces(points, cells)
        self.grid = None

    @staticmethod
    def edges_between_faces(points, cells):
        faces = {}
        for face, corners in cells:
            for i, j in zip(corners, corners[1:] + corners[:1]):
                faces.setdefault((min(i, j), max(i, j)), set()).add(face)
        return [(points[i], points[j]) for (i, j), both in faces.items() if len(both) > 1]

    def volume(self):
        return sum(dot(a, cross(b, c)) for a, b, c in self.triangles) / 6

    def samples(self):
        """Corners, and points along edges."""
        if not hasattr(self, "_samples"):
            shares = [k / (SAMPLES + 1) for k in range(1, SAMPLES + 1)]
            self._samples = self.points + [
                tuple(x + s * (y - x) for x, y in zip(a, b)) for a, b in self.edges for s in shares]
        return self._samples

    def near(self, other):
        return all(self.low[k] <= other.high[k] and other.low[k] <= self.high[k] for k in range(3))

    def in_box(self, points):
        (a, b, c), (d, e, f) = self.low, self.high
        return [p for p in points if a < p[0] < d and b < p[1] < e and c < p[2] < f]

    def build_grid(self):
        self.seen = [tuple(tuple(dot(row, p) for row in VIEW) for p in t) for t in self.triangles]
        n = max(1, int(math.sqrt(len(self.seen))))
        self.origin = [min(p[k] for t in self.seen for p in t) for k in (0, 1)]
        span = [max(p[k] for t in self.seen for p in t) - self.origin[k] for k in (0, 1)]
        self.rate = [n / s for s in span]
        self.grid = {}
        for t in self.seen:
            first = self.cell(min(p[0] for p in t), min(p[1] for p in t))
            last = self.cell(max(p[0] for p in t), max(p[1] for p in t))
            for i in range(first[0], last[0] + 1):
                for j in range(first[1], last[1] + 1):
                    self.grid.setdefault((i, j), []).append(t)

    def cell(self, x, y):
        return int((x - self.origin[0]) * self.rate[0] // 1), int((y - self.origin[1]) * self.rate[1] // 1)

    def holds(self, point):
        """Crossings of the ray from the point through VIEW, with their signs, do not cancel."""
        if self.grid is None:
            self.build_grid()
        x, y, z = (dot(row, point) for row in VIEW)
        crossings = 0
        for (ax, ay, az), (bx, by, bz), (cx, cy, cz) in self.grid.get(self.cell(x, y), ()):
            c = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
            a = (cx - bx) * (y - by) - (cy - by) * (x - bx)
            b = (ax - cx) * (y - cy) - (ay - cy) * (x - cx)
            if (a > 0 and b > 0 and c > 0) or (a < 0 and b < 0 and c < 0):
                if a * (az - z) + b * (bz - z) + c * (cz - z) > 0 if a > 0 else \
                        a * (az - z) + b * (bz - z) + c * (cz - z) < 0:
                    crossings += 1 if a > 0 else -1
        return crossings != 0

    def winding_number(self, point):
        return sum(solid_angle(point, *t) for t in self.triangles) / (4 * math.pi)

    def depth(self, point):
        """Of a point that is inside."""
        return min(distance_to_triangle(point, *t) for t in self.triangles)

    def deepest(self, points, floor):
        """(depth, point) of the deepest of the points; None if none is inside and deeper than `floor`."""
        found = None
        for p in self.in_box(points):
            if not self.holds(p):
                continue
            depth = self.depth(p)
            if depth > floor and abs(self.winding_number(p)) > 0.5:
                found, floor = (depth, p), depth
        return found


# --- auditing a folder

def summary_of(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def deepest_of(folder):
    """The largest depth over all frames and pairs of blocks with a movable one, relative to its size.

    @return dict: depth (m), share (of the size), size (m), time, place, block (whose point it is), inside
    (block), frames
    """
    blocks = summary_of(folder)["scene"]["block"]
    before, sizes, found = {}, {}, {"depth": 0.0, "share": 0.0}
    frames = frames_of(folder)
    for time, path in frames:
        surfaces = surfaces_of(path)
        for b, surface in surfaces.items():
            if b in before and before[b].points == surface.points:
                surfaces[b] = before[b]  # with the grid that it has
            sizes.setdefault(b, abs(surface.volume()) ** (1 / 3))
        before = surfaces
        for a in surfaces:
            for b in surfaces:
                sizes_that_move = [sizes[c] for c in (a, b) if not is_fixed(blocks, c)]
                if a == b or not sizes_that_move or not surfaces[a].near(surfaces[b]):
                    continue
                size = min(sizes_that_move)
                hit = surfaces[b].deepest(surfaces[a].samples(), found["share"] * size)
                if hit:
                    found = {"depth": hit[0], "share": hit[0] / size, "size": size, "time": time, "place": hit[1],
                             "block": name_of(blocks, a), "inside": name_of(blocks, b)}
    found.setdefault("size", min((s for b, s in sizes.items() if not is_fixed(blocks, b)), default=0.0))
    return {**found, "frames": len(frames)}


def is_fixed(blocks, index):
    return index < len(blocks) and bool(blocks[index].get("fixed"))


def name_of(blocks, index):
    return blocks[index]["name"] if index < len(blocks) else f"block {index}"


def energy_rise(folder):
    """The largest rise of kinetic, elastic, potential and contact energy together above an earlier minimum.

    @return (rise as a share of the span of this sum, rise in J, time). What is below 1e-7 of the span of the
    potential energy is rounding and counts as nothing.
    """
    lowest, highest, rise, when, gravity = math.inf, -math.inf, 0.0, 0.0, []
    with open(os.path.join(folder, "history.csv"), encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            energy = sum(float(row["energy." + part]) for part in ("kinetic", "elastic", "gravity", "contact"))
            gravity.append(float(row["energy.gravity"]))
            if energy - lowest > rise:
                rise, when = energy - lowest, float(row["time"])
            lowest, highest = min(lowest, energy), max(highest, energy)
    if rise <= 1e-7 * (max(gravity) - min(gravity)):
        return 0.0, 0.0, 0.0
    return rise / (highest - lowest), rise, when


def disagreement(summary, found):
    """A text on how the program's own `deepest` differs from the audit's, or None."""
    said = summary.get("deepest")
    if not isinstance(said, dict) or not isinstance(said.get("value"), (int, float)):
        return None
    share, of_size = DISAGREEMENT
    difference = abs(said["value"] - found["depth"])
    if difference <= share * max(said["value"], found["depth"]) or difference <= of_size * found["size"]:
        return None
    who = "less" if said["value"] < found["depth"] else "more"
    return f"deepest says {who}: {said['value']:.3g} m at t={said.get('time')}, audit {found['depth']:.3g} m"


def audit(folder):
    """All findings on a result folder.

    @return dict: status, found (see deepest_of), allowed (m), deep, energy (bool), rise (share), rise_joule, rise_time,
    contact_depth_max, deepest (the program's own, or None), disagreement (text or None)
    """
    summary, found = summary_of(folder), deepest_of(folder)
    rise, joule, when = energy_rise(folder)
    allowed = (summary.get("contact_depth_max") or 0.0) + ALLOWED_SHARE * found["size"]
    return {"status": summary["status"], "found": found, "allowed": allowed, "deep": found["depth"] > allowed,
            "energy": rise > ENERGY_RISE, "rise": rise, "rise_joule": joule, "rise_time": when,
            "contact_depth_max": summary.get("contact_depth_max"), "deepest": summary.get("deepest"),
            "disagreement": disagreement(summary, found)}
