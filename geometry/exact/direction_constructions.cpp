#include "geometry/exact/direction_constructions.hpp"

#include <optional>

#include "geometry/exact/exact_constructions.hpp"

namespace ashlar {

namespace {

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

// The point a + (b - a) s / (s - t), rounded; `heights` (of exact_constructions.hpp) gives s and t.
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
      [&](int i) { return exact_point_between(w, a, b, heights, i); });
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
  return exact_squared_height(w_, d_);
}

double ContactHeight::length() const {
  if (has_ratio_)
    if (const auto root = square_root(height_ * ratio_))
      if (const auto value = rounded(*root)) {
        ++ladder_.counts.filter;
        return *value;
      }
  ++ladder_.counts.exact;
  return exact_height(w_, d_);
}

Vector3 ContactHeight::shifted(const Vector3* x, int sign) const {
  return round_components(
      ladder_, has_ratio_,
      [&](int i) {
        const DoubleDouble step = component(w_.double_double(), i) * (sign < 0 ? -ratio_ : ratio_);
        return x != nullptr ? DoubleDouble((*x)[i]) + step : step;
      },
      [&](int i) { return exact_shifted(w_, d_, x, sign, i); });
}

Vector3 unit_vector(const ContactDirection& w, PredicateLadder& ladder) {
  std::optional<DoubleDouble> inverse;
  if (ladder.floating)
    if (const auto length = square_root(w.squared_length())) inverse = quotient(DoubleDouble(1.0), *length);
  return round_components(
      ladder, inverse.has_value(), [&](int i) { return component(w.double_double(), i) * *inverse; },
      [&](int i) { return exact_unit_component(w, i); });
}

Vector3 crossing_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                       const Vector3& d, PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, HeightsOverLine{a, b, c, d});
}

Vector3 plane_point(const ContactDirection& w, const Vector3& a, const Vector3& b, const Vector3& c,
                    PredicateLadder& ladder) {
  return round_between(ladder, w, a, b, HeightsOverPlane{a, b, c});
}

}  // namespace ashlar
