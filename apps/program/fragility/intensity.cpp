#include "apps/program/fragility/intensity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/results/tables/response_spectrum.hpp"
#include "apps/results/text/csv_text.hpp"

namespace ashlar {
namespace {

constexpr double critical_share = 0.05;

double of_component(const IntensityMeasure& measure, const std::vector<double>& times,
                    const std::vector<double>& values) {
  if (measure.kind == IntensityMeasure::Kind::sa && times.size() > 1)
    return response_spectrum(segments_of_acceleration(times, values), {measure.period}, critical_share)
        .front()
        .pseudo_acceleration;
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

std::string IntensityMeasure::name() const {
  switch (kind) {
    case Kind::pga:
      return "pga";
    case Kind::sa:
      return fmt::format("sa({})", period);
    case Kind::scale:
      return "scale";
  }
  return "pga";
}

std::string IntensityMeasure::unit() const {
  return kind == Kind::scale ? "" : "m/s^2";
}

IntensityMeasure parse_intensity(const std::string& text) {
  if (text == "pga") return {};
  if (text == "scale") return {IntensityMeasure::Kind::scale, 0.0};
  constexpr std::string_view open = "sa(";
  if (text.starts_with(open) && text.ends_with(')')) {
    const auto period = csv_number(std::string_view(text).substr(open.size(), text.size() - open.size() - 1));
    if (period && *period > 0.0 && std::isfinite(*period)) return {IntensityMeasure::Kind::sa, *period};
  }
  throw std::invalid_argument(fmt::format(
      "--intensity is no measure of intensity ({}), pga, scale or sa(PERIOD) with a period > 0 in s "
      "is needed",
      text));
}

std::optional<double> intensity_of(const IntensityMeasure& measure, const std::vector<SceneFix::Motion>& rows,
                                   const Vector3& up) {
  constexpr double across =
      0.5;  // of a component's axis along gravity: between horizontal ones and the vertical one
  std::vector<double> times;
  for (const SceneFix::Motion& row : rows) times.push_back(row.time);
  double horizontal = 0.0, other = 0.0;  // sums of logarithms
  int horizontals = 0, others = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const SceneFix::Motion& row : rows) values.push_back(row.value[axis]);
    if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; })) continue;
    const bool is_horizontal = std::abs(up[axis]) < across;
    (is_horizontal ? horizontal : other) += std::log(of_component(measure, times, values));
    ++(is_horizontal ? horizontals : others);
  }
  if (horizontals + others == 0) return std::nullopt;
  if (measure.kind == IntensityMeasure::Kind::scale) return 1.0;
  return std::exp(horizontals > 0 ? horizontal / horizontals : other / others);
}

}  // namespace ashlar
