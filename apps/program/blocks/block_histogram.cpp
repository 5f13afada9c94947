#include "apps/program/blocks/block_histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/results/text/xml_text.hpp"

namespace ashlar {
namespace {

constexpr double left = 70.0, right = histogram_width - 70.0;
constexpr double top = 50.0, bottom = histogram_height - 70.0;

constexpr int most_fine_classes = 18;

/// Number of a bound: 3 for each power of ten.
double bound(int number) {
  constexpr std::array<double, 3> mantissas = {1.0, 2.0, 5.0};
  const int exponent = static_cast<int>(std::floor(number / 3.0));
  // Read from text, as a product with a power of ten is rounded.
  return std::stod(
      fmt::format("{}e{}", mantissas[static_cast<std::size_t>(number - 3 * exponent)], exponent));
}

int class_of(double volume) {
  int number = 3 * static_cast<int>(std::floor(std::log10(volume))) - 1;
  while (bound(number + 1) <= volume) ++number;
  return number;
}

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)"
                     "\n",
                     x, y, anchor, words);
}

/// Bars, the bounds of their classes below them and their numbers above.
std::string draw_bars(const std::vector<SizeClass>& classes) {
  const double width = (right - left) / static_cast<double>(classes.size());
  int most = 1;
  for (const SizeClass& of : classes) most = std::max(most, of.blocks);
  std::string svg;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const double x = left + static_cast<double>(k) * width;
    const double height = (bottom - top) * classes[k].blocks / most;
    svg += fmt::format(
        R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="#56b4e9" stroke="#0072b2"/>)"
        "\n",
        x, bottom - height, width, height);
    if (classes[k].blocks > 0)
      svg += text(x + 0.5 * width, bottom - height - 5.0, "middle", fmt::format("{}", classes[k].blocks));
    svg += text(x, bottom + 18.0, "middle", fmt::format("{:g}", classes[k].from));
  }
  return svg + text(right, bottom + 18.0, "middle", fmt::format("{:g}", classes.back().to));
}

/// The share of volume in blocks smaller than each bound, on the right axis.
std::string draw_share(const std::vector<SizeClass>& classes) {
  const double width = (right - left) / static_cast<double>(classes.size());
  double all = 0.0, sum = 0.0;
  for (const SizeClass& of : classes) all += of.volume;
  std::string points = fmt::format("{:.1f},{:.1f}", left, bottom);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    sum += classes[k].volume;
    points += fmt::format(" {:.1f},{:.1f}", left + static_cast<double>(k + 1) * width,
                          bottom - (bottom - top) * sum / all);
  }
  std::string svg = fmt::format(R"(<polyline points="{}" fill="none" stroke="#d55e00" stroke-width="2"/>)"
                                "\n",
                                points);
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    svg +=
        text(right + 8.0, bottom - (bottom - top) * share + 4.0, "start", fmt::format("{:g} %", 100 * share));
  return svg;
}

}  // namespace

std::vector<SizeClass> size_classes(const std::vector<double>& volumes) {
  if (volumes.empty()) return {};
  const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
  const int first = class_of(*least), last = class_of(*most);
  // Whole powers of ten if finer classes would be too many.
  const int step = last - first < most_fine_classes ? 1 : 3;
  const int start = step == 1 ? first : 3 * static_cast<int>(std::floor(first / 3.0));
  std::vector<SizeClass> classes;
  for (int k = start; k <= last; k += step) classes.push_back({bound(k), bound(k + step)});
  for (const double volume : volumes) {
    SizeClass& of = classes[static_cast<std::size_t>((class_of(volume) - start) / step)];
    ++of.blocks;
    of.volume += volume;
  }
  return classes;
}

std::string histogram_svg(const std::string& title, const std::vector<SizeClass>& classes) {
  std::string svg =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
                  R"(font-family="sans-serif" font-size="13">)"
                  "\n"
                  R"(<rect width="{0}" height="{1}" fill="#ffffff"/>)"
                  "\n",
                  histogram_width, histogram_height);
  svg += text(0.5 * (left + right), 28.0, "middle", escape_xml(title));
  if (!classes.empty()) svg += draw_bars(classes) + draw_share(classes);
  svg += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="#000000"/>)"
                     "\n",
                     left, bottom, right, bottom);
  svg += text(0.5 * (left + right), bottom + 45.0, "middle",
              "volume of a block, m\u00b3 (bars: blocks; line: share of volume in blocks up to it)");
  return svg + "</svg>\n";
}

}  // namespace ashlar
