#include "apps/program/blocks/block_histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

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
  int number = 3 * static_cast<int>(std::floor(correctly_rounded::log10(volume))) - 1;
  while (bound(number + 1) <= volume) ++number;
  return number;
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

Plot size_plot(const std::string& title, std::vector<double> volumes) {
  std::sort(volumes.begin(), volumes.end());
  const double all = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  PlotSeries of_volume{"of the volume", {}, {}, false, false},
      of_number{"of the blocks", {}, {}, true, false};
  double sum = 0.0;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    for (PlotSeries* series : {&of_volume, &of_number}) series->x.insert(series->x.end(), 2, volumes[k]);
    const double before = sum;
    sum += volumes[k];
    const auto count = static_cast<double>(volumes.size()), number = static_cast<double>(k);
    of_volume.y.insert(of_volume.y.end(), {100.0 * before / all, 100.0 * sum / all});
    of_number.y.insert(of_number.y.end(), {100.0 * number / count, 100.0 * (number + 1.0) / count});
  }
  Plot plot{title, "volume of a block, m\u00b3", "share in blocks up to this volume, %", {}, false};
  plot.axes = PlotAxes::logarithmic_x;
  plot.series = {std::move(of_volume), std::move(of_number)};
  return plot;
}

}  // namespace ashlar
