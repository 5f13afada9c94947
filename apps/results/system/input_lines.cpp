#include "apps/results/system/input_lines.hpp"

#include <utility>

namespace ashlar {

std::optional<InputLine> InputLines::next() {
  const std::size_t end = text_.find('\n', searched_);
  const bool complete = end != std::string::npos;
  if (!complete && !closed_) {
    searched_ = text_.size();
    if (searched_ > longest_) {
      skips_ = true;
      text_.clear();
      searched_ = 0;
    }
    return std::nullopt;
  }
  if (!complete && text_.empty() && !skips_) return std::nullopt;
  InputLine line{text_.substr(0, end), skips_};
  text_.erase(0, complete ? end + 1 : end);
  searched_ = 0;
  skips_ = false;
  if (line.too_long || line.text.size() > longest_) line = {"", true};
  return line;
}

}  // namespace ashlar
