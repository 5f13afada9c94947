// `ashlar movie`: the frames of a run as a film, made without a display.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/program/view/picture_command.hpp"

namespace ashlar {

struct MovieOptions {
  PictureOptions look;                ///< its folder is that of the run; frame, frames and picture are unused
  std::optional<std::string> frames;  ///< "a:b", indices; empty: all
  double rate = 25.0;                 ///< frames in a second, > 0
  std::filesystem::path movie;        ///< .mp4, .webp or .gif
};

/// Pictures as by `ashlar picture`, combined by ffmpeg.
/// @return exit status; bad_input if an option or the folder is wrong, failed without a browser or ffmpeg
[[nodiscard]] int movie_command(const MovieOptions& options, std::ostream& out, std::ostream& err);

void declare_movie_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
