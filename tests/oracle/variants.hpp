// Equivalent forms of a pair: mirrored, rotated, swapped, renumbered, scaled, moved, with another mesh, all
// exactly. All results of a variant must be the transformed results of the original pair.
#pragma once

#include <string>

#include "oracle/exact_body.hpp"
#include "oracle/lattice_hull.hpp"

namespace ashlar::oracle {

/// x -> 2^scale (signed permutation of x + offset).
struct Similarity {
  std::array<int, 3> axis{0, 1, 2};  ///< component k of the result is component axis[k] of x ...
  std::array<int, 3> sign{1, 1, 1};  ///< ... times sign[k]
  Point offset{};                    ///< added after the permutation, before the scaling
  int scale = 0;

  [[nodiscard]] Point operator()(const Point& x) const;
  /// The same for a difference of two points.
  [[nodiscard]] Point turn(const Point& x) const;
  [[nodiscard]] bool reflects() const;
};

struct Variant {
  Shape p;
  Shape q;
  bool swapped;  ///< P of the variant was Q of the pair
  Similarity similarity;
};

/// All variants of one pair.
class Variants {
 public:
  /// @throws std::invalid_argument: see make_body.
  Variants(Shape p, Shape q);

  /// A random one: any of the 48 signed permutations, any numbering, and by chance swapped, scaled by a power
  /// of two, moved as far as that is exact, with its facets meshed anew.
  [[nodiscard]] Variant random(Random& random) const;

 private:
  struct Body {
    Shape shape;
    std::vector<std::vector<int>> facets;  ///< see facet_cycles; empty for a triangle
  };

  Body p_;
  Body q_;
};

/// A solid with the same facets in other triangles: fans from any corner, or around an inner point, with
/// further points inside facets and on edges where their coordinates are exact.
/// @param facets facet_cycles(solid)
[[nodiscard]] Shape meshed_anew(const Shape& solid, const std::vector<std::vector<int>>& facets,
                                Random& random);

}  // namespace ashlar::oracle
