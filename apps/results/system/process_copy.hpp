// Parts of the program in processes of their own: copies of this one (fork), which begin with all of its data. Windows has
// no copies: there they are threads, which cannot be ended from outside and have the standard streams of the process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace ashlar {

/// Files in place of the standard streams of a copy, created again. It has no input.
struct CopyStreams {
  std::filesystem::path out, err;
};

/// False on Windows, where a function runs in a thread of this process instead.
[[nodiscard]] bool copies_have_streams();

/// Fate of a copy when this process has ended.
enum class CopyEnd {
  asked,    ///< SIGTERM, which a run takes as a request to save its state
  at_once,  ///< SIGKILL
};

class ProcessCopy {
 public:
  /// Starts a copy that calls the function and ends with its result as exit status, 0 to 255, without destructors of
  /// this process. Signals of the terminal do not reach it. @param streams empty: those of this process
  /// @throws std::system_error if the system has no room for it. A copy that cannot open its streams has exit status 1
  explicit ProcessCopy(const std::function<int()>& run, const std::optional<CopyStreams>& streams = {},
                       CopyEnd end = CopyEnd::asked);

  /// Empty while it runs; afterwards, once, its exit status, or -1 if it was ended by a signal.
  [[nodiscard]] std::optional<int> ended() const;
  /// Asks it to end (SIGTERM).
  void ask_to_end() const;
  /// Ends it (SIGKILL).
  void end_at_once() const;

 private:
  std::int64_t process_ = -1;
};

/// Calls a function in a copy of this process and waits for its end. Memory that it takes is not this one's.
/// It ends when this process does.
/// @return what it returns; empty also if the copy cannot be made or does not end well
[[nodiscard]] std::optional<std::string> told_by_copy(
    const std::function<std::optional<std::string>()>& tell);

}  // namespace ashlar
