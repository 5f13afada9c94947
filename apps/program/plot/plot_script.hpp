// Pictures of plots: a script beside the table that holds the points and draws them by matplotlib, so that a user can
// change the picture; it is run if Python with matplotlib is available.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "apps/program/plot/plot.hpp"

namespace ashlar {

/// The script. Run with names of files (.svg, .png, .pdf) it draws each of them; without, PLOT.svg beside it. Points that
/// PlotSeries does not draw are left out, slopes are part of the names in the legend.
[[nodiscard]] std::string plot_script(const Plot& plot);

/// Text by which such a script is known.
inline constexpr std::string_view plot_script_mark = "Draws a plot by matplotlib";

/// Checks that the script and the pictures of write_plot may be written.
/// @throws std::invalid_argument if a file of such a name is of another kind
void refuse_other_plot(const std::filesystem::path& picture, bool png);

/// Writes the script as FILE.py and runs it for FILE.svg, and for FILE.png unless it is left out. The interpreter is
/// ASHLAR_PYTHON (an environment variable), or the first of python3 in PATH and /usr/bin/python3 that has matplotlib.
/// It is isolated (-I): modules beside the script, in the present folder or in PYTHONPATH are not imported.
/// @param picture FILE with any extension. @return lines to the user: pictures, or the reason why there are none
/// @throws std::runtime_error with path and reason if the script cannot be written, std::invalid_argument as
/// refuse_other_plot
[[nodiscard]] std::string write_plot(const Plot& plot, const std::filesystem::path& picture, bool png);

}  // namespace ashlar
