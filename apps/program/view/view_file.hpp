// view.html: the results of a run as one page for any browser, without network or installation.
//
// The page holds the libraries it needs, the surfaces and fields of the frames as 16-bit numbers, deflated
// (packed_numbers.hpp, view_frames.hpp), the history and the summary. page/data.js reads them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "apps/program/view/view_frames.hpp"
#include "apps/results/text/atomic_file.hpp"

namespace ashlar {

struct ViewOptions {
  /// Largest size of the page in bytes if it holds more than the first and the last frame: of a longer run every
  /// second, fourth, ... frame is kept. 50 MB open in a second or two and can still be sent by mail.
  std::size_t most_bytes = 50'000'000;
  ViewPoints points = ViewPoints::few;
  std::optional<std::size_t> frame;  ///< index of a frame that is always kept
  /// Name or number of the block relative to which displacements are shown, "none": absolute; empty: the base of the
  /// run (`base` of summary.json), if any. A name has priority over a number, and over "none".
  std::optional<std::string> relative_to;
};

/// Content of the page.
struct ViewReport {
  std::size_t frames = 0;       ///< of the run
  std::size_t frames_kept = 0;  ///< in the page
  std::size_t bytes = 0;
};

/// Pages of this program, which it may replace.
[[nodiscard]] inline FileKind view_page() {
  return {"page of ashlar", {"<title>Ashlar</title>"}};
}

/// Reads the result folder and writes the page to `page`. A folder without summary.json (a run in progress or killed)
/// is shown with block numbers as names.
/// @throws std::runtime_error with path and reason if the folder has no frames, or a file cannot be read, is not from
/// a run or cannot be written; std::out_of_range if there is no frame `options.frame`;
/// std::invalid_argument with the nearest name if there is no block `options.relative_to`, or if `page` is another file.
ViewReport write_view_file(const std::filesystem::path& folder, const std::filesystem::path& page,
                           const ViewOptions& options = {});

}  // namespace ashlar
