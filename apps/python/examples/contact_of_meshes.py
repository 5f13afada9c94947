"""The exact contact of two tetrahedra, tip on face."""
import ashlar

points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
above = [[x + 0.2, y + 0.2, -z] for x, y, z in points]
turned = [[a, c, b] for a, b, c in triangles]
hanging = [[x, y, z + 0.0] for x, y, z in above]
report = ashlar.contacts((points, triangles), (hanging, turned))
print(report["relation"], report["type"])
