// `ashlar picture`: one frame of a run as a PNG, made without a display.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/command_line.hpp"

namespace ashlar {

struct PictureOptions {
  std::filesystem::path folder;       ///< result folder
  std::optional<std::size_t> frame;   ///< index, 0 the first; empty: the last
  std::string size = "1200x800";      ///< pixels, WIDTHxHEIGHT, 16 to 8192 each
  std::string from = "0.55,-1,0.45";  ///< x,y,z: direction from the blocks to the eye; z is up
  std::string color = "displacement";
  std::filesystem::path picture;
};

/// The picture is what `ashlar view` shows, with colours for the range of the whole run.
/// @return exit status; bad_input if an option or the folder is wrong, failed if no browser makes the
/// picture.
[[nodiscard]] int picture_command(const PictureOptions& options, std::ostream& out, std::ostream& err);

void declare_picture_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
