// The parts of a view file that are the same for every run, embedded in the program.
#pragma once

#include <string_view>

namespace ashlar {

/// Texts of files, found by CMake and embedded when the program is built: view_*.{html,css,js} of this
/// folder, three.js with its orbit controls (Debian's libjs-three) and Chart.js (libjs-chart.js).
struct ViewAssets {
  std::string_view page;   ///< view_page.html, with a line @NAME@ where a part goes
  std::string_view style;  ///< view_page.css
  // The script, in its order.
  std::string_view script_data;    ///< view_data.js
  std::string_view script_scene;   ///< view_scene.js
  std::string_view script_panels;  ///< view_panels.js
  std::string_view script_page;    ///< view_page.js
  std::string_view three;
  std::string_view orbit_controls;
  std::string_view chart;
};

[[nodiscard]] ViewAssets view_assets();

}  // namespace ashlar
