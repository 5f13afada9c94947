// SVG documents as PNG pictures, drawn by a browser (headless_browser.hpp).
#pragma once

#include <filesystem>
#include <string>

namespace ashlar {

/// @param svg a document of that many pixels without external references
/// @return the bytes of a PNG of the same size.
/// @throws std::runtime_error as loaded_page, or if the browser returns no picture
[[nodiscard]] std::string png_of_svg(const std::filesystem::path& browser, const std::string& svg, int width,
                                     int height);

/// Writes that PNG beside an SVG; without a working browser only the SVG is available.
/// @return message to the user
[[nodiscard]] std::string write_png(const std::string& svg, const std::filesystem::path& picture, int width,
                                    int height);

}  // namespace ashlar
