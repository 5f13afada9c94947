#include "mechanics/spring_energy.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ashlar {

double rest_gap(const std::vector<double>& stiffnesses, const std::vector<double>& gaps, double held) {
  if (held == 0.0) return std::min(0.0, *std::min_element(gaps.begin(), gaps.end()));
  // The root of the energy is a convex function of the rest, so that Newton's iterates come down to the
  // solution one by one.
  const double target = std::sqrt(2.0 * held);
  double rest = 0.0;
  while (true) {
    double squares = 0.0;
    double slope = 0.0;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const double depth = rest - gaps[k];
      if (!(depth > 0.0)) continue;
      squares += stiffnesses[k] * depth * depth;
      slope += stiffnesses[k] * depth;
    }
    const double root = std::sqrt(squares);
    if (!(root > target)) return rest;
    const double next = rest - (root - target) * root / slope;
    if (!(next < rest)) return rest;
    rest = next;
  }
}

}  // namespace ashlar
