// Runs a page in a browser without a window. apps/notes/pictures.md explains the choice of this method.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ashlar {

/// A Chromium: that of the environment variable ASHLAR_BROWSER, else the first of chromium, chromium-browser
/// and google-chrome in PATH; empty if there is none.
[[nodiscard]] std::optional<std::filesystem::path> find_browser();

/// Opens the page with software rendering and waits for it to load.
/// @param folder an empty one for the browser's own files
/// @param fragment what follows # in the address; letters, digits and  = & , . - _  only
/// @return the page after its scripts, as HTML.
/// @param limit after which the browser and all processes it started are ended
/// @throws std::runtime_error if the browser cannot be started, does not finish within the limit, or fails, with the
/// last lines of its output.
[[nodiscard]] std::string loaded_page(const std::filesystem::path& browser,
                                      const std::filesystem::path& folder, const std::filesystem::path& page,
                                      const std::string& fragment, std::chrono::duration<double> limit);

/// Result of a page's scripts for the program: the text of its element  pre  with that id, which contains only text.
/// @return empty if there is no such element
[[nodiscard]] std::optional<std::string> left_text(const std::string& page, std::string_view id);

}  // namespace ashlar
