// view.html: the results of a run as one page that any browser shows, without a network or anything
// installed.
//
// The page holds the libraries it needs, the surfaces and fields of the frames as 16-bit numbers, deflated
// (packed_numbers.hpp, view_frames.hpp), the history and the summary. page/data.js reads them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "apps/view/view_frames.hpp"

namespace ashlar {

struct ViewOptions {
  /// Bytes of the page that are not exceeded if it holds more than the first and the last frame: of a longer
  /// run every second, fourth, ... frame is kept. 50 MB open in a second or two and still go by mail.
  std::size_t most_bytes = 50'000'000;
  ViewPoints points = ViewPoints::few;
  std::optional<std::size_t> frame;  ///< index of a frame that is kept whatever the others do
  /// Name or number of the block that displacements are shown relative to, "none": as they are; empty: the base of the
  /// run (`base` of summary.json), if it has one. A name comes before a number, and before "none".
  std::optional<std::string> relative_to;
};

/// What went into the page.
struct ViewReport {
  std::size_t frames = 0;       ///< of the run
  std::size_t frames_kept = 0;  ///< in the page
  std::size_t bytes = 0;
};

/// Reads the result folder and writes the page to `page`. A folder without summary.json (a run that goes on
/// or was killed) is shown with block numbers for names.
/// @throws std::runtime_error with path and reason if the folder has no frames, or a file cannot be read, is
/// not what a run writes or cannot be written; std::out_of_range if there is no frame `options.frame`;
/// std::invalid_argument with the nearest name if there is no block `options.relative_to`.
ViewReport write_view_file(const std::filesystem::path& folder, const std::filesystem::path& page,
                           const ViewOptions& options = {});

}  // namespace ashlar
