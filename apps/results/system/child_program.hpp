// Programs started by Ashlar: a browser, ffmpeg.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ashlar {

[[nodiscard]] bool is_executable(const std::filesystem::path& file);

/// The first executable file of that name in PATH.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program to its end, without input. @param command its path and its arguments
/// @param out,err files for its output, created again
/// @param limit after which it and all of its child processes are ended
/// @return its exit status, or -1 if a signal ended it; empty if the limit was reached
/// @throws std::runtime_error if it cannot be started
[[nodiscard]] std::optional<int> run_program(const std::vector<std::string>& command,
                                             const std::filesystem::path& out,
                                             const std::filesystem::path& err,
                                             std::chrono::duration<double> limit);

}  // namespace ashlar
