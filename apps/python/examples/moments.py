"""Volume, centroid and second moments of a tetrahedron, each the exact value rounded once."""
import ashlar

points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
moments = ashlar.integrate((points, triangles), 2)
volume = moments[0, 0, 0]
print("volume", volume, "= 1/6")
print("centroid", [moments[1, 0, 0] / volume, moments[0, 1, 0] / volume, moments[0, 0, 1] / volume])
print("integral of x^2", moments[2, 0, 0], "= 1/60")
