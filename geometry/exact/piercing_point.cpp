#include "geometry/exact/piercing_point.hpp"

#include <cmath>

namespace ashlar {

namespace {

// Several numbers in one vector: both heights, or the coordinates.
template <int n>
using Lanes = Eigen::Array<double, n, 1>;

// exact_sum of double_double.hpp.
template <class L>
[[gnu::always_inline]] inline void add(const L& a, const L& b, L& sum, L& rest) {
  sum = a + b;
  const L b_part = sum - a;
  rest = (a - (sum - b_part)) + (b - b_part);
}

// exact_product of double_double.hpp.
template <class L>
[[gnu::always_inline]] inline void multiply(const L& a, const L& b, L& product, L& rest) {
  constexpr double splitter = 0x1p27 + 1.0;
  const L a_scaled = splitter * a, b_scaled = splitter * b;
  const L a_high = a_scaled - (a_scaled - a), b_high = b_scaled - (b_scaled - b);
  const L a_low = a - a_high, b_low = b - b_high;
  product = a * b;
  rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

// The error of high + low is at most `error`.
struct Heights {
  Lanes<2> high, low, size, error;
};

// N . (x - c) for two points x. With S = sum |N_i| |x_i - c_i| the low parts add up to less than 5 u S, and
// nine additions of them, the three roundings of each term of second order and the product left out lose less
// than 52 u^2 S < 2^-100 S.
Heights heights_above(const NumberVector<DoubleDouble>& n, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  Heights h{Lanes<2>::Zero(), Lanes<2>::Zero(), Lanes<2>::Zero(), Lanes<2>::Zero()};
  const DoubleDouble* const components[3] = {&n.x, &n.y, &n.z};
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble& w = *components[i];
    Lanes<2> difference, difference_low, product, product_low, sum, sum_low;
    add<Lanes<2>>({a[i], b[i]}, {-c[i], -c[i]}, difference, difference_low);
    multiply<Lanes<2>>({w.high, w.high}, difference, product, product_low);
    add(h.high, product, sum, sum_low);
    h.high = sum;
    h.low += (product_low + sum_low) + (w.high * difference_low + w.low * difference);
    h.size += product.abs();
    h.error += w.error * difference.abs();
  }
  h.error += 0x1p-100 * h.size;
  return h;
}

// s / (s - t), |true - (high + low)| <= error.
//
// With Z the sum of both sizes and W = s - t the roundings lose less than 32 u^2 Z in W; less than 164 u^2 Z
// / W in the remainder of the first quotient and its division; and 210 u^2 (Z / W)^2 by dividing it by the
// high part of W only.
std::optional<DoubleDouble> ratio(const Heights& h) {
  const auto [width, width_rest] = exact_sum(h.high[0], -h.high[1]);
  const double width_low = width_rest + (h.low[0] - h.low[1]);
  const double size = h.size[0] + h.size[1];
  const double width_error = (h.error[0] + h.error[1]) + 0x1p-100 * size;
  if (!((size + width_error * 0x1p40) * 0x1p-20 < std::abs(width))) return std::nullopt;
  const double inverse = 1.0 / width;
  const double first = h.high[0] * inverse;
  if (!(std::abs(first) <= 1.0 + 0x1p-20)) return std::nullopt;
  const auto [product, product_low] = exact_product(first, width);
  const double remainder = ((h.high[0] - product) - product_low) + (h.low[0] - first * width_low);
  const auto [high, low] = exact_sum(first, remainder * inverse);
  const double relative_size = size * inverse;
  const double inherited = (h.error[0] + 2.0 * width_error) * std::abs(inverse) * (1.0 + 0x1p-15);
  return DoubleDouble(high, low, inherited + 0x1p-97 * (relative_size * relative_size));
}

}  // namespace

std::optional<Eigen::Vector3d> quick_piercing_point(const NumberVector<DoubleDouble>& n,
                                                    const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                    const Eigen::Vector3d& c) {
  const std::optional<DoubleDouble> t = ratio(heights_above(n, a, b, c));
  if (!t) return std::nullopt;
  using Four = Lanes<4>;  // the last repeats the third
  const Four from(a[0], a[1], a[2], a[2]), to(b[0], b[1], b[2], b[2]);
  Four step, step_low, product, product_low, sum, sum_low;
  add<Four>(to, -from, step, step_low);
  multiply<Four>(step, Four::Constant(t->high), product, product_low);
  add<Four>(from, product, sum, sum_low);
  const Four low = (sum_low + product_low) + (step * t->low + step_low * t->high);
  // The roundings lose less than u^2 (10 |product| + 2 |sum|); those of the next two lines are covered too.
  const Four bound = 0x1p-101 * (product.abs() + sum.abs()) + step.abs() * (t->error * (1.0 + 0x1p-20)) +
                     low.abs() * (4.0 * TrackedNumber::unit_roundoff);
  const Four above = sum + (low + bound), below = sum + (low - bound);
  if (!(above == below).all()) return std::nullopt;
  return above.head<3>().matrix();
}

}  // namespace ashlar
