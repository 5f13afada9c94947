// Volumes and areas of parts of a cell complex, each the exact value rounded once. Only sources of this layer
// include this file.
//
// A point of a complex is a fraction of integers of some hundred bits, and a sum of products of many such fractions
// is slow. So coordinates are first truncated to 240 bits below the largest one; the error of each is less than one
// unit, which bounds the error of the sum. Fractions are added only if both bounds round to different doubles, which
// needs a value midway between two.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

class PieceMeasures {
 public:
  /// @param complex must outlive this. Its cells may be divided later: that makes no larger coordinates.
  explicit PieceMeasures(const CellComplex& complex);

  /// m^3. @param faces a closed surface: faces, and whether the body is below the plane of each
  [[nodiscard]] double volume(const std::vector<std::pair<int, bool>>& faces);
  /// m^2. @param faces in one plane
  [[nodiscard]] double area(const std::vector<int>& faces);

 private:
  using FixedPoint = std::array<Integer, 3>;
  const FixedPoint& fixed(int point);

  const CellComplex& complex_;
  long shift_ = 0;  ///< a fixed coordinate is 2^shift_ times the coordinate, truncated
  std::vector<std::unique_ptr<const FixedPoint>> fixed_;  ///< by point, null until the first use
};

}  // namespace ashlar
