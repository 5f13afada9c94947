#include "mechanics/contact/pressure_end.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "mechanics/contact/overlap_outline.hpp"

namespace ashlar {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// The zero line of the weighted least-squares affine function of the gaps, if the gaps are close to it: gaps of
/// bulging joints have no line, and rounding must not choose one.
/// @param affine_share of the variation of the gaps
std::optional<PressureEnd> zero_line(const PolygonRule& rule, const std::vector<double>& gaps,
                                     double affine_share) {
  double area = 0.0;
  double mean_gap = 0.0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    area += rule.weights[k];
    mean_gap += rule.weights[k] * gaps[k];
    centroid += rule.weights[k] * rule.points[k];
  }
  mean_gap /= area;
  centroid /= area;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const Eigen::Vector2d arm = rule.points[k] - centroid;
    spread += rule.weights[k] * arm * arm.transpose();
    moment += rule.weights[k] * (gaps[k] - mean_gap) * arm;
  }
  const Eigen::Vector2d slope = spread.inverse() * moment;
  double variation = 0.0;
  for (std::size_t k = 0; k < gaps.size(); ++k)
    variation += rule.weights[k] * (gaps[k] - mean_gap) * (gaps[k] - mean_gap);
  if (!(slope.dot(moment) > affine_share * variation)) return std::nullopt;
  const double steepness = slope.squaredNorm();
  return PressureEnd{centroid - mean_gap / steepness * slope, slope};
}

}  // namespace

Corners part_under_pressure(const Corners& polygon, const PressureEnd& end) {
  Corners part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& here = polygon[k];
    const Eigen::Vector2d& next = polygon[(k + 1) % polygon.size()];
    const double at_here = end.open.dot(here - end.point);
    const double at_next = end.open.dot(next - end.point);
    if (at_here <= 0.0) part.push_back(here);
    if ((at_here < 0.0 && at_next > 0.0) || (at_here > 0.0 && at_next < 0.0))
      part.emplace_back(here + at_here / (at_here - at_next) * (next - here));
  }
  return part;
}

Corners part_without_pressure(const Corners& polygon, const PressureEnd& end) {
  return part_under_pressure(polygon, {end.point, -end.open});
}

std::optional<PressureEnd> end_of_pressure(const Corners& polygon, const PolygonRule& rule,
                                           const std::vector<double>& gaps, double tolerance,
                                           const std::optional<PressureEnd>& known) {
  if (gaps.empty()) return std::nullopt;
  constexpr double share = 0.05;
  constexpr double affine_to_cut = 0.5;
  constexpr double affine_to_stay_cut = 0.25;
  const double least = *std::min_element(gaps.begin(), gaps.end());
  const double most = *std::max_element(gaps.begin(), gaps.end());
  std::optional<PressureEnd> end;
  Corners pressed = polygon;
  // An area between the points of the whole rule may be under pressure if the gap bulges.
  if ((known || least < -tolerance) && most > tolerance) {
    end = zero_line(rule, gaps, known ? affine_to_stay_cut : affine_to_cut);
    if (end) pressed = part_under_pressure(polygon, *end);
    if (area_of(pressed) <= 0.0 || area_of(pressed) >= area_of(polygon)) end.reset();
  } else if (most > tolerance) {
    pressed.clear();
  }
  const Corners known_pressed = known ? part_under_pressure(polygon, *known) : polygon;
  const Corners both = known ? part_under_pressure(pressed, *known) : pressed;
  const double differing = area_of(pressed) + area_of(known_pressed) - 2.0 * area_of(both);
  return differing <= share * area_of(pressed) ? known : end;
}

}  // namespace ashlar
