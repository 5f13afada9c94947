// Plots of studies, sweeps, fragility, spectra and block sizes (drawn by plot_script.hpp). The legend of a study shows the slope of
// the last points of every series, the result of a convergence study.
#pragma once

#include <string>
#include <vector>

namespace ashlar {

enum class PlotAxes { logarithmic, linear, logarithmic_x };

/// Points of a series that are not finite, or not positive along a logarithmic axis, are not drawn.
struct PlotSeries {
  std::string name;  ///< empty: not in the legend
  std::vector<double> x;
  std::vector<double> y;
  bool dashed = false;
  bool marks = true;                ///< at points
  bool same_color_as_last = false;  ///< a companion of the series before it, e.g. its bound
  bool line = true;                 ///< between points
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  bool slopes = true;  ///< write them into the legend; false if no power law is expected
  PlotAxes axes = PlotAxes::logarithmic;
};

/// Slope d log y / d log x through the last `count` points by least squares; NaN with fewer than two
/// different x.
[[nodiscard]] double last_slope(const PlotSeries& series, std::size_t count = 3);

}  // namespace ashlar
