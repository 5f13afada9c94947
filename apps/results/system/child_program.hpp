// Programs started by Ashlar: Python, a browser, ffmpeg. They have its limits, one thread for linear algebra and a working
// folder of their own, in which nothing of a stranger lies, and end with it.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ashlar {

[[nodiscard]] bool is_executable(const std::filesystem::path& file);

/// The first executable file of that name in PATH, of whose folders those are left out that are relative: a program beside
/// a scene is not run.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program to its end, without input. It and its child processes are ended if this process ends, even by SIGKILL.
/// @param command its path and its arguments; paths in these are absolute
/// @param out,err files for its output, created again; the folder of `out`, a private one, is its working folder
/// @param limit after which it and all of its child processes are ended
/// @return its exit status, or -1 if a signal ended it; empty if the limit was reached
/// @throws std::runtime_error if it cannot be started
[[nodiscard]] std::optional<int> run_program(const std::vector<std::string>& command,
                                             const std::filesystem::path& out,
                                             const std::filesystem::path& err,
                                             std::chrono::duration<double> limit);

}  // namespace ashlar
