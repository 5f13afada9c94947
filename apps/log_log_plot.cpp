#include "apps/log_log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/xml_text.hpp"

namespace ashlar {
namespace {

constexpr double width = 1000.0;
constexpr double height = 600.0;
constexpr double left = 90.0;
constexpr double right = 640.0;  // the legend is beside the axes
constexpr double top = 50.0;
constexpr double bottom = 530.0;

// Distinguishable without colour vision (Okabe and Ito), then darker ones.
constexpr std::array<const char*, 10> colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                "#56b4e9", "#000000", "#7f3c8d", "#6b6b00", "#a02c2c"};

struct Point {
  double x;
  double y;
};

/// Logarithms of the points that have one.
std::vector<Point> logarithms(const PlotSeries& series) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    const double x = series.x[k];
    const double y = series.y[k];
    if (x > 0.0 && y > 0.0 && std::isfinite(x) && std::isfinite(y))
      points.push_back({std::log10(x), std::log10(y)});
  }
  return points;
}

/// One axis: decades from the one below the least value to the one above the largest.
class Axis {
 public:
  Axis(double least, double most, double start, double end) : start_(start), end_(end) {
    first_ = static_cast<int>(std::floor(least));
    last_ = std::max(first_ + 1, static_cast<int>(std::ceil(most)));
  }
  [[nodiscard]] double place(double logarithm) const {
    return start_ + (logarithm - first_) / (last_ - first_) * (end_ - start_);
  }
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  /// Decades between labels, so that at most ten are written.
  [[nodiscard]] int stride() const { return (last_ - first_ + 9) / 10; }

 private:
  double start_;
  double end_;
  int first_ = 0;
  int last_ = 1;
};

std::string power_of_ten(double x, double y, int exponent, const char* anchor) {
  return fmt::format(
      R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">10<tspan dy="-6" font-size="11">{}</tspan></text>)"
      "\n",
      x, y, anchor, exponent);
}

std::string draw_axes(const LogLogPlot& plot, const Axis& x_axis, const Axis& y_axis) {
  std::string svg;
  for (int decade = x_axis.first(); decade <= x_axis.last(); decade += x_axis.stride()) {
    const double x = x_axis.place(decade);
    svg += fmt::format(R"(<line class="grid" x1="{0:.1f}" y1="{1}" x2="{0:.1f}" y2="{2}"/>)"
                       "\n",
                       x, top, bottom);
    svg += power_of_ten(x, bottom + 24.0, decade, "middle");
  }
  for (int decade = y_axis.first(); decade <= y_axis.last(); decade += y_axis.stride()) {
    const double y = y_axis.place(decade);
    svg += fmt::format(R"(<line class="grid" x1="{1}" y1="{0:.1f}" x2="{2}" y2="{0:.1f}"/>)"
                       "\n",
                       y, left, right);
    svg += power_of_ten(left - 8.0, y + 5.0, decade, "end");
  }
  svg += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>)"
                     "\n",
                     left, top, right - left, bottom - top);
  svg += fmt::format(R"(<text class="title" x="{}" y="28">{}</text>)"
                     "\n",
                     left, escape_xml(plot.title));
  svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
                     "\n",
                     0.5 * (left + right), height - 20.0, escape_xml(plot.x_label));
  svg += fmt::format(R"svg(<text transform="translate(24 {}) rotate(-90)" text-anchor="middle">{}</text>)svg"
                     "\n",
                     0.5 * (top + bottom), escape_xml(plot.y_label));
  return svg;
}

std::string draw_series(const PlotSeries& series, const std::vector<Point>& points, const Axis& x_axis,
                        const Axis& y_axis, const char* color) {
  std::string path;
  std::string marks;
  for (const Point& point : points) {
    const double x = x_axis.place(point.x);
    const double y = y_axis.place(point.y);
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", x, y);
    marks += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3" fill="{}"/>)"
                         "\n",
                         x, y, color);
  }
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.8"{}/>)"
                     "\n",
                     path, color, series.dashed ? R"( stroke-dasharray="6 4")" : "") +
         (series.dashed ? "" : marks);
}

}  // namespace

double last_slope(const PlotSeries& series, std::size_t count) {
  std::vector<Point> points = logarithms(series);
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

std::string to_svg(const LogLogPlot& plot) {
  std::vector<std::vector<Point>> points;
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-low.x, -low.y};
  for (const PlotSeries& series : plot.series) {
    points.push_back(logarithms(series));
    for (const Point& point : points.back()) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
  }
  if (!(low.x <= high.x)) low = high = {0.0, 0.0};
  const Axis x_axis(low.x, high.x, left, right);
  const Axis y_axis(low.y, high.y, bottom, top);
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">
<style>text {{ font: 14px sans-serif; }} .title {{ font: bold 16px sans-serif; }}
.grid {{ stroke: #ddd; }} .frame {{ fill: none; stroke: #444; }}</style>
<rect width="{0}" height="{1}" fill="white"/>
)",
      width, height);
  svg += draw_axes(plot, x_axis, y_axis);
  std::size_t color = 0;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const PlotSeries& series = plot.series[k];
    if (k > 0 && !series.same_color_as_last) ++color;
    const char* const stroke = colors[color % colors.size()];
    svg += draw_series(series, points[k], x_axis, y_axis, stroke);
    const double y = top + 12.0 + 22.0 * static_cast<double>(k);
    svg +=
        fmt::format(R"(<line x1="{0}" y1="{2:.1f}" x2="{1}" y2="{2:.1f}" stroke="{3}" stroke-width="2"{4}/>)"
                    "\n",
                    right + 16.0, right + 46.0, y, stroke, series.dashed ? R"( stroke-dasharray="6 4")" : "");
    const double slope = last_slope(series);
    const std::string note = std::isfinite(slope) ? fmt::format(" (slope {:.2f})", slope) : "";
    svg += fmt::format(R"(<text x="{}" y="{:.1f}">{}{}</text>)"
                       "\n",
                       right + 54.0, y + 5.0, escape_xml(series.name), note);
  }
  return svg + "</svg>\n";
}

}  // namespace ashlar
