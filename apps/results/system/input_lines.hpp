// Lines of standard input, read without waiting longer than the caller allows: for a program that also looks after others.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace ashlar {

struct InputLine {
  std::string text;       ///< without its line break
  bool too_long = false;  ///< `text` is empty: the line was skipped
};

class InputLines {
 public:
  /// @param longest of a line, bytes; longer ones are skipped and reported. Memory never exceeds it by more than one read
  explicit InputLines(std::size_t longest) : longest_(longest) {}

  /// Waits for input, and reads at most one part of it. Returns early for a signal.
  void wait(std::chrono::milliseconds most);
  /// The next complete line; at the end of the input also one without a line break. Empty: there is none at present.
  [[nodiscard]] std::optional<InputLine> next();
  /// True if the input has ended, or fails, and all of its lines were taken.
  [[nodiscard]] bool ended() const { return closed_ && text_.empty() && !skips_; }

 private:
  std::size_t longest_;
  std::string text_;
  std::size_t searched_ = 0;  ///< bytes of text_ without a line break
  bool skips_ = false;        ///< inside a line that is too long
  bool closed_ = false;
};

}  // namespace ashlar
