// Endless supply of pairs built to break a contact classifier, the same for the same seed everywhere. Every
// pair starts on a small lattice, where touching, parallel, collinear and coplanar features are common and
// exact; it is then pushed apart or into each other by a chosen amount, tilted, stretched to needles and
// slivers, rotated, shifted and scaled, each step exactly: a pair whose coordinates would not all be doubles
// is made with a milder step. Convex solids therefore stay exactly convex with exactly flat facets.
#pragma once

#include <string>

#include "oracle/exact_body.hpp"
#include "oracle/lattice_hull.hpp"

namespace ashlar::oracle {

struct DegeneratePair {
  Shape p;
  Shape q;
  std::string family;  ///< its construction: shapes, gap, transformation
};

class DegeneratePairs {
 public:
  explicit DegeneratePairs(std::uint64_t seed) : random_(seed) {}

  /// Two triangles or two convex solids, alternately.
  [[nodiscard]] DegeneratePair next();

 private:
  Random random_;
  bool solids_ = false;
};

}  // namespace ashlar::oracle
