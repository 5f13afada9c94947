// Planes and points with integer coefficients, for exact cuts. Only sources of this layer include this file.
//
// A plane is (a, b, c, d) with a x + b y + c z = d, a point (x, y, z, w) represents (x/w, y/w, z/w). Each point also
// has its coordinates correctly rounded, and each plane its coefficients. The side of a point is a sum of four
// products of doubles with an error of at most 8 u times the sum of their sizes (u = 2^-53: each factor has an error
// u, a product another, three sums three more). Integers are used only if that does not decide.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

#include "geometry/cutting/cut_plane.hpp"
#include "geometry/exact/rational_vector.hpp"

namespace ashlar {

using Integer = mpz_class;

struct ExactPoint {
  Integer x, y, z, w;  ///< w > 0
  Vector3 rounded;     ///< every coordinate correctly rounded, m

  [[nodiscard]] static ExactPoint of(const Vector3& point);
  [[nodiscard]] RationalVector rational() const;
};

class ExactPlane {
 public:
  /// @pre the normal is finite and not zero
  explicit ExactPlane(const CutPlane& plane);
  /// Its normal is (b - a) x (c - a). @pre the points are not collinear
  [[nodiscard]] static ExactPlane through(const RationalVector& a, const RationalVector& b,
                                          const RationalVector& c);
  /// Normal . x = height. @param normal not zero
  ExactPlane(const RationalVector& normal, const Rational& height);

  [[nodiscard]] const std::array<Integer, 4>& coefficients() const { return coefficients_; }
  /// 1 above, 0 on the plane, -1 below.
  [[nodiscard]] int side(const ExactPoint& point) const;
  /// The same from rounded numbers alone; empty if undecided.
  [[nodiscard]] std::optional<int> quick_side(const Vector3& rounded) const;
  /// 1 or -1 if a box of rounded points is certainly above or below; else 0.
  [[nodiscard]] int side_of_box(const Vector3& low, const Vector3& high) const;
  [[nodiscard]] RationalVector normal() const;
  /// Unit, correctly rounded.
  [[nodiscard]] Vector3 unit_normal() const;

 private:
  void round();

  std::array<Integer, 4> coefficients_;
  std::array<double, 4> rounded_;  ///< scaled by one power of two
};

/// The common point of three planes; empty if there is no unique one.
[[nodiscard]] std::optional<ExactPoint> common_point(const ExactPlane& p, const ExactPlane& q,
                                                     const ExactPlane& r);

}  // namespace ashlar
