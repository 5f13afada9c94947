#include "apps/run/answers/pushover_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/run/answers/block_name.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// A plot of lines, in pixels.
class CurvePlot {
 public:
  CurvePlot(double most_x, double most_y) : step_x_(round_step(most_x)), step_y_(round_step(most_y)) {
    wide_ = step_x_ * std::ceil(most_x / step_x_ * (1.0 + 1e-9));
    high_ = step_y_ * std::ceil(most_y / step_y_ * (1.0 + 1e-9));
  }

  [[nodiscard]] std::string head() const {
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n",
        width, height);
    for (int k = 0; k * step_x_ <= wide_ * (1.0 + 1e-9); ++k)
      text += fmt::format(
          "<path d=\"M{0:.1f},{1}V{2}\" stroke=\"#e3e5e8\"/>\n<text x=\"{0:.1f}\" y=\"{3}\" "
          "text-anchor=\"middle\">{4:.4g}</text>\n",
          x(k * step_x_), top, height - bottom, height - bottom + 18, k * step_x_);
    for (int k = 0; k * step_y_ <= high_ * (1.0 + 1e-9); ++k)
      text += fmt::format(
          "<path d=\"M{0},{1:.1f}H{2}\" stroke=\"#e3e5e8\"/>\n<text x=\"{3}\" y=\"{4:.1f}\" "
          "text-anchor=\"end\">{5:.4g}</text>\n",
          left, y(k * step_y_), width - right, left - 6, y(k * step_y_) + 4, k * step_y_);
    return text;
  }

  [[nodiscard]] std::string line(const Pushover& path, const char* colour, double thickness) const {
    std::string text = "<polyline points=\"";
    for (const PushoverPlace& place : path.places)
      text += fmt::format("{:.2f},{:.2f} ", x(place.displacement), y(std::max(place.multiplier, 0.0)));
    return text + fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", colour, thickness);
  }

  [[nodiscard]] static std::string foot() {
    return fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">displacement of the control, "
        "m</text>\n<text x=\"16\" y=\"{:.0f}\" text-anchor=\"middle\" transform=\"rotate(-90 16 "
        "{:.0f})\">multiplier</text>\n</svg>\n",
        0.5 * (left + width - right), height - 8.0, 0.5 * height, 0.5 * height);
  }

 private:
  [[nodiscard]] double x(double value) const { return left + (width - left - right) * value / wide_; }
  [[nodiscard]] double y(double value) const {
    return height - bottom - (height - top - bottom) * value / high_;
  }
  /// 1, 2 or 5 times a power of ten: some six steps up to a value.
  static double round_step(double most) {
    constexpr double steps = 6.0;
    const double rough = std::max(most, 1e-12) / steps;
    const double power = correctly_rounded::pow(10.0, std::floor(correctly_rounded::log10(rough)));
    const double share = rough / power;
    return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
  }

  static constexpr double width = 720.0, height = 440.0, left = 70.0, right = 20.0, top = 20.0, bottom = 54.0;
  double step_x_, step_y_, wide_ = 1.0, high_ = 1.0;
};

}  // namespace

std::string pushover_table(const PushoverFindings& findings, const Simulation& simulation) {
  const PushedDirection& weakest = findings.weakest_direction();
  std::string table = "displacement,multiplier,spectral_displacement,spectral_acceleration,moving,blocks\n";
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double ratio = weakest.check ? weakest.check->capacity.displacement_ratio : none;
  const double scale = weakest.check && weakest.check->capacity.multiplier != 0.0
                           ? weakest.check->capacity.acceleration / weakest.check->capacity.multiplier
                           : none;
  for (const PushoverPlace& place : weakest.path.places) {
    std::string names;
    for (const int block : place.moving) names += (names.empty() ? "" : " ") + block_name(simulation, block);
    for (const double value : {place.displacement, place.multiplier, place.displacement * ratio,
                               place.multiplier * scale, static_cast<double>(place.moving.size())}) {
      append_csv_number(table, value);
      table += ',';
    }
    table += quote_csv_field(names) + '\n';
  }
  return table;
}

std::string pushover_picture(const PushoverFindings& findings) {
  double most_x = 0.0, most_y = 0.0;
  for (const PushedDirection& pushed : findings.directions)
    for (const PushoverPlace& place : pushed.path.places) {
      most_x = std::max(most_x, place.displacement);
      most_y = std::max(most_y, place.multiplier);
    }
  const CurvePlot plot(most_x, most_y);
  std::string text = plot.head();
  for (const PushedDirection& pushed : findings.directions) text += plot.line(pushed.path, "#a9b0b8", 1.0);
  return text + plot.line(findings.weakest_direction().path, "#1f5fa8", 2.5) + CurvePlot::foot();
}

void write_pushover(const PushoverFindings& findings, const Simulation& simulation,
                    const std::filesystem::path& folder) {
  const PushedDirection& weakest = findings.weakest_direction();
  if (weakest.path.places.empty()) return;
  write_file_atomically(folder / "pushover.csv", pushover_table(findings, simulation), Durability::process);
  write_file_atomically(folder / "pushover.svg", pushover_picture(findings), Durability::process);
  if (weakest.check)
    write_file_atomically(folder / "kinematic.csv", kinematic_table(*weakest.check), Durability::process);
}

}  // namespace ashlar
