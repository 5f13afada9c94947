#include "mechanics/contact/laws/rough_joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ashlar {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
/// Largest angle of friction, of Barton and Choubey.
constexpr double steepest = 70.0 * degree;
/// Slip over that of the peak, and JRC left, of Barton (1982).
constexpr std::array<std::pair<double, double>, 6> worn_roughness = {
    {{1.0, 1.0}, {2.0, 0.85}, {4.0, 0.7}, {10.0, 0.5}, {25.0, 0.4}, {100.0, 0.0}}};
constexpr double last_slip = worn_roughness.back().first;
/// L / 500 and the exponent of Barton's slip at the peak.
constexpr double lengths_of_slip = 500.0, slip_exponent = 0.33;

}  // namespace

double peak_slip_of(double jrc, double length) {
  return length / lengths_of_slip * std::pow(jrc / length, slip_exponent);
}

double roughness_left(double wear) {
  const double slip = last_slip * wear;
  for (std::size_t k = 0; k < worn_roughness.size(); ++k) {
    const auto& [end, left] = worn_roughness[k];
    if (slip > end) continue;
    if (k == 0) return left;
    const auto& [begin, before] = worn_roughness[k - 1];
    const double share = std::log(slip / begin) / std::log(end / begin);
    return before + (left - before) * share;
  }
  return worn_roughness.back().second;
}

PointRoughness point_roughness(const Roughness& roughness, double area, double wear) {
  PointRoughness rough;
  if (roughness.wears()) rough.last_slip = last_slip * roughness.peak_slip;
  if (!roughness.given() || !(area > 0.0)) return rough;
  rough.jrc = roughness.jrc * roughness_left(wear);
  rough.strength = roughness.jcs * area;
  rough.worn = roughness.worn;
  rough.share = roughness.share;
  return rough;
}

double wear_after(const PointRoughness& rough, double wear, double slip) {
  return std::min(1.0, wear + slip / rough.last_slip);
}

ShearBound rough_bound(const PointRoughness& rough, double normal) {
  const double decade = rough.jrc * degree / std::numbers::ln10;  // -d alpha / d ln(sigma)
  const double worn = std::atan(rough.worn);
  const auto slope_at = [&](double tangent) { return tangent - decade * (1.0 + tangent * tangent); };
  if (normal >= rough.strength) {
    const double slope = std::max(0.0, slope_at(rough.worn));
    return {rough.share * (rough.worn * rough.strength + slope * (normal - rough.strength)),
            rough.share * slope};
  }
  const double top = std::tan(std::max(steepest, worn));
  if (!(normal > 0.0)) return {0.0, rough.share * top};
  const double angle = worn + decade * std::log(rough.strength / normal);
  if (angle >= steepest) return {rough.share * top * normal, rough.share * top};
  const double tangent = std::tan(angle);
  return {rough.share * tangent * normal, rough.share * std::max(0.0, slope_at(tangent))};
}

}  // namespace ashlar
