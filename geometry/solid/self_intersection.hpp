// Exact search for triangles that meet where a solid's boundary must not.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Quick proof that a surface is embedded, by central projection: if the mean of the points lies strictly on
/// one side of all triangles and one ray from it crosses the surface once, the surface is the graph of a
/// distance over the sphere of directions (Mehlhorn et al. 1999, Checking geometric programs). Linear time.
/// @param mesh closed, manifold (vertices too), consistently oriented, one component.
/// @return true: no self-intersection, no zero area, no equal points. false: nothing is known.
[[nodiscard]] bool is_star_shaped(const TriangleMesh& mesh);

/// True if the triangle has no area: repeated point or collinear points (exact).
[[nodiscard]] bool is_degenerate(const std::vector<Vector3>& points, const std::array<int, 3>& triangle);

/// Pairs of triangles that meet outside their common points and the edge between two of them; overlapping
/// neighbours are such pairs. Box tree, O(n log n + candidates); exact.
/// @param triangles without degenerate ones; equal points must have equal indices.
/// @param limit of pairs, after which the search ends. @param candidates of which no more are tested: pairs of
/// triangles whose boxes meet, up to n^2 / 2 of them. @return index pairs (i < j), sorted
[[nodiscard]] std::vector<std::array<int, 2>> self_intersections(
    const std::vector<Vector3>& points, const std::vector<std::array<int, 3>>& triangles, std::size_t limit,
    std::size_t candidates = std::numeric_limits<std::size_t>::max());

}  // namespace ashlar
