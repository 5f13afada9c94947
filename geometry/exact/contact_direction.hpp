// The exact direction of a contact.
//
// A contact direction w is a polynomial in the given coordinates (symbols: d = a - b a difference of two
// points, e an edge vector):
//   difference   w = d                        vertex-vertex                       degree 1
//   cross        w = +-(e1 x e2)              facet normal, edge-edge             degree 2
//   rejection    w = e x (d x e)              the part of d across e: vertex-edge degree 3
// Its length is irrelevant: all questions about it (direction_predicates.hpp) have answers that do not change when w
// is scaled by a positive number. w is never rounded before a decision: each rung of the ladder evaluates the whole
// polynomial anew in its own numbers:
//   filter   TrackedNumber, then DoubleDouble (double_double.hpp): floating point with proved error bounds
//   exact    multiple precision, only if both are undecided
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "geometry/exact/double_double.hpp"
#include "geometry/exact/number_vector.hpp"
#include "geometry/exact/tracked_number.hpp"

namespace ashlar {

using Vector3 = Eigen::Vector3d;

/// (plus - minus) + (plus2 - minus2) of points that outlive it; a null pair is left out, a null minus is the
/// origin.
struct Difference {
  const Vector3* plus = nullptr;
  const Vector3* minus = nullptr;
  const Vector3* plus2 = nullptr;
  const Vector3* minus2 = nullptr;
};

/// Data of a direction without its points: stored by a shape for the normals of its facets.
struct DirectionNumbers {
  NumberVector<TrackedNumber> tracked;
  double bound = 0.0;  ///< max e_i + 8 u max |w_i|, rounded up
  NumberVector<DoubleDouble> double_double;
};

/// The sign of w . (x - y) where this follows from the size of its floating value alone. With W the exact w,
/// w its rounded value, e its error, d = fl(x - y), u = 2^-53:
///   |fl(w.d) - W.(x - y)| <= sum |d_i| (e_i + 7 u |w_i|) (1 + 2^-28) <= |d|_1 bound
[[nodiscard]] inline int quick_sign(const DirectionNumbers& w, const Vector3& x, const Vector3& y) {
  const double d0 = x[0] - y[0], d1 = x[1] - y[1], d2 = x[2] - y[2];
  const double value = w.tracked.x.value * d0 + w.tracked.y.value * d1 + w.tracked.z.value * d2;
  const double bound = (std::abs(d0) + std::abs(d1) + std::abs(d2)) * w.bound;
  return value > bound ? 1 : value < -bound ? -1 : unknown_sign;
}

/// See the head of the file. The points it was made from must outlive it.
class ContactDirection {
 public:
  [[nodiscard]] static ContactDirection along(const Difference& d);
  [[nodiscard]] static ContactDirection cross(const Difference& e1, const Difference& e2);
  [[nodiscard]] static ContactDirection rejection(const Difference& d, const Difference& e);
  [[nodiscard]] const DirectionNumbers& numbers() const { return numbers_; }
  /// As a polynomial in the coordinates.
  [[nodiscard]] int degree() const { return kind_ == Kind::difference ? 1 : kind_ == Kind::cross ? 2 : 3; }
  /// e1 x e2 whose numbers are known already.
  [[nodiscard]] static ContactDirection cross(const Difference& e1, const Difference& e2,
                                              const DirectionNumbers& numbers);
  ContactDirection();
  ~ContactDirection();
  ContactDirection(ContactDirection&&) noexcept;
  ContactDirection& operator=(ContactDirection&&) noexcept;
  [[nodiscard]] ContactDirection copy() const;
  /// Turns w into -w.
  void reverse();

  /// w in the numbers of the two floating rungs; the second one is computed on first use.
  [[nodiscard]] const NumberVector<TrackedNumber>& tracked() const { return numbers_.tracked; }
  [[nodiscard]] const NumberVector<DoubleDouble>& double_double() const {
    if (!has_double_double_) compute_double_double();
    return numbers_.double_double;
  }
  /// |w|^2.
  [[nodiscard]] const DoubleDouble& squared_length() const;
  struct ExactVector;
  [[nodiscard]] const ExactVector& exact() const;

 private:
  /// The type is complete in one source only.
  struct ExactDeleter {
    void operator()(ExactVector* vector) const;
  };
  enum class Kind { difference, cross, rejection };
  ContactDirection(Kind kind, const Difference& first, const Difference& second);
  template <class N>
  [[nodiscard]] NumberVector<N> evaluate() const;
  void set_bound();
  void compute_double_double() const;

  Kind kind_ = Kind::difference;
  bool reversed_ = false;
  mutable bool has_double_double_ = false;
  mutable bool has_squared_length_ = false;
  Difference first_, second_;
  mutable DirectionNumbers numbers_;
  mutable DoubleDouble squared_length_;
  mutable std::unique_ptr<ExactVector, ExactDeleter> exact_;
};

/// a - b in the numbers of a rung.
template <class N>
[[nodiscard]] NumberVector<N> subtract_points(const Vector3& a, const Vector3& b) {
  return {N::difference(a[0], b[0]), N::difference(a[1], b[1]), N::difference(a[2], b[2])};
}

/// Value of a difference in the numbers of a rung (N::difference of two doubles).
template <class N>
[[nodiscard]] NumberVector<N> evaluate(const Difference& d) {
  const auto subtract = [](const Vector3& a, const Vector3* b) {
    if (b == nullptr) return NumberVector<N>{N(a[0]), N(a[1]), N(a[2])};
    return NumberVector<N>{N::difference(a[0], (*b)[0]), N::difference(a[1], (*b)[1]),
                           N::difference(a[2], (*b)[2])};
  };
  NumberVector<N> first = subtract(*d.plus, d.minus);
  if (d.plus2 == nullptr) return first;
  const NumberVector<N> second = subtract(*d.plus2, d.minus2);
  return {first.x + second.x, first.y + second.y, first.z + second.z};
}

template <class N>
NumberVector<N> ContactDirection::evaluate() const {
  NumberVector<N> w = ashlar::evaluate<N>(first_);
  if (kind_ != Kind::difference) {
    const NumberVector<N> e = ashlar::evaluate<N>(second_);
    w = ashlar::cross(w, e);
    if (kind_ == Kind::rejection) w = ashlar::cross(e, w);
  }
  if (!reversed_) return w;
  const N zero(0.0);
  return {zero - w.x, zero - w.y, zero - w.z};
}

}  // namespace ashlar
