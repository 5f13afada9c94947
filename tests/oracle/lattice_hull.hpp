// Convex hulls of a few points with small whole coordinates: the raw material of the degenerate pairs. Brute
// force over all triples, exact in 64-bit integers for coordinates up to 2^19.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace ashlar::oracle {

using Random = std::mt19937_64;
using LatticePoint = std::array<std::int64_t, 3>;

/// A whole number in [low, high], the same on every platform.
[[nodiscard]] std::int64_t pick(Random& random, std::int64_t low, std::int64_t high);

struct LatticeSolid {
  std::vector<LatticePoint> points;           ///< corners only
  std::vector<std::array<int, 3>> triangles;  ///< outward; each facet a fan from a random corner
  std::vector<LatticePoint> normals;          ///< outward, one per facet
};

/// Hull of at least 4 points. Empty if they lie in one plane.
[[nodiscard]] LatticeSolid lattice_hull(const std::vector<LatticePoint>& points, Random& random);

[[nodiscard]] std::int64_t lattice_dot(const LatticePoint& a, const LatticePoint& b);
[[nodiscard]] LatticePoint lattice_cross(const LatticePoint& a, const LatticePoint& b);
/// a + factor b
[[nodiscard]] LatticePoint lattice_add(const LatticePoint& a, const LatticePoint& b, std::int64_t factor = 1);

}  // namespace ashlar::oracle
