// A sweep as a picture: one value against one key, with a line for each combination of the others.
#pragma once

#include <string>
#include <vector>

#include "apps/sweep/sweep_table.hpp"

namespace ashlar {

/// An SVG document of plot_width by plot_height pixels (log_log_plot.hpp). Runs without the value are left out.
/// @param value a column of the table. Along x is the first key whose values are all numbers
/// @throws std::invalid_argument with what is wrong and needed: there is no such key, or no such column
[[nodiscard]] std::string sweep_svg(const std::vector<VariedKey>& keys, const SweepTable& table,
                                    const std::string& value);

}  // namespace ashlar
