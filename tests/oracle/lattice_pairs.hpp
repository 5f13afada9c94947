// The first half of a degenerate pair: two bodies on the lattice that touch in chosen features.
#pragma once

#include <string>

#include "oracle/lattice_hull.hpp"

namespace ashlar::oracle {

/// A triangle (3 points) or a convex solid.
struct LatticeBody {
  std::vector<LatticePoint> points;
  std::vector<std::array<int, 3>> triangles;
};

struct LatticePair {
  LatticeBody p;
  LatticeBody q;
  LatticePoint normal;  ///< p lies in normal . x >= c, q in normal . x <= c (families with a common plane)
  LatticePoint anchor;  ///< a point near the contact
  std::string family;
};

/// Bodies on either side of the plane z = 0, each resting on it with a vertex, an edge or a facet; the
/// features share a vertex, an inner point of an edge or of a facet, or lie beside each other.
[[nodiscard]] LatticePair make_resting_pair(Random& random, bool solids);

/// Two solids (turned boxes, octahedra, random hulls) supported along a common direction: the normal of a
/// facet of either, the common normal of two edges, or any.
[[nodiscard]] LatticePair make_supported_pair(Random& random);

/// Two random bodies on a very small lattice.
[[nodiscard]] LatticePair make_grid_pair(Random& random, bool solids);

/// A small body and its copy: the same one moved, or its mirror image in a point. Everything of one is
/// parallel to something of the other.
[[nodiscard]] LatticePair make_twin_pair(Random& random, bool solids);

/// Integer matrix |q|^2 R of a quaternion with components from -3 to 3, rows.
[[nodiscard]] std::array<LatticePoint, 3> random_rotation(Random& random);

}  // namespace ashlar::oracle
