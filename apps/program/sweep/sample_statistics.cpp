#include "apps/program/sweep/sample_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/results/text/csv_text.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

std::vector<double> sorted_numbers(const std::vector<std::optional<double>>& values) {
  std::vector<double> numbers;
  for (const std::optional<double>& value : values)
    if (value) numbers.push_back(*value);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::size_t bins_for(const std::vector<double>& sorted) {
  constexpr double fewest = 5.0, most = 60.0;
  const std::size_t count = sorted.size();
  const double quartiles = sorted[(3 * count) / 4] - sorted[count / 4];
  const double width = 2.0 * quartiles / correctly_rounded::cbrt(static_cast<double>(count));
  const double bins = width > 0.0 ? std::ceil((sorted.back() - sorted.front()) / width) : fewest;
  return static_cast<std::size_t>(std::clamp(bins, fewest, most));
}

/// True for a column of a factor of safety or of loads.
bool is_factor(const std::string& column) {
  return column.starts_with("factor_of_safety.") || column.starts_with("load_factor.");
}

}  // namespace

SampleStatistics statistics_of(const std::vector<std::optional<double>>& values, double limit) {
  SampleStatistics statistics;
  const std::vector<double> numbers = sorted_numbers(values);
  statistics.count = numbers.size();
  statistics.missing = values.size() - numbers.size();
  if (numbers.empty()) return statistics;
  const double count = static_cast<double>(numbers.size());
  statistics.least = numbers.front();
  statistics.most = numbers.back();
  for (const double number : numbers) statistics.mean += number / count;
  double squares = 0.0;
  for (const double number : numbers) squares += (number - statistics.mean) * (number - statistics.mean);
  statistics.deviation = numbers.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  const auto below = std::lower_bound(numbers.begin(), numbers.end(), limit) - numbers.begin();
  statistics.share_below = static_cast<double>(below) / count;
  statistics.share_error = std::sqrt(statistics.share_below * (1.0 - statistics.share_below) / count);
  return statistics;
}

std::vector<SampleGroup> sample_groups(const std::vector<VariedKey>& keys, const SweepTable& table,
                                       const std::string& value, double limit) {
  const std::optional<std::size_t> column = column_of(table, value), status = column_of(table, "status");
  if (!column || !status)
    throw std::invalid_argument(
        fmt::format("the table has no value of that name for its statistics ({})", value));
  std::optional<std::size_t> instead;
  for (const char* factor : {"factor_of_safety", "load_factor"})
    if (value == std::string(factor) + ".lower") instead = column_of(table, std::string(factor) + ".upper");
  std::vector<SampleGroup> groups;
  for (const std::vector<std::string>& row : table.rows) {
    std::string name;
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (!keys[k].drawn) name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", keys[k].key, row[k]);
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& one) { return one.name == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    std::optional<double>& number = group->values.emplace_back(csv_number(row[*column]));
    if (number || !instead || row[*status] != "completed") continue;
    const std::optional<double> upper = csv_number(row[*instead]);
    if (upper && *upper <= limit) number = upper;
  }
  return groups;
}

std::string to_string(const SampleStatistics& statistics, const std::string& value, double limit) {
  if (statistics.count == 0) return fmt::format("{}: no sample has a value", value);
  std::string text =
      fmt::format("{}: {} samples, mean {:.4g}, deviation {:.3g}, from {:.4g} to {:.4g}", value,
                  statistics.count, statistics.mean, statistics.deviation, statistics.least, statistics.most);
  if (is_factor(value))
    text += fmt::format("; {:.3g} % below {} (standard error {:.2g} %)", 100.0 * statistics.share_below,
                        limit, 100.0 * statistics.share_error);
  if (statistics.missing > 0) text += fmt::format("; {} without a value are not counted", statistics.missing);
  return text;
}

Plot histogram_of(const std::vector<SampleGroup>& groups, const std::string& value) {
  std::vector<std::optional<double>> all;
  for (const SampleGroup& group : groups) all.insert(all.end(), group.values.begin(), group.values.end());
  const std::vector<double> sorted = sorted_numbers(all);
  Plot plot{value, value, "samples", {}, false};
  plot.axes = PlotAxes::linear;
  if (sorted.empty()) return plot;
  const std::size_t bins = bins_for(sorted);
  const double width = (sorted.back() - sorted.front()) / static_cast<double>(bins);
  for (const SampleGroup& group : groups) {
    std::vector<double> counts(bins, 0.0);
    const std::vector<double> numbers = sorted_numbers(group.values);
    for (const double number : numbers) {
      const double place = width > 0.0 ? (number - sorted.front()) / width : 0.0;
      counts[std::min(static_cast<std::size_t>(place), bins - 1)] += 1.0;
    }
    PlotSeries outline{
        fmt::format("{}{}{} samples", group.name, group.name.empty() ? "" : ": ", numbers.size()), {}, {}};
    outline.marks = false;
    const auto corner = [&](std::size_t edge, double count) {
      outline.x.push_back(sorted.front() + static_cast<double>(edge) * width);
      outline.y.push_back(count);
    };
    corner(0, 0.0);
    for (std::size_t k = 0; k < bins; ++k) {
      corner(k, counts[k]);
      corner(k + 1, counts[k]);
    }
    corner(bins, 0.0);
    plot.series.push_back(std::move(outline));
  }
  return plot;
}

}  // namespace ashlar
