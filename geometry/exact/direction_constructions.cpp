#include "geometry/exact/direction_constructions.hpp"

#include <CGAL/Gmpq.h>

#include <optional>
#include <utility>

#include "geometry/exact/exact_direction.hpp"
#include "geometry/exact/exact_rounding.hpp"

namespace ashlar {
namespace {

template <class N>
struct Fraction {
  N numerator, denominator;
};

CGAL::Gmpq rational(const Fraction<Exact>& f) {
  return CGAL::Gmpq(static_cast<CGAL::Gmpq>(f.numerator) / static_cast<CGAL::Gmpq>(f.denominator));
}

// Rounds three components: `floating(i)` gives one as an optional DoubleDouble and is asked where `usable`,
// `exact(i)` gives the nearest double and is asked where that leaves a doubt.
template <class Floating, class ExactOf>
Vector3 round_components(PredicateLadder& ladder, bool usable, const Floating& floating,
                         const ExactOf& exact) {
  Vector3 result;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = usable ? rounded(floating(i)) : std::nullopt;
    ++(value ? ladder.counts.filter : ladder.counts.exact);
    result[i] = value ? *value : exact(i);
  }
  return result;
}

template <class N>
const N& component(const NumberVector<N>& v, int i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

// The point a + (b - a) s / (s - t), rounded; `heights` (a generic function of w) gives s and t.
template <class HeightsOf>
Vector3 round_between(PredicateLadder& ladder, const ContactDirection& w, const Vector3& a, const Vector3& b,
                      const HeightsOf& heights) {
  std::optional<DoubleDouble> ratio;
  if (ladder.floating) {
    const auto [s, t] = heights(w.double_double());
    ratio = quotient(s, s - t);
  }
  return round_components(
      ladder, ratio.has_value(),
      [&](int i) { return DoubleDouble(a[i]) + DoubleDouble::difference(b[i], a[i]) * *ratio; },
      [&](int i) {
        const auto [s, t] = heights(w.exact().value);
        const Exact width = s - t;
        const Exact numerator = Exact(a[i]) * width + Exact::difference(b[i], a[i]) * s;
        return round_to_nearest(rational({numerator, width}).mpq());
      });
}

}  // namespace

ContactHeight::ContactHeight(const ContactDirection& w, const Difference& d, PredicateLadder& ladder)
    : w_(w), d_(d), ladder_(ladder) {
  if (!ladder.floating) return;
  height_ = dot(w.double_double(), evaluate<DoubleDouble>(d));
  if (const auto ratio = quotient(height_, w.squared_length())) {
    ratio_ = *ratio;
    has_ratio_ = true;
  }
}

double ContactHeight::squared() const {
  if (has_ratio_)
    if (const auto value = rounded(height_ * ratio_)) {
      ++ladder_.counts.filter;
      return *value;
    }
  ++ladder_.counts.exact;
  const NumberVector<Exact>& w = w_.exact().value;
  const Exact height = dot(w, evaluate<Exact>(d_));
  return round_to_nearest(rational({height * height, dot(w, w)}).mpq());
}

double ContactHeight::length() const {
  if (has_ratio_)
    if (const auto root = square_root(height_ * ratio_))
      if (const auto value = rounded(*root)) {
        ++ladder_.counts.filter;
        return *value;
      }
  ++ladder_.counts.exact;
  const NumberVector<Exact>& w = w_.exact().value;
  const Exact height = dot(w, evaluate<Exact>(d_));
  return round_square_root(rational({height * height, dot(w, w)}).mpq());
}

Vector3 ContactHeight::shifted(const Vector3* x, int sign) const {
  return round_components(
      ladder_, has_ratio_,
      [&](int i) {
        const DoubleDouble step = component(w_.double_double(), i) * (sign < 0 ? -ratio_ : ratio_);
        return x != nullptr ? DoubleDouble((*x)[i]) + step : step;
      },
      [&](int i) {
        const NumberVector<Exact>& w = w_.exact().value;
        const Exact squared_length = dot(w, w);
        Exact numerator = component(w, i) * dot(w, evaluate<Exact>(d_)) * Exact(sign);
        if (x != nullptr) numerator = numerator + Exact((*x)[i]) * squared_length;
        return round_to_nearest(rational({numerator, squared_length}).mpq());
      });
}

Vector3 unit_vector(const ContactDirection& w, PredicateLadder& ladder) {
  std::optional<DoubleDouble> inverse;
  if (ladder.floating)
    if (const auto length = square_root(w.squared_length())) inverse = quotient(DoubleDouble(1.0), *length);
  return round_components(
      ladder, inverse.has_value(), [&](int i) { return component(w.double_double(), i) * *inverse; },
      [&](int i) {
        const NumberVector<Exact>& v = w.exact().value;
        const Exact& own = component(v, i);
        return sign_of(own) * round_square_root(rational({own * own, dot(v, v)}).mpq());
      });
}

Vector3 crossing_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                       const Vector3& d, PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, [&]<class N>(const NumberVector<N>& v) {
    const NumberVector<N> across = cross(v, subtract_points<N>(d, c));
    return std::pair<N, N>(dot(across, subtract_points<N>(a, c)), dot(across, subtract_points<N>(b, c)));
  });
}

Vector3 plane_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                    PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, [&]<class N>(const NumberVector<N>& v) {
    return std::pair<N, N>(dot(v, subtract_points<N>(a, c)), dot(v, subtract_points<N>(b, c)));
  });
}

}  // namespace ashlar
