// Runs work in a process of its own: memory left by other work would hide its requirement.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <optional>
#include <type_traits>

namespace ashlar {

/// Largest memory of this process so far, KiB.
[[nodiscard]] inline double most_memory_kib() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss);
}

/// @param work returns std::optional<Result>. @return its result; empty if it had none, threw or could not be started
template <class Result, class Work>
[[nodiscard]] std::optional<Result> in_own_process(const Work& work) {
  static_assert(std::is_trivially_copyable_v<Result>);
  constexpr auto bytes = static_cast<ssize_t>(sizeof(Result));
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    bool told = false;
    try {
      if (const std::optional<Result> result = work())
        told = write(ends[1], &*result, sizeof(Result)) == bytes;
    } catch (const std::exception&) {
      told = false;
    }
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  Result result;
  const bool read_all = child > 0 && read(ends[0], &result, sizeof(Result)) == bytes;
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  return read_all ? std::optional(result) : std::nullopt;
}

}  // namespace ashlar
