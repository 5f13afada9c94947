#include "apps/run/answers/elastic_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/scene/model/scene_record.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

using Soil = SceneSpectrum::Soil;

/// A spectrum of the form that both codes have.
struct CodeShape {
  double soil;        ///< S
  double plateau;     ///< 2.5 or F0
  double tb, tc, td;  ///< s
};

/// Tables 3.2 and 3.3.
CodeShape shape_of_ec8(const SceneSpectrum& spectrum) {
  struct Row {
    double soil, tb, tc, td;
  };
  constexpr std::array<std::array<Row, 5>, 2> rows = {{{{{1.0, 0.15, 0.4, 2.0},
                                                         {1.2, 0.15, 0.5, 2.0},
                                                         {1.15, 0.2, 0.6, 2.0},
                                                         {1.35, 0.2, 0.8, 2.0},
                                                         {1.4, 0.15, 0.5, 2.0}}},
                                                       {{{1.0, 0.05, 0.25, 1.2},
                                                         {1.35, 0.05, 0.25, 1.2},
                                                         {1.5, 0.1, 0.25, 1.2},
                                                         {1.8, 0.1, 0.3, 1.2},
                                                         {1.6, 0.05, 0.25, 1.2}}}}};
  const Row& row = rows[spectrum.type == 2 ? 1 : 0][static_cast<std::size_t>(spectrum.soil)];
  return {row.soil, 2.5, row.tb, row.tc, row.td};
}

/// Table 3.2.IV.
CodeShape shape_of_ntc(const SceneSpectrum& spectrum) {
  const double f0 = spectrum.amplification, tc = spectrum.corner_period;
  const double share = f0 * spectrum.ground_acceleration / standard_gravity;
  double ss = 1.0, cc = 1.0;
  switch (spectrum.soil) {
    case Soil::a:
      break;
    case Soil::b:
      ss = std::clamp(1.4 - 0.4 * share, 1.0, 1.2);
      cc = 1.1 * correctly_rounded::pow(tc, -0.2);
      break;
    case Soil::c:
      ss = std::clamp(1.7 - 0.6 * share, 1.0, 1.5);
      cc = 1.05 * correctly_rounded::pow(tc, -0.33);
      break;
    case Soil::d:
      ss = std::clamp(2.4 - 1.5 * share, 0.9, 1.8);
      cc = 1.25 * correctly_rounded::pow(tc, -0.5);
      break;
    case Soil::e:
      ss = std::clamp(2.0 - 1.1 * share, 1.0, 1.6);
      cc = 1.15 * correctly_rounded::pow(tc, -0.4);
      break;
  }
  const double corner = cc * tc;
  return {ss * spectrum.topography, f0, corner / 3.0, corner,
          4.0 * spectrum.ground_acceleration / standard_gravity + 1.6};
}

double acceleration_of(const CodeShape& shape, double ground, double damping, double period) {
  const double eta = std::max(0.55, std::sqrt(10.0 / (5.0 + damping)));
  const double top = ground * shape.soil * eta * shape.plateau;
  if (period <= shape.tb)
    return ground * shape.soil * (1.0 + period / shape.tb * (eta * shape.plateau - 1.0));
  if (period <= shape.tc) return top;
  if (period <= shape.td) return top * shape.tc / period;
  return top * shape.tc * shape.td / (period * period);
}

double between_points(const std::vector<SceneSpectrum::Point>& points, double period) {
  if (points.empty()) return 0.0;
  const auto after = std::find_if(points.begin(), points.end(), [period](const SceneSpectrum::Point& point) {
    return point.period >= period;
  });
  if (after == points.begin()) return points.front().acceleration;
  if (after == points.end()) return points.back().acceleration;
  const SceneSpectrum::Point& before = *std::prev(after);
  const double share = (period - before.period) / (after->period - before.period);
  return (1.0 - share) * before.acceleration + share * after->acceleration;
}

}  // namespace

double spectral_acceleration(const SceneSpectrum& spectrum, double period) {
  constexpr double usual_damping = 5.0;
  const double damping = spectrum.damping.value_or(usual_damping);
  switch (spectrum.source) {
    case SceneSpectrum::Source::none:
      return 0.0;
    case SceneSpectrum::Source::points:
      return between_points(spectrum.points, period);
    case SceneSpectrum::Source::ec8:
      return acceleration_of(shape_of_ec8(spectrum), spectrum.ground_acceleration, damping, period);
    case SceneSpectrum::Source::ntc2018:
      return acceleration_of(shape_of_ntc(spectrum), spectrum.ground_acceleration, damping, period);
  }
  return 0.0;
}

double spectral_displacement(const SceneSpectrum& spectrum, double period) {
  const double share = period / (2.0 * std::numbers::pi);
  return share * share * spectral_acceleration(spectrum, period);
}

}  // namespace ashlar
