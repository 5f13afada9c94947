#!/usr/bin/env python3
"""Writes data/corpora/bad_meshes: small mesh files that no solid may be made of, and index.tsv.

Usage: python3 data/corpora/make_bad_meshes.py        (always writes the same files)

Sound solids (sound_solids.py) with numbers and order of their points and triangles shuffled are spoilt in one known
way and written in one of the formats (mesh_files.py). A line of index.tsv is: file, what must be found, a text that
must occur in one of the messages (or -). What must be found is "unreadable", or the complete set of defects separated
by ", "; a final "..." allows others besides. Nothing here asks the program: each expectation follows from how the
file was made.
Coordinates are multiples of powers of two, so that what is meant to be flat or to touch is so exactly.
"""

import pathlib
import random
import struct

from mesh_files import (INDEXED, WELDED, ply_header, to_big_endian_ply, to_binary_ply, to_binary_stl, to_obj, to_off,
                        to_ply, to_stl)
from sound_solids import (SOLIDS, box, dented_box, frame, inverted, joined, l_prism, moved, octahedron, prism, pyramid,
                          tetrahedron, welded)

FOLDER = pathlib.Path(__file__).parent / "bad_meshes"
INDEX = []
RANDOM = random.Random(20)
TURN = {}  # of the formats, by family


# ---- changes that keep or spoil -------------------------------------------------------------------------------

def placed(mesh, keep_numbers=False):
    """Scales, moves and turns exactly, and shuffles all numbers."""
    points, triangles = mesh
    scale = 2.0 ** RANDOM.randint(-3, 6)
    shift = [RANDOM.randint(-64, 64) / 8.0 for _ in range(3)]
    axes = RANDOM.choice([(0, 1, 2), (1, 2, 0), (2, 0, 1)])  # even permutations: orientation stays
    points = [tuple(scale * p[axes[d]] + shift[d] for d in range(3)) for p in points]
    if keep_numbers:
        return points, list(triangles)
    order = list(range(len(points)))
    RANDOM.shuffle(order)
    number = {old: new for new, old in enumerate(order)}
    points = [points[i] for i in order]
    triangles = [tuple(number[v] for v in t) for t in triangles]
    triangles = [t[k:] + t[:k] for t in triangles for k in [RANDOM.randrange(3)]]
    RANDOM.shuffle(triangles)
    return points, triangles


def edge_name(a, b):
    return f"edge {min(a, b)}-{max(a, b)}"


def sides(t):
    return [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]


def users(triangles, a, b):
    return [i for i, t in enumerate(triangles) if a in t and b in t]


# ---- files ----------------------------------------------------------------------------------------------------

def write(family, content, ending, found, mention="-"):
    number = sum(1 for line in INDEX if line[0].startswith(family + "_")) + 1
    name = "%s_%02d.%s" % (family, number, ending)
    (FOLDER / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    INDEX.append((name, found, mention))


def write_mesh(family, mesh, found, mention="-", formats=None):
    """The formats take turns; STL has no numbers of points, so nothing can be said about them there."""
    formats = formats or INDEXED
    turn = TURN[family] = TURN.get(family, -1) + 1
    make, ending = formats[turn % len(formats)]
    numbers_lost = ending == "stl" and ("edge" in mention or "point" in mention)
    write(family, make(mesh), ending, found, "-" if numbers_lost else mention)


# ---- families: bad surfaces -----------------------------------------------------------------------------------

def open_surfaces():
    for make in SOLIDS.values():
        for _ in range(3):
            points, triangles = placed(make())
            a, b = RANDOM.choice(sides(triangles.pop(RANDOM.randrange(len(triangles)))))
            mention = "%s of triangle %d" % (edge_name(a, b), users(triangles, a, b)[0])
            write_mesh("open", (points, triangles), "open edge", mention, WELDED)
    write_mesh("open", ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), "open edge", "edge 0-1 of triangle 0")
    grid = [(float(i), float(j), 0.0) for i in range(4) for j in range(4)]
    squares = [(4 * i + j, 4 * i + j + 4, 4 * i + j + 5, 4 * i + j + 1) for i in range(3) for j in range(3)]
    sheet = [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))]
    write_mesh("open", (grid, sheet), "open edge", "edge 0-1")


def non_manifold_edges():
    for _ in range(3):
        two = welded(joined(box(), moved(box(), (1, 1, 0))))
        write_mesh("edge", placed(two), "non-manifold edge", "of triangles", WELDED)
        wall = welded(joined(box(), ([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0, 0, 2), (1, 0, 2), (1, 1, 2),
                                      (0, 1, 2)], [t for t in box()[1] if max(t) > 3])))
        write_mesh("edge", placed(wall), "non-manifold edge", "of triangles", WELDED)
    for make in (box, octahedron, frame):
        points, triangles = placed(make())
        extreme = max(range(len(points)), key=lambda i: points[i])
        a, b = next(s for t in triangles for s in sides(t) if s[0] == extreme)
        points.append(tuple(x + 1000.0 for x in points[a]))
        triangles.append((a, b, len(points) - 1))
        write_mesh("fin", (points, triangles), "open edge, non-manifold edge", edge_name(a, len(points) - 1))
    for make in (tetrahedron, l_prism, box):
        points, triangles = placed(make())
        twice = RANDOM.choice(triangles)
        triangles.append(twice[1:] + twice[:1])
        found = "non-manifold edge, self-intersection"
        write_mesh("twice", (points, triangles), found, edge_name(*twice[:2]), WELDED)


def non_manifold_vertices():
    for make in (tetrahedron, box, pyramid, octahedron):
        corner = max(make()[0])
        mirrored = ([tuple(2 * c - x for x, c in zip(p, corner)) for p in make()[0]], inverted(make())[1])
        mesh = welded(joined(make(), mirrored))
        found = "non-manifold vertex, several components"
        write_mesh("vertex", mesh, found, "point %d" % mesh[0].index(corner), WELDED)
    for x, y in ((0.5, 0.5), (0.25, 0.5), (0.375, 0.625)):
        points, triangles = dented_box(0.0, x, y)
        bottom = [t for t in triangles if max(t) < 4]
        pinched = [t for t in triangles if t not in bottom] + [(1, 0, 8), (2, 1, 8), (3, 2, 8), (0, 3, 8)]
        write_mesh("vertex", (points, pinched), "non-manifold vertex", "point 8", INDEXED)


def flipped_faces():
    for make in SOLIDS.values():
        for count in (1, 1, 2):
            points, triangles = placed(make())
            # Flipped triangles without a common edge keep all their edges bad.
            chosen = [RANDOM.randrange(len(triangles))]
            for i, t in enumerate(triangles):
                if len(chosen) < count and all(len(set(t) & set(triangles[c])) < 2 for c in chosen):
                    chosen.append(i)
            for c in chosen:
                triangles[c] = (triangles[c][0], triangles[c][2], triangles[c][1])
            a, b = RANDOM.choice(sides(triangles[chosen[0]]))
            write_mesh("flipped", (points, triangles), "inconsistently oriented edge", edge_name(a, b), WELDED)


def shells_and_components():
    for _ in range(4):
        inner = box((0.25, 0.25, 0.25), (0.5, 0.5, 0.75))
        for shell in (inverted(inner), inner):
            write_mesh("shell", placed(joined(box(), shell)), "several components", "not connected", WELDED)
    for make in SOLIDS.values():
        apart = joined(placed(make(), True), moved(box(), (1000, 0, 0)))
        mention = "triangle %d (not connected to triangle 0)" % len(make()[1])
        write_mesh("components", apart, "several components", mention, WELDED)
    three = joined(joined(box(), moved(tetrahedron(), (4, 0, 0))), moved(pyramid(), (0, 9, 0)))
    write_mesh("components", three, "several components", "triangle 16 (")
    crossing = joined(box(), moved(box(), (0.5, 0.25, 0.125)))
    write_mesh("components", crossing, "self-intersection, several components", "triangle 12 (")
    through = joined(box(), moved(tetrahedron(), (0.25, 0.25, 0.25)))
    write_mesh("components", through, "self-intersection, several components", "triangle 12 (")
    touching = joined(box(), box((1, 0.25, 0.25), (2, 0.75, 0.75)))
    write_mesh("components", touching, "self-intersection, several components", "triangle 12 (", INDEXED)


def self_crossings():
    for depth in (0.0, -0.125, -0.5, -1.5):
        for x, y in ((0.5, 0.5), (0.25, 0.375)):
            write_mesh("crossing", placed(dented_box(depth, x, y)), "self-intersection", "triangles", WELDED)
    # The dent reaches a wall, an edge, and a place beyond the wall.
    for x, y, z in ((0.0, 0.5, 0.5), (0.0, 0.5, 0.0), (-0.5, 0.5, 0.5), (1.5, 0.25, 0.25)):
        write_mesh("crossing", placed(dented_box(z, x, y)), "self-intersection", "triangles", WELDED)
    # Profile whose corner 3 lies beyond the side 0-1 opposite.
    for y in (-0.5, -1.0):
        notch = prism([(0, 0), (4, 0), (4, 4), (2, y), (0, 4)], [(0, 3, 4), (1, 2, 3), (0, 1, 3)], [[0, 1, 2, 3, 4]])
        write_mesh("crossing", placed(notch), "self-intersection", "triangles", WELDED)
    # Walls lying on each other, and coplanar caps.
    slit = prism([(0, 0), (4, 0), (4, 4), (2, 2), (3, 3), (0, 4)], [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)],
                 [[0, 1, 2, 3, 4, 5]])
    for _ in range(3):
        write_mesh("crossing", placed(slit), "self-intersection...", "triangles", WELDED)


def zero_areas():
    for make in SOLIDS.values():
        points, triangles = placed(make())
        a, b = RANDOM.sample(range(len(points)), 2)
        triangles.append((a, a, b))
        write_mesh("area", (points, triangles), "zero-area triangle",
                   "triangle %d (points %d, %d, %d)" % (len(triangles) - 1, a, a, b))
    for make in SOLIDS.values():
        points, triangles = placed(make())
        a, b, c = triangles.pop()
        points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
        m = len(points) - 1
        triangles += [(a, m, c), (m, b, c), (a, b, m)]
        write_mesh("area", (points, triangles), "zero-area triangle, self-intersection",
                   "triangle %d (points %d, %d, %d)" % (len(triangles) - 1, a, b, m), INDEXED)
    for make in (box, l_prism, frame):
        points, triangles = placed(make())
        a, b = RANDOM.choice(sides(triangles[0]))
        points[a] = points[b]
        found = "zero-area triangle, fused vertices..."
        write_mesh("area", (points, triangles), found, "points %d, %d" % (min(a, b), max(a, b)))


def fused_and_unused():
    for make in SOLIDS.values():
        points, triangles = placed(make())
        t = RANDOM.randrange(len(triangles))
        v = triangles[t][0]
        points.append(points[v])
        triangles[t] = (len(points) - 1,) + triangles[t][1:]
        mention = "points %d, %d" % (v, len(points) - 1)
        write_mesh("fused", (points, triangles), "open edge, fused vertices", mention)
    for make in (box, l_prism):
        points, triangles = placed(make())
        soup = [points[v] for t in triangles for v in t], [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles))]
        write_mesh("fused", soup, "open edge, fused vertices, several components", "open edge")
    for make in (tetrahedron, box):
        corner = max(make()[0])
        mirrored = ([tuple(2 * c - x for x, c in zip(p, corner)) for p in make()[0]], inverted(make())[1])
        write_mesh("fused", joined(make(), mirrored), "fused vertices, several components", "points")
    for make in SOLIDS.values():
        points, triangles = placed(make())
        points.append((RANDOM.randint(-9, 9) + 0.5, 777.0, 0.0))
        write_mesh("unused", (points, triangles), "unused vertex", "point %d" % (len(points) - 1))


def volumes():
    for make in SOLIDS.values():
        for _ in range(2):
            write_mesh("negative", placed(inverted(make())), "inside out", "volume -", WELDED)
    # The apex pushed through the base: a sound surface seen from inside.
    points, triangles = pyramid()
    write_mesh("negative", placed((points[:4] + [(1, 1, -3)], triangles)), "inside out", "volume -", WELDED)
    for make in (tetrahedron, pyramid, octahedron):
        flat = ([(x, y, 0.0) for x, y, z in make()[0]], make()[1])
        write_mesh("zero", flat, "zero volume...", "volume 0")
    write_mesh("zero", ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1)]), "self-intersection, zero volume",
               "triangles 0, 1", WELDED)
    sheet = [(float(i), float(j), 0.0) for i in (0, 1) for j in (0, 1)]
    write_mesh("zero", (sheet, [(0, 2, 3), (0, 3, 1), (0, 3, 2), (0, 1, 3)]), "non-manifold edge, self-intersection")
    write_mesh("zero", box((0, 0, 0), (1e110, 1e110, 1e110)), "volume overflow", "volume inf")
    write_mesh("zero", box((0, 0, 0), (1e-110, 1e-110, 1e-110)), "zero volume", "volume 0")


def non_finite():
    for text in ("nan", "inf", "-inf", "NaN", "-Infinity"):
        for make, ending in ((to_off, "off"), (to_obj, "obj"), (to_ply, "ply"), (to_stl, "stl")):
            points, triangles = placed(box())
            v = RANDOM.randrange(8)
            points[v] = points[v][:2] + (123456.75,)
            content = make((points, triangles)).replace("123456.75", text)
            write("finite", content, ending, "non-finite point", "point " + (str(v) if ending != "stl" else ""))
    for value in (float("nan"), float("inf"), float("-inf")):
        for make, ending in ((to_binary_ply, "ply"), (to_big_endian_ply, "ply"), (to_binary_stl, "stl")):
            points, triangles = placed(octahedron())
            points[3] = (value,) + points[3][1:]
            write("finite", make((points, triangles)), ending, "non-finite point",
                  "point " + ("3" if ending == "ply" else ""))


# ---- families: bad files --------------------------------------------------------------------------------------

def indices():
    mesh = placed(box())
    last = "3 %d %d %d\n" % mesh[1][-1]
    for bad in ("8", "-1", "4294967296", "99999999999999999999", "1.5", "0x1", "1e3"):
        for make, ending in ((to_off, "off"), (to_ply, "ply")):
            content = make(mesh)
            cut = content.rindex(last)
            write("index", content[:cut] + "3 0 1 %s\n" % bad, ending, "unreadable", bad)
    for bad in ("0", "9", "-9", "4294967297", "99999999999999999999", "-99999999999999999999", "1.5", "//1", "1/x"):
        write("index", to_obj(mesh) + "f 1 2 %s\n" % bad, "obj", "unreadable", bad)
    for bad in (8, -1, 2147483647, -2147483648):
        broken = (mesh[0], mesh[1][:-1] + [(0, 1, bad)])
        write("index", to_binary_ply(broken), "ply", "unreadable", str(bad))
        write("index", to_big_endian_ply(broken), "ply", "unreadable", str(bad))


def truncated():
    for make, ending in WELDED:
        for part in (0.02, 0.4, 0.7, 0.93):
            content = make(placed(l_prism()))
            size = int(part * len(content))
            if make is to_obj:  # a shorter OBJ file is only bad where it is cut inside a statement
                size = content.index(" ", content.rindex("f", 0, size) if "f" in content[:size] else 0) + 1
            write("truncated", content[:size], ending, "unreadable")


def headers():
    off, obj, ply, stl = (make(placed(box())) for make in (to_off, to_obj, to_ply, to_stl))
    wrong = [("off", off.replace("OFF", "FOO"), "FOO"), ("off", off.replace("OFF\n", ""), "header"),
             ("off", off.replace("OFF", "OFF BINARY"), "BINARY"), ("off", off.replace("OFF", "4OFF"), "4OFF"),
             ("off", off.replace("8 12 0", "8"), "number of faces"), ("off", off.replace("8 12", "-8 12"), "-8"),
             ("off", off.replace("8 12", "8 0"), "(0)"), ("off", off.replace("8 12", "0 12"), "(0)"),
             ("off", off.replace("8 12", "8 13"), "face 12"), ("off", off.replace("8 12", "8 11"), "last face"),
             ("off", off.replace("8 12", "9 12"), ":"), ("off", off.replace("8 12", "7 12"), ":"),
             ("off", off.replace("8 12", "99999999999999999999 12"), "99999999999999999999"),
             ("off", off.replace("8 12", "2147483647 12"), "too short"),
             ("off", off.replace("8 12", "8 2147483647"), "too short"), ("off", ply, "ply"), ("off", stl, "solid"),
             ("off", "\ufeff" + off, "header"), ("off", off.encode("utf-16"), "header"),
             ("obj", off, "OFF"), ("obj", stl, "solid"), ("obj", "v 0 0 0\n", "no faces"), ("obj", "# nothing\n", "no faces"),
             ("stl", off, "bytes"), ("stl", "solid a\nendsolid a\n", "no faces"), ("stl", bytes(84), "no faces"),
             ("stl", bytes(83), "84"), ("stl", bytes(80) + b"\xff\xff\xff\xff", "4294967295"),
             ("stl", to_binary_stl(placed(box())) + b"\0", "685"), ("stl", stl.replace("facet", "fazet", 1), "fazet"),
             ("stl", stl.replace("outer loop\n", "outer loop\nvertex 0 0 0\n", 1), "vertex"),
             ("stl", stl.replace("endloop", "", 1), "endfacet"), ("stl", stl.replace("endsolid bad", ""), "endsolid"),
             ("ply", ply.replace("ply", "plx", 1), "plx"), ("ply", ply.replace("ascii", "askii"), "askii"),
             ("ply", ply.replace("1.0", "3.0", 1), "3.0"), ("ply", ply.replace("format ascii 1.0\n", ""), "format"),
             ("ply", ply.replace("property double z\n", ""), "\"z\""), ("ply", ply.replace("double", "quadruple"), "quadruple"),
             ("ply", ply.replace("vertex_indices", "corners"), "vertex_indices"),
             ("ply", ply.replace("uchar int", "uchar float"), "integer"), ("ply", ply.replace("list uchar", "list float"), "integer"),
             ("ply", ply.replace("element face 12", "element face 13"), "face"), ("ply", ply.replace("element face 12", "element face 0"), "face"),
             ("ply", ply.replace("element face 12", "element face 11"), "last element"),
             ("ply", ply.replace("element face 12", "element face 2147483647"), "too short"),
             ("ply", ply.replace("element vertex 8", "element vertex 2147483647"), "too short"),
             ("ply", ply.replace("element vertex 8", "element vertex -8"), "-8"), ("ply", ply.replace("end_header\n", ""), "keyword"),
             ("ply", ply.replace("element vertex 8\n", ""), "property"), ("ply", off, "OFF")]
    for ending, content, mention in wrong:
        write("header", content, ending, "unreadable", "-" if mention == ":" else mention)
    binary = to_binary_ply(placed(box()))
    write("header", binary.replace(b"element face 12", b"element face 2000000000"), "ply", "unreadable", "too short")
    write("header", binary + b"\0\0\0", "ply", "unreadable", "3 bytes")
    write("header", binary.replace(b"list uchar", b"list int"), "ply", "unreadable", "-")
    huge = ply_header("binary_little_endian", ([0], [0])).replace("list uchar", "list int").encode()
    for length in (2147483647, -1, 2):
        write("header", huge + bytes(24) + struct.pack("<i", length) + bytes(400), "ply", "unreadable")


def numbers():
    for bad in ("1e999", "1,5", "0x1p3", "1..2", "--1", "1-2", "one", "1e", "\xb2", "+-1", "+"):
        for make, ending in ((to_off, "off"), (to_obj, "obj"), (to_ply, "ply"), (to_stl, "stl")):
            points, triangles = placed(tetrahedron())
            points[2] = (points[2][0], 123456.75, points[2][2])
            content = make((points, triangles)).replace("123456.75", bad)
            write("number", content, ending, "unreadable", "-" if bad == "\xb2" else bad)
    for off in ("OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
                "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n"):
        write("number", off, "off", "unreadable")


def empty_and_garbage():
    for ending in ("off", "obj", "stl", "ply"):
        write("empty", b"", ending, "unreadable", "empty")
        write("empty", b" \n\t\r\n\n", ending, "unreadable")
        write("empty", b"\0" * 7, ending, "unreadable")
        for size in (10, 100, 1000):
            write("garbage", RANDOM.randbytes(size), ending, "unreadable")
    write("garbage", b"OFF\n8 12 0\n" + RANDOM.randbytes(500), "off", "unreadable")
    write("garbage", b"solid " + RANDOM.randbytes(500), "stl", "unreadable")
    write("garbage", b"v 0 0 0\nf " + RANDOM.randbytes(500), "obj", "unreadable")
    write("garbage", to_ply(box())[:150].encode() + RANDOM.randbytes(500), "ply", "unreadable")


def main():
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.iterdir():
        old.unlink()
    for family in (open_surfaces, non_manifold_edges, non_manifold_vertices, flipped_faces, shells_and_components,
                   self_crossings, zero_areas, fused_and_unused, volumes, non_finite, indices, truncated, headers, numbers,
                   empty_and_garbage):
        family()
    (FOLDER / "index.tsv").write_text("".join("\t".join(line) + "\n" for line in INDEX))


if __name__ == "__main__":
    main()
