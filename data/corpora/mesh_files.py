"""Meshes (points, triangles) as the content of a file, in every format that the program reads."""

import struct


def to_off(mesh):
    points, triangles = mesh
    return "OFF\n%d %d 0\n" % (len(points), len(triangles)) + lines("", points) + lines("3 ", triangles)


def to_obj(mesh):
    return lines("v ", mesh[0]) + lines("f ", [[v + 1 for v in t] for t in mesh[1]])


def to_ply(mesh):
    return ply_header("ascii", mesh) + lines("", mesh[0]) + lines("3 ", mesh[1])


def ply_header(form, mesh):
    return ("ply\nformat %s 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n"
            % (form, len(mesh[0]), len(mesh[1])))


def to_binary_ply(mesh, order="<"):
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    body = b"".join(struct.pack(order + "3d", *p) for p in mesh[0])
    return ply_header(form, mesh).encode() + body + b"".join(struct.pack(order + "B3i", 3, *t) for t in mesh[1])


def to_big_endian_ply(mesh):
    return to_binary_ply(mesh, ">")


def to_stl(mesh):
    facets = ["facet normal 0 0 0\nouter loop\n" + lines("vertex ", [mesh[0][v] for v in t]) + "endloop\nendfacet\n"
              for t in mesh[1]]
    return "solid bad\n" + "".join(facets) + "endsolid bad\n"


def to_binary_stl(mesh):
    facets = [struct.pack("<12f", 0, 0, 0, *(x for v in t for x in mesh[0][v])) + b"\0\0" for t in mesh[1]]
    return bytes(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def lines(prefix, rows):
    return "".join(prefix + " ".join(map(number_text, row)) + "\n" for row in rows)


def number_text(x):
    return repr(x)[:-2] if isinstance(x, float) and repr(x).endswith(".0") else repr(x)


INDEXED = [(to_off, "off"), (to_obj, "obj"), (to_ply, "ply"), (to_binary_ply, "ply"), (to_big_endian_ply, "ply")]
WELDED = INDEXED + [(to_stl, "stl"), (to_binary_stl, "stl")]
