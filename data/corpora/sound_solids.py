"""Sound solids (points, outward triangles) for make_bad_meshes.py, and exact ways to put them together."""


def prism(profile, cap, rings, height=1.0):
    n = len(profile)
    points = [(x, y, z) for z in (0.0, height) for x, y in profile]
    triangles = [t for a, b, c in cap for t in ((a, c, b), (a + n, b + n, c + n))]
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    return points, triangles


def box(low=(0, 0, 0), high=(1, 1, 1)):
    (x, y, z), (u, v, w) = low, high
    points, triangles = prism([(x, y), (u, y), (u, v), (x, v)], [(0, 1, 2), (0, 2, 3)], [[0, 1, 2, 3]], 1.0)
    return [(a, b, z if c == 0 else w) for a, b, c in points], triangles


def tetrahedron():
    return ([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])


def pyramid():
    return ([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 1, 3)],
            [(0, 2, 1), (0, 3, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])


def octahedron():
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    upper = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4)]
    return points, upper + [(b, a, 5) for a, b, _ in upper]


def l_prism():
    return prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)],
                 [[0, 1, 2, 3, 4, 5]])


def frame():
    return prism([(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2)],
                 [(0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)],
                 [[0, 1, 2, 3], [4, 7, 6, 5]])


def dented_box(height, x=0.5, y=0.5):
    """Unit box with the middle of its top moved to the given place; the height of a dent may be below 0."""
    points, triangles = box()
    triangles = [t for t in triangles if min(t) < 4]
    return points + [(x, y, height)], triangles + [(4, 5, 8), (5, 6, 8), (6, 7, 8), (7, 4, 8)]


SOLIDS = {"box": box, "tetrahedron": tetrahedron, "pyramid": pyramid, "octahedron": octahedron, "l_prism": l_prism,
          "frame": frame}


def joined(a, b):
    n = len(a[0])
    return a[0] + b[0], a[1] + [tuple(v + n for v in t) for t in b[1]]


def welded(mesh):
    """Equal points become one, numbered as they appear."""
    points, triangles = mesh
    number = {}
    for p in points:
        number.setdefault(p, len(number))
    return list(number), [tuple(number[points[v]] for v in t) for t in triangles]


def moved(mesh, shift):
    return [tuple(x + s for x, s in zip(p, shift)) for p in mesh[0]], mesh[1]


def inverted(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]
