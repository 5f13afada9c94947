// Plots as SVG: pictures of studies, with logarithmic axes, and of sweeps, with linear ones. The legend of a study
// shows the slope of the last points of every series, the result of a convergence study.
#pragma once

#include <string>
#include <vector>

namespace ashlar {

/// Points of a series that are not finite, and on logarithmic axes those that are not positive, are not drawn.
struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  bool dashed = false;
  bool marks = true;                ///< at points
  bool same_color_as_last = false;  ///< a companion of the series before it, e.g. its bound
};

struct LogLogPlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool slopes = true;   ///< write them into the legend; false if no power law is expected
  bool linear = false;  ///< both axes
};

/// Slope d log y / d log x through the last `count` points by least squares; NaN with fewer than two
/// different x.
[[nodiscard]] double last_slope(const PlotSeries& series, std::size_t count = 3);

/// Pixels of to_svg.
inline constexpr int plot_width = 1000;
inline constexpr int plot_height = 600;

/// A self-contained SVG document.
[[nodiscard]] std::string to_svg(const LogLogPlot& plot);

}  // namespace ashlar
