#include "apps/program/study/log_log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "apps/results/text/xml_text.hpp"

namespace ashlar {
namespace {

constexpr double width = plot_width;
constexpr double height = plot_height;
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

/// Points in the coordinates of the axes: their logarithms, if they exist, unless the axes are linear.
std::vector<Point> points_of(const PlotSeries& series, bool linear) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    const double x = series.x[k];
    const double y = series.y[k];
    if (linear && std::isfinite(x) && std::isfinite(y)) points.push_back({x, y});
    if (linear) continue;
    if (x > 0.0 && y > 0.0 && std::isfinite(x) && std::isfinite(y))
      points.push_back({std::log10(x), std::log10(y)});
  }
  return points;
}

/// One axis. A logarithmic one extends from the last 1, 2 or 5 times a power of ten at or below the smallest value to
/// the first above the largest; a linear one from tick to tick, with intervals of 1, 2 or 5 times a power of ten.
class Axis {
 public:
  struct Tick {
    double value;       ///< in the coordinates of the axis
    std::string label;  ///< SVG; empty: a fine line only
  };
  struct Ends {
    double start;  ///< in pixels
    double end;
  };

  Axis(double least, double most, Ends ends, bool linear) : ends_(ends), low_(least), high_(most) {
    if (linear) {
      step_ = linear_step(most > least ? most - least : std::max(std::abs(most), 1.0));
      low_ = std::floor(least / step_ + slack) * step_;
      high_ = std::ceil(most / step_ - slack) * step_;
    } else {
      low_ = round_mantissa(least, false);
      high_ = round_mantissa(most, true);
    }
    if (high_ <= low_) high_ = low_ + (linear ? step_ : 1.0);
  }

  [[nodiscard]] double place(double value) const {
    return ends_.start + (value - low_) / (high_ - low_) * (ends_.end - ends_.start);
  }

  [[nodiscard]] std::vector<Tick> ticks() const { return step_ > 0.0 ? linear_ticks() : decade_ticks(); }

 private:
  // Far below the resolution of a picture, far above the rounding of logarithms.
  static constexpr double slack = 1e-9;

  /// Interval for four to ten ticks.
  static double linear_step(double range) {
    const double power = std::pow(10.0, std::floor(std::log10(range / 4.0)));
    for (const double mantissa : {5.0, 2.0})
      if (mantissa * power <= range / 4.0) return mantissa * power;
    return power;
  }

  [[nodiscard]] std::vector<Tick> linear_ticks() const {
    std::vector<Tick> ticks;
    const auto first = std::llround(low_ / step_), last = std::llround(high_ / step_);
    for (auto k = first; k <= last; ++k) {
      const double value = static_cast<double>(k) * step_;
      ticks.push_back({value, fmt::format("{:.10g}", value)});
    }
    return ticks;
  }

  [[nodiscard]] std::vector<Tick> decade_ticks() const {
    const double decades = high_ - low_;
    const int stride = static_cast<int>(std::ceil(decades / 10.0));
    std::vector<Tick> ticks;
    for (int exponent = static_cast<int>(std::floor(low_)); exponent <= high_ + slack; ++exponent) {
      for (int mantissa = 1; mantissa < 10; ++mantissa) {
        const double logarithm = exponent + std::log10(mantissa);
        if (logarithm < low_ - slack || logarithm > high_ + slack) continue;
        const bool labelled =
            mantissa == 1 ? exponent % stride == 0
                          : decades <= 1.0 + slack || (decades < 3.0 && (mantissa == 2 || mantissa == 5));
        const bool fine = mantissa == 1 || decades < 6.0;
        if (labelled || fine)
          ticks.push_back({logarithm, labelled ? label(mantissa, exponent, decades < 3.0) : ""});
      }
    }
    return ticks;
  }

  static double round_mantissa(double logarithm, bool up) {
    const double exponent = std::floor(logarithm + slack);
    const std::array<double, 4> choices = {0.0, std::log10(2.0), std::log10(5.0), 1.0};
    const double part = logarithm - exponent;
    if (up)
      return exponent +
             *std::find_if(choices.begin(), choices.end(), [&](double c) { return c >= part - slack; });
    return exponent +
           *std::find_if(choices.rbegin(), choices.rend(), [&](double c) { return c <= part + slack; });
  }

  static std::string label(int mantissa, int exponent, bool plain) {
    if (plain && exponent >= -3 && exponent <= 4)
      return fmt::format("{:g}", mantissa * std::pow(10.0, exponent));
    const std::string power = fmt::format(R"(10<tspan dy="-6" font-size="11">{}</tspan>)", exponent);
    return mantissa == 1 ? power : fmt::format("{}\u00b7{}", mantissa, power);
  }

  Ends ends_;
  double low_;
  double high_;
  double step_ = 0.0;  ///< between ticks of a linear axis; 0: it is logarithmic
};

std::string text_at(double x, double y, const char* anchor, std::string_view text) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)"
                     "\n",
                     x, y, anchor, text);
}

std::string draw_grid(const Axis& x_axis, const Axis& y_axis) {
  const auto line = [](const Axis::Tick& tick, double x1, double y1, double x2, double y2) {
    return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)"
                       "\n",
                       tick.label.empty() ? "fine" : "grid", x1, y1, x2, y2);
  };
  std::string svg;
  for (const Axis::Tick& tick : x_axis.ticks()) {
    const double x = x_axis.place(tick.value);
    svg += line(tick, x, top, x, bottom);
    if (!tick.label.empty()) svg += text_at(x, bottom + 24.0, "middle", tick.label);
  }
  for (const Axis::Tick& tick : y_axis.ticks()) {
    const double y = y_axis.place(tick.value);
    svg += line(tick, left, y, right, y);
    if (!tick.label.empty()) svg += text_at(left - 8.0, y + 5.0, "end", tick.label);
  }
  return svg;
}

std::string draw_axes(const LogLogPlot& plot, const Axis& x_axis, const Axis& y_axis) {
  std::string svg = draw_grid(x_axis, y_axis);
  svg += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>)"
                     "\n",
                     left, top, right - left, bottom - top);
  svg += fmt::format(R"(<text class="title" x="{}" y="28">{}</text>)"
                     "\n",
                     left, escape_xml(plot.title));
  svg += text_at(0.5 * (left + right), height - 20.0, "middle", escape_xml(plot.x_label));
  svg += fmt::format(R"svg(<text transform="translate(24 {}) rotate(-90)" text-anchor="middle">{}</text>)svg"
                     "\n",
                     0.5 * (top + bottom), escape_xml(plot.y_label));
  return svg;
}

std::string dash_of(const PlotSeries& series) {
  return series.dashed ? R"( stroke-dasharray="6 4")" : "";
}

std::string draw_series(const PlotSeries& series, const std::vector<Point>& points, const Axis& x_axis,
                        const Axis& y_axis, const char* color) {
  std::string path;
  std::string marks;
  for (const Point& point : points) {
    const double x = x_axis.place(point.x);
    const double y = y_axis.place(point.y);
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", x, y);
    if (!series.marks) continue;
    marks += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3.5" fill="{}" stroke="{}"/>)"
                         "\n",
                         x, y, series.dashed ? "white" : color, color);
  }
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.8"{}/>)"
                     "\n",
                     path, color, dash_of(series)) +
         marks;
}

/// The line, name and slope of a series. @param row from the top, 0 the first
std::string draw_legend(const PlotSeries& series, bool slopes, std::size_t row, const char* color) {
  const double y = top + 12.0 + 22.0 * static_cast<double>(row);
  const double slope = last_slope(series);
  const std::string note = slopes && std::isfinite(slope) ? fmt::format(", slope {:.2f}", slope) : "";
  return fmt::format(R"(<line x1="{0}" y1="{2:.1f}" x2="{1}" y2="{2:.1f}" stroke="{3}" stroke-width="2"{4}/>)"
                     "\n",
                     right + 16.0, right + 46.0, y, color, dash_of(series)) +
         text_at(right + 54.0, y + 5.0, "start", escape_xml(series.name) + note);
}

}  // namespace

double last_slope(const PlotSeries& series, std::size_t count) {
  std::vector<Point> points = points_of(series, false);
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
    points.push_back(points_of(series, plot.linear));
    for (const Point& point : points.back()) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
  }
  if (!(low.x <= high.x)) low = high = {0.0, 0.0};
  const Axis x_axis(low.x, high.x, {left, right}, plot.linear);
  const Axis y_axis(low.y, high.y, {bottom, top}, plot.linear);
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">
<style>text {{ font: 14px sans-serif; }} .title {{ font: bold 16px sans-serif; }}
.note {{ font-size: 12px; fill: #666; }}
.grid {{ stroke: #ccc; }} .fine {{ stroke: #eee; }} .frame {{ fill: none; stroke: #444; }}</style>
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
    svg += draw_legend(series, plot.slopes, k, stroke);
  }
  if (plot.slopes && !plot.series.empty()) {
    const double y = top + 22.0 * static_cast<double>(plot.series.size()) + 20.0;
    svg += fmt::format(R"(<text class="note" x="{}" y="{}">slopes of the last three points</text>)"
                       "\n",
                       right + 16.0, y);
  }
  return svg + "</svg>\n";
}

}  // namespace ashlar
