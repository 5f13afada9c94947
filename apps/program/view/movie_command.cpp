#include "apps/program/view/movie_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "apps/program/number_option.hpp"
#include "apps/results/folder/scratch_folder.hpp"
#include "apps/results/system/child_program.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

/// Options of ffmpeg for a kind of film; empty: unknown.
std::vector<std::string> codec_of(const std::string& suffix) {
  // Films with subsampled colours need even sides.
  const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
  if (suffix == ".mp4")
    return {"-vf", even, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"};
  if (suffix == ".webp") return {"-c:v", "libwebp", "-quality", "85", "-loop", "0"};
  if (suffix == ".gif") return {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"};
  return {};
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t shown = 1000;
  return text.substr(text.size() - std::min(text.size(), shown));
}

void make_movie(const MovieOptions& options, const std::filesystem::path& ffmpeg,
                const std::vector<std::string>& codec, const std::string& suffix, std::ostream& out) {
  const FileKind film = {"film", {"ftyp", "WEBP", "GIF8"}};
  refuse_other_file(options.movie, film);
  const std::vector<DrawnFrame> frames = draw_frames(options.look, options.frames);
  const ScratchFolder scratch;
  for (std::size_t k = 0; k < frames.size(); ++k)
    write_file_atomically(scratch.path() / fmt::format("frame_{:06}.png", k), frames[k].png,
                          Durability::process);
  const std::filesystem::path made = scratch.path() / ("movie" + suffix);
  std::vector<std::string> command = {ffmpeg.string(),
                                      "-nostdin",
                                      "-y",
                                      "-framerate",
                                      fmt::format("{}", options.rate),
                                      "-i",
                                      (scratch.path() / "frame_%06d.png").string()};
  command.insert(command.end(), codec.begin(), codec.end());
  command.push_back(made.string());
  const std::filesystem::path errors = scratch.path() / "errors";
  const auto status = run_program(command, scratch.path() / "output", errors,
                                  std::chrono::duration<double>(options.look.time_limit));
  if (!status)
    throw std::runtime_error(
        fmt::format("{} did not finish within {} s and was ended", ffmpeg.string(), options.look.time_limit));
  if (*status != 0)
    throw std::runtime_error(fmt::format("{} failed: {}", ffmpeg.string(), last_lines(whole_file(errors))));
  write_file_of_kind(options.movie, whole_file(made), film);
  out << fmt::format("movie: {} ({} frames, {:.3g} s)\n", options.movie.string(), frames.size(),
                     static_cast<double>(frames.size()) / options.rate);
}

}  // namespace

int movie_command(const MovieOptions& options, std::ostream& out, std::ostream& err) {
  const auto refuse = [&](const std::string& what, int status) {
    err << "ashlar: error: " << what << '\n';
    return status;
  };
  if (const std::string fault = fault_of_look(options.look); !fault.empty())
    return refuse(fault, exit_status::bad_input);
  if (!(options.rate > 0.0) || !std::isfinite(options.rate))
    return refuse(fmt::format("rate is not positive ({}); give more than 0", options.rate),
                  exit_status::bad_input);
  const std::string suffix = CLI::detail::to_lower(options.movie.extension().string());
  const std::vector<std::string> codec = codec_of(suffix);
  if (codec.empty())
    return refuse(
        fmt::format("unsupported format of a movie ({}); use .mp4, .webp or .gif", options.movie.string()),
        exit_status::bad_input);
  const auto ffmpeg = find_program("ffmpeg");
  if (!ffmpeg)
    return refuse(
        "no ffmpeg in PATH, which puts the frames together; install it (Debian: apt-get install ffmpeg)",
        exit_status::failed);
  try {
    make_movie(options, *ffmpeg, codec, suffix, out);
  } catch (const std::invalid_argument& error) {
    return refuse(error.what(), exit_status::bad_input);
  } catch (const std::runtime_error& error) {
    return refuse(fault_text(error), exit_status::failed);
  }
  return exit_status::done;
}

void declare_movie_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("movie", "The frames of a run as a film (needs Chromium and ffmpeg)");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<MovieOptions>();
  options->look.time_limit = 600.0;
  command->add_option("DIR", options->look.folder, "Result folder of a run")->required()->type_name("");
  command->add_option("--frames", options->frames, "Frames A to B (default: all)")->type_name("A:B");
  command->add_option("--rate", options->rate, "Frames in a second (default: 25)")
      ->type_name("F")
      ->transform(real_number_option({}));
  declare_look(*command, options->look);
  command->add_option("-o,--out", options->movie, "Film to write: .mp4, .webp or .gif")
      ->required()
      ->type_name("FILE");
  command->callback(
      [options, &context] { context.status = movie_command(*options, context.out, context.err); });
}

}  // namespace ashlar
