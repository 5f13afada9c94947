#include "apps/program/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ashlar {
namespace {

struct Point {
  double x;
  double y;
};

/// Logarithms of the points that have one.
std::vector<Point> logarithms_of(const PlotSeries& series) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    const double x = series.x[k];
    const double y = series.y[k];
    if (x > 0.0 && y > 0.0 && std::isfinite(x) && std::isfinite(y))
      points.push_back({std::log10(x), std::log10(y)});
  }
  return points;
}

}  // namespace

double last_slope(const PlotSeries& series, std::size_t count) {
  std::vector<Point> points = logarithms_of(series);
  if (points.size() > count) points.erase(points.begin(), points.end() - static_cast<std::ptrdiff_t>(count));
  Point mean{0.0, 0.0};
  for (const Point& point : points) {
    mean.x += point.x / static_cast<double>(points.size());
    mean.y += point.y / static_cast<double>(points.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const Point& point : points) {
    covariance += (point.x - mean.x) * (point.y - mean.y);
    variance += (point.x - mean.x) * (point.x - mean.x);
  }
  return variance > 0.0 ? covariance / variance : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ashlar
