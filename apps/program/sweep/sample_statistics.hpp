// Statistics of a value over the random samples of a sweep.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/program/plot/plot.hpp"
#include "apps/program/sweep/sweep_table.hpp"

namespace ashlar {

struct SampleStatistics {
  std::size_t count = 0;                                        ///< samples with a value
  std::size_t missing = 0;                                      ///< samples without
  double mean = 0.0, deviation = 0.0, least = 0.0, most = 0.0;  ///< deviation: standard deviation of the
                                                                ///< sample, over count - 1
  double share_below = 0.0;                                     ///< share of samples below a limit
  double share_error = 0.0;                                     ///< standard error of that share
};

/// @param limit of share_below
[[nodiscard]] SampleStatistics statistics_of(const std::vector<std::optional<double>>& values, double limit);

/// Samples of one combination of the listed keys.
struct SampleGroup {
  std::string name;                           ///< "key = value, ..."; empty: no key is listed
  std::vector<std::optional<double>> values;  ///< by sample
};

/// The values of a column. "factor_of_safety.lower" and "load_factor.lower" are empty if even the least factor of the
/// search moves: they are replaced by `upper` if that does not exceed the limit, as the factor is below both.
/// @throws std::invalid_argument if the table has no such column
[[nodiscard]] std::vector<SampleGroup> sample_groups(const std::vector<VariedKey>& keys,
                                                     const SweepTable& table, const std::string& value,
                                                     double limit);

/// "factor_of_safety.lower: 1000 samples, mean 1.21, deviation 0.1, from 0.9 to 1.5; 3.4 % below 1 (standard error
/// 0.6 %)". The share below the limit is that of a factor, which has failed there; of other values it means nothing.
[[nodiscard]] std::string to_string(const SampleStatistics& statistics, const std::string& value,
                                    double limit);

/// Histograms, a line for each group. The width of bins is by the rule of Freedman and Diaconis
/// for all samples, with 5 to 60 of them.
[[nodiscard]] Plot histogram_of(const std::vector<SampleGroup>& groups, const std::string& value);

}  // namespace ashlar
