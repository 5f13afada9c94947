// Moments of closed polyhedra (theory.md section 3), each correct to the last bit or two.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mechanics/basis/multi_index.hpp"

namespace ashlar {

/// Integrals of X^a Y^b Z^c over the inside of a closed surface, a + b + c <= degree.
/// @param mesh closed, outward triangles, m (see Polyhedron)
/// @param degree 0 to 60
/// @return (polynomial_count(degree)), m^(a+b+c+3), in the order of multi_index.hpp: the exact value of each
/// moment for the given doubles, rounded once.
/// A moment that vanishes exactly is exactly zero.
/// @throws std::invalid_argument if the degree is out of range
[[nodiscard]] std::vector<double> moments(const TriangleMesh& mesh, int degree);

}  // namespace ashlar
