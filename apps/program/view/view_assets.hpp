// The parts of a view file that are the same for every run, embedded in the program.
#pragma once

#include <array>
#include <string_view>

namespace ashlar {

/// Texts of files, found by CMake and embedded when the program is built: those of the folder page/, and the
/// libraries of Debian's libjs-three and libjs-chart.js.
struct ViewAssets {
  std::string_view page;    ///< page.html, with a line @NAME@ in place of each part
  std::string_view style;   ///< page.css
  std::string_view script;  ///< all of page/*.js, one after the other
  std::array<std::string_view, 6>
      libraries;  ///< in the order in which they run: three.js and its parts, Chart.js
};

[[nodiscard]] ViewAssets view_assets();

}  // namespace ashlar
