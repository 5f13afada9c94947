// Heights of the corners of one shape above the facet planes of the other, in floating point with one proved
// bound for each plane: computed once for a pair, asked for separation, depth and the common solid alike.
#pragma once

#include <vector>

#include "geometry/convex/convex_shape.hpp"

namespace ashlar {

/// Symbols: N the outward normal of a facet, x a corner of it, y a corner of the other shape; the height is
/// N . (y - x), in units of |N|.
class PlaneHeights {
 public:
  /// Nothing is computed yet. Both must outlive this. @pre their common NumericRange is safe, or compute() is
  /// never called.
  PlaneHeights(const ConvexShape& planes, const ConvexShape& corners);

  /// Computes the heights of all corners above facet f.
  void compute(int f);
  /// The rest is known of facets computed before. One height for each corner:
  [[nodiscard]] const double* row(int f) const { return begin(f) + extra; }
  /// |true height - value| of every corner above facet f.
  [[nodiscard]] double error(int f) const { return begin(f)[0]; }
  /// The same of the difference of two heights, as rounded.
  [[nodiscard]] double difference_error(int f) const { return begin(f)[1]; }
  [[nodiscard]] double lowest(int f) const { return begin(f)[2]; }
  [[nodiscard]] double highest(int f) const { return begin(f)[3]; }

  [[nodiscard]] const ConvexShape& planes() const { return *planes_; }
  [[nodiscard]] const ConvexShape& corners() const { return *corners_; }

 private:
  static constexpr std::size_t extra =
      4;  // two errors, lowest and highest height before those of the corners

  [[nodiscard]] const double* begin(int f) const {
    return values_.data() + static_cast<std::size_t>(f) * width_;
  }

  const ConvexShape* planes_;
  const ConvexShape* corners_;
  std::size_t width_;           ///< of a row of values_
  double reach_;                ///< no |y - x|_1 is greater
  std::vector<double> values_;  ///< (#facets, extra + #corners)
};

/// Each shape's corners above the other's planes.
struct PairHeights {
  PairHeights(const ConvexShape& a, const ConvexShape& b) : above_a(a, b), above_b(b, a) {}

  PlaneHeights above_a, above_b;
};

}  // namespace ashlar
