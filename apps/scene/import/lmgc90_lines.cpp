#include "apps/scene/import/lmgc90_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

constexpr std::string_view blank_letters = " \t\r\v\f";

/// The first word of a text, and the text behind it.
std::pair<std::string_view, std::string_view> first_word(std::string_view text, std::string_view ends) {
  const std::size_t begin = std::min(text.find_first_not_of(blank_letters), text.size());
  const std::size_t end = std::min(text.find_first_of(ends, begin), text.size());
  return {text.substr(begin, end - begin), text.substr(end)};
}

}  // namespace

bool Lmgc90Lines::next() {
  if (std::exchange(kept_, false)) return true;
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    words_.clear();
    pairs_.clear();
    std::string_view left = line_;
    for (;;) {
      const auto [word, behind] = first_word(left, " \t\r\v\f=");
      if (word.empty() && behind.empty()) break;
      const std::size_t sign = behind.find_first_not_of(blank_letters);
      if (sign != std::string_view::npos && behind[sign] == '=') {
        const auto [value, after] = first_word(behind.substr(sign + 1), blank_letters);
        pairs_.emplace_back(word, value);
        left = after;
      } else {
        words_.push_back(word);
        left = behind;
      }
    }
    const std::string_view first = words_.empty() ? std::string_view() : words_.front();
    if (first.starts_with('!') || first.starts_with('#') || (words_.empty() && pairs_.empty())) continue;
    return true;
  }
  return false;
}

void Lmgc90Lines::require_next(const char* what) {
  if (!next()) throw ImportError({file_, number_, 1}, fmt::format("file ends before {}", what));
}

bool Lmgc90Lines::has(std::string_view name) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return pair.first == name; });
}

std::string_view Lmgc90Lines::text(std::string_view name) const {
  for (const auto& [key, value] : pairs_)
    if (key == name && !value.empty()) return value;
  fail(line_, fmt::format("line has no value {}=, which is needed", name));
}

double Lmgc90Lines::number(std::string_view name) const {
  return number_in(text(name), name);
}

int Lmgc90Lines::whole_number(std::string_view name) const {
  return whole_number_in(text(name), name);
}

double Lmgc90Lines::number_of_word(std::size_t index) const {
  if (index >= words_.size())
    fail(line_, fmt::format("line has {} words, {} are needed", words_.size(), index + 1));
  return number_in(words_[index], "number");
}

int Lmgc90Lines::whole_number_of_word(std::size_t index) const {
  if (index >= words_.size())
    fail(line_, fmt::format("line has {} words, {} are needed", words_.size(), index + 1));
  return whole_number_in(words_[index], "number");
}

double Lmgc90Lines::number_in(std::string_view text, std::string_view what) const {
  std::string digits(text);
  for (char& c : digits)
    if (c == 'D' || c == 'd') c = 'e';
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.erase(0, 1);
  double value = 0.0;
  const auto [end, error] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(text, fmt::format("{} ({}), must be a number", what, printable(text)));
  if (!std::isfinite(value) || is_too_far(value))
    fail(text, fmt::format("{} ({}), allowed -1e150 to 1e150", what, printable(text)));
  return value;
}

int Lmgc90Lines::whole_number_in(std::string_view text, std::string_view what) const {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0)
    fail(text, fmt::format("{} ({}), must be a whole number from 0 to {}", what, printable(text),
                           std::numeric_limits<int>::max()));
  return value;
}

void Lmgc90Lines::fail(std::string_view at, const std::string& what) const {
  throw ImportError({file_, number_, static_cast<int>(at.data() - line_.data()) + 1}, what);
}

}  // namespace ashlar
