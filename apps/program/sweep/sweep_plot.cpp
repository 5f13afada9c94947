#include "apps/program/sweep/sweep_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "apps/results/text/csv_text.hpp"

namespace ashlar {
namespace {

/// The first numeric key.
std::size_t key_along_x(const std::vector<VariedKey>& keys) {
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (std::all_of(keys[k].values.begin(), keys[k].values.end(),
                    [](const std::string& value) { return csv_number(value).has_value(); }))
      return k;
  throw std::invalid_argument(
      fmt::format("no key for the picture has numbers alone ({} has \"{}\"), one such key is needed",
                  keys.front().key, keys.front().values.front()));
}

/// "friction_angle = 20, order = 2" of the keys but one.
std::string name_of_line(const std::vector<VariedKey>& keys, const std::vector<std::string>& row,
                         std::size_t left_out) {
  std::string name;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k == left_out) continue;
    const std::size_t dot = keys[k].key.find_last_of('.');
    name += fmt::format("{}{} = {}", name.empty() ? "" : ", ",
                        dot == std::string::npos ? keys[k].key : keys[k].key.substr(dot + 1), row[k]);
  }
  return name;
}

}  // namespace

Plot sweep_plot(const std::vector<VariedKey>& keys, const SweepTable& table, const std::string& value) {
  const std::size_t along_x = key_along_x(keys);
  const std::optional<std::size_t> of_value = column_of(table, value);
  if (!of_value)
    throw std::invalid_argument(
        fmt::format("the table has no value of that name for the picture ({})", value));
  std::map<std::string, std::size_t> places;
  Plot plot{value, keys[along_x].key, value, {}, false};
  plot.axes = PlotAxes::linear;
  std::vector<std::vector<std::pair<double, double>>> points;
  for (const std::vector<std::string>& row : table.rows) {
    const auto [place, is_new] = places.emplace(name_of_line(keys, row, along_x), plot.series.size());
    if (is_new) {
      plot.series.push_back({place->first, {}, {}});
      points.emplace_back();
    }
    const std::optional<double> x = csv_number(row[along_x]), y = csv_number(row[*of_value]);
    if (x && y) points[place->second].emplace_back(*x, *y);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::sort(points[k].begin(), points[k].end());
    for (const auto& [x, y] : points[k]) {
      plot.series[k].x.push_back(x);
      plot.series[k].y.push_back(y);
    }
  }
  return plot;
}

}  // namespace ashlar
