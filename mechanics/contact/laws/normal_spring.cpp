#include "mechanics/contact/laws/normal_spring.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// -u - ln(1 - u) = u^2/2 + u^3/3 + ..., for 0 <= u < 1, without cancellation.
double excess(double u) {
  constexpr double small = 0.05;  // 12 terms of the series are exact to rounding
  constexpr int last_power = 13;
  if (u > small) return -u - correctly_rounded::log1p(-u);
  double sum = 0.0;
  for (int power = last_power; power >= 2; --power) sum = sum * u + 1.0 / power;
  return sum * u * u;
}

}  // namespace

double NormalSpring::force_of_curve(double closure) const {
  const double end = end_of_curve * largest_closure;
  if (closure <= end) return stiffness * closure / (1.0 - closure / largest_closure);
  return force_of_curve(end) + slope_of_curve(end) * (closure - end);
}

double NormalSpring::slope_of_curve(double closure) const {
  const double left = 1.0 - std::min(closure / largest_closure, end_of_curve);
  return stiffness / (left * left);
}

/// Between the shares x1 and x2 of the largest closure, x/(1 - x) has its pole at p = (2 - x1 - x2)/(x2 - x1) of the half-width
/// from the middle, so that errors of Gauss's rules fall by p + sqrt(p^2 - 1) with each degree.
int NormalSpring::needed_degree(double from, double to) const {
  constexpr double accuracy = 1e-3;
  constexpr int finest = 16;
  const double low = std::clamp(closed_share(from), 0.0, end_of_curve);
  const double high = std::clamp(closed_share(to), 0.0, end_of_curve);
  if (!(high > low)) return 0;
  const double pole = (2.0 - low - high) / (high - low);
  const double fall = pole + std::sqrt(pole * pole - 1.0);
  int needed = 0;
  for (double error = 1.0 / fall; error > accuracy && needed < finest; error /= fall) ++needed;
  return needed == 0 ? 0 : needed + 1;  // times the lever of a moment
}

double NormalSpring::closure(double force) const {
  if (!stiffens() || !(force > 0.0)) return force / stiffness;
  const double end = end_of_curve * largest_closure;
  const double at_end = force_of_curve(end);
  if (force <= at_end) return force / (stiffness + force / largest_closure);
  return end + (force - at_end) / slope_of_curve(end);
}

double NormalSpring::work(double from, double to) const {
  const double end = end_of_curve * largest_closure;
  const double start = std::max(from, 0.0);
  double sum = 0.0;
  if (start < std::min(to, end)) {
    const double x = start / largest_closure;
    // Of a small change too, the difference comes first: it is exact.
    const double u = (std::min(to, end) - start) / largest_closure / (1.0 - x);
    sum += stiffness * largest_closure * largest_closure * (excess(u) + u * x);
  }
  const double beyond = std::max(start, end);
  if (to > beyond) sum += 0.5 * (force_of_curve(beyond) + force_of_curve(to)) * (to - beyond);
  return sum;
}

MeanCompression NormalSpring::mean_compression(double from, double to) const {
  constexpr double small = 1e-4;  // of the closure that is left: two terms are exact to its square
  const auto [low, high] = std::minmax(from, to);
  if (high <= 0.0) return {0.0, 0.0};
  const double left = largest_closure - std::min(high, end_of_curve * largest_closure);
  const double mean = high > low ? work(low, high) / (high - low) : force(to);
  if (low > 0.0 && high - low <= small * left) return {mean, 0.5 * slope(from + 2.0 / 3.0 * (to - from))};
  return {mean, (std::max(force(to), 0.0) - mean) / (to - from)};
}

}  // namespace ashlar
