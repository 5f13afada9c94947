#include "apps/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

#include "apps/results/system/this_process.hpp"

namespace ashlar {
namespace {

constexpr double kLiveInterval = 0.1;   // s, faster than the eye reads
constexpr double kPlainInterval = 5.0;  // s, a log of an hour has 720 lines

// Auto-wrap is off while the line is written: a line wider than the window is cut instead of scrolling.
constexpr std::string_view kRewriteLine = "\r\x1b[?7l";
constexpr std::string_view kEndOfRewrite = "\x1b[K\x1b[?7h";

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string format_duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::min(std::ceil(seconds), 1e9));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressMode choose_progress_mode(bool quiet) {
  if (quiet) return ProgressMode::silent;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return errors_go_to_a_terminal() && !dumb ? ProgressMode::live : ProgressMode::plain;
}

std::string format_progress(const ProgressState& state, double end_time, std::optional<double> seconds_left) {
  std::string line =
      fmt::format("step {}  t = {:.6g} / {:.6g} s  dt = {:.2g} s  contacts {}  open-close {}", state.step,
                  state.time, end_time, state.time_step, state.contacts, state.open_close_iterations);
  if (seconds_left) line += "  left " + format_duration(*seconds_left);
  return line;
}

ProgressLine::ProgressLine(double end_time, bool quiet, std::ostream& out)
    : ProgressLine(end_time, choose_progress_mode(quiet), out, steady_seconds) {}

ProgressLine::ProgressLine(double end_time, ProgressMode mode, std::ostream& out,
                           std::function<double()> wall_clock)
    : end_time_(end_time),
      mode_(mode),
      out_(out),
      wall_clock_(std::move(wall_clock)),
      start_(wall_clock_()),
      written_at_(start_) {}

ProgressLine::~ProgressLine() {
  try {
    finish();
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost progress line must not end the program
  }
}

void ProgressLine::update(const ProgressState& state) {
  if (mode_ == ProgressMode::silent) return;
  const double now = wall_clock_();
  if (!first_) {
    first_ = state;
    start_ = now;
  }
  last_ = state;
  unwritten_ = true;
  const bool due = mode_ == ProgressMode::live ? !line_open_ || now - written_at_ >= kLiveInterval
                                               : now - written_at_ >= kPlainInterval;
  if (due) write();
}

void ProgressLine::pause() {
  if (line_open_) out_ << '\n' << std::flush;
  line_open_ = false;
}

void ProgressLine::finish() {
  if (mode_ == ProgressMode::silent) return;
  if (unwritten_) write();
  pause();
  mode_ = ProgressMode::silent;
}

void ProgressLine::write() {
  written_at_ = wall_clock_();
  std::optional<double> left;
  const double done = last_.time - first_->time;
  if (done > 0.0) left = (written_at_ - start_) * std::max(0.0, end_time_ - last_.time) / done;
  const std::string line = format_progress(last_, end_time_, left);
  if (mode_ == ProgressMode::live) {
    out_ << kRewriteLine << line << kEndOfRewrite << std::flush;
    line_open_ = true;
  } else {
    out_ << line << '\n' << std::flush;
  }
  unwritten_ = false;
}

}  // namespace ashlar
