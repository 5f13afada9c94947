// Corrections of records (of an earthquake) before they are histories: baseline, interval of the rows.
#pragma once

#include <vector>

namespace ashlar {

/// Largest order of a baseline.
inline constexpr int largest_baseline_order = 3;
/// Most rows of a resampled record.
inline constexpr double most_resampled_rows = 2e6;

/// Subtracts from each column of values the polynomial in time of least squares over the rows: order 0 removes the
/// mean, 1 a line too. The polynomial is computed in time scaled to -1 ... 1 (Householder QR), so that its normal
/// equations are not needed. At least order + 1 rows are needed; exactly so many leave zero.
/// @param rows [time, values...], times increase. @param order 0 to largest_baseline_order
void remove_baseline(std::vector<std::vector<double>>& rows, int order);

/// Rows at equal intervals from the first time on, linear between those given, and the last row at the end of the
/// record, which may come sooner than an interval after the one before. An interval longer than that of the record
/// loses its frequencies above 1 / (2 interval), without a filter.
/// @param interval s, > 0, so that there are at most most_resampled_rows
[[nodiscard]] std::vector<std::vector<double>> resampled(const std::vector<std::vector<double>>& rows,
                                                         double interval);

}  // namespace ashlar
