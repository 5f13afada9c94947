#include "mechanics/contact/laws/spring_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ashlar {

double rest_gap(const std::vector<NormalSpring>& springs, const std::vector<double>& gaps, double held) {
  if (held == 0.0) return std::min(0.0, *std::min_element(gaps.begin(), gaps.end()));
  // The root of the energy is a convex function of the rest gap, as that of each spring is, so that Newton's iterates decrease monotonically to
  // the solution.
  const double target = std::sqrt(2.0 * held);
  double rest = 0.0;
  while (true) {
    double squares = 0.0;
    double slope = 0.0;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const double depth = rest - gaps[k];
      if (!(depth > 0.0)) continue;
      squares += 2.0 * springs[k].energy(depth);
      slope += springs[k].force(depth);
    }
    const double root = std::sqrt(squares);
    if (!(root > target)) return rest;
    const double next = rest - (root - target) * root / slope;
    if (!(next < rest)) return rest;
    rest = next;
  }
}

std::vector<double> rest_gaps(const std::vector<NormalSpring>& springs, const std::vector<double>& gaps,
                              const std::vector<double>& remembered, double held) {
  const std::size_t count = gaps.size();
  const double target = std::sqrt(2.0 * held);
  std::vector<double> known(count);
  for (std::size_t k = 0; k < count; ++k) known[k] = std::max(remembered[k], std::min(0.0, gaps[k]));
  // Root of twice the energy at a share of the known rest gaps, and its derivative.
  const auto root = [&](double share) {
    double squares = 0.0;
    double slope = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double depth = share * known[k] - gaps[k];
      if (!(depth > 0.0)) continue;
      squares += 2.0 * springs[k].energy(depth);
      slope += springs[k].force(depth) * known[k];
    }
    const double value = std::sqrt(squares);
    return std::array{value, value > 0.0 ? slope / value : 0.0};
  };
  std::vector<double> rests(count, 0.0);
  if (root(0.0)[0] <= target) return rests;
  constexpr double less = 1.0 - 1e-9;
  if (!(root(1.0)[0] < less * target)) {
    std::vector<double> lowered(count);
    for (std::size_t k = 0; k < count; ++k) lowered[k] = gaps[k] - known[k];
    const double below = rest_gap(springs, lowered, held);
    for (std::size_t k = 0; k < count; ++k) rests[k] = known[k] + below;
    return rests;
  }
  // A convex decreasing function of the share: Newton's iterates increase monotonically to the solution.
  double share = 0.0;
  while (share < 1.0) {
    const auto [value, slope] = root(share);
    if (!(value > target) || slope == 0.0) break;
    const double next = std::min(1.0, share - (value - target) / slope);
    if (!(next > share)) break;
    share = next;
  }
  for (std::size_t k = 0; k < count; ++k) rests[k] = share * known[k];
  return rests;
}

}  // namespace ashlar
