"""Vectors, rotations, and the solids that the scenes are made of.

Meshes are pairs (points, triangles), closed, with triangles counter-clockwise from outside.
"""
import math


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotation(axis, angle):
    """The rows of the matrix that turns by `angle` (radians) about `axis`."""
    length = math.sqrt(dot(axis, axis))
    x, y, z = (component / length for component in axis)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return [(c + x * x * d, x * y * d - z * s, x * z * d + y * s),
            (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
            (z * x * d - y * s, z * y * d + x * s, c + z * z * d)]


def random_rotation(rng):
    """Any rotation is as likely as any other: a random unit quaternion."""
    w, *axis = (rng.gauss(0, 1) for _ in range(4))
    return rotation(axis, 2 * math.atan2(math.sqrt(dot(axis, axis)), w))


def turned(points, rows):
    return [tuple(dot(row, p) for row in rows) for p in points]


def moved(points, by, factor=1.0):
    return [tuple(factor * x + d for x, d in zip(p, by)) for p in points]


def volume(mesh):
    points, triangles = mesh
    return sum(dot(points[a], cross(points[b], points[c])) for a, b, c in triangles) / 6


def centred(mesh):
    """The mesh with its centroid at the origin."""
    points, triangles = mesh
    centroid = [0.0, 0.0, 0.0]
    for a, b, c in triangles:
        six = dot(points[a], cross(points[b], points[c]))
        for k in range(3):
            centroid[k] += six * (points[a][k] + points[b][k] + points[c][k]) / 24
    return moved(points, [-x / volume(mesh) for x in centroid]), triangles


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def ears(polygon):
    """Triangles of a simple polygon (x, z) that runs counter-clockwise."""
    def area(i, j, k):
        (ax, ay), (bx, by), (cx, cy) = polygon[i], polygon[j], polygon[k]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    rest, triangles = list(range(len(polygon))), []
    while len(rest) > 3:
        for n, j in enumerate(rest):
            i, k = rest[n - 1], rest[(n + 1) % len(rest)]
            others = [m for m in rest if m not in (i, j, k)]
            if area(i, j, k) > 0 and not any(
                    area(i, j, m) >= 0 and area(j, k, m) >= 0 and area(k, i, m) >= 0 for m in others):
                triangles.append((i, j, k))
                rest.remove(j)
                break
    return triangles + [tuple(rest)]


def prism(polygon, width):
    """A polygon (x, z), counter-clockwise, drawn out along y from -width / 2 to width / 2."""
    n = len(polygon)
    points = [(x, y, z) for y in (-width / 2, width / 2) for x, z in polygon]
    triangles = [t for a, b, c in ears(polygon) for t in ((a, b, c), (c + n, b + n, a + n))]
    for i in range(n):
        j = (i + 1) % n
        triangles += quad(j, i, i + n, j + n)
    return points, triangles


def torus(radius, tube, around=12, across=8):
    """About the z axis; its corners lie on the torus."""
    points = []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = radius + tube * math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), tube * math.sin(v)))
    triangles = []
    for i in range(around):
        for j in range(across):
            i2, j2 = (i + 1) % around * across, (j + 1) % across
            triangles += quad(i * across + j, i2 + j, i2 + j2, i * across + j2)
    return points, triangles


def hull(points):
    """The convex hull of a few points in general position: triangles with all other points on one side."""
    triangles, n = [], len(points)
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(j + 1, n):
                normal = cross(sub(points[j], points[i]), sub(points[k], points[i]))
                sides = [dot(normal, sub(p, points[i])) > 0 for m, p in enumerate(points) if m not in (i, j, k)]
                if not any(sides):
                    triangles.append((i, j, k))
                elif all(sides):
                    triangles.append((i, k, j))
    used = sorted({i for t in triangles for i in t})
    return [points[i] for i in used], [tuple(used.index(i) for i in t) for t in triangles]
