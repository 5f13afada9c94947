#include "geometry/mesh/text_scanner.hpp"

#include <algorithm>
#include <charconv>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// std::from_chars does not accept a plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return to_lower(x) == to_lower(y); });
}

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > longest ? result + "..." : result;
}

bool TextScanner::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_number_;
    left_ = comment_ != '\0' ? line_.substr(0, line_.find(comment_)) : line_;
    word_ = {};
    column_ = 1;
    if (!std::all_of(left_.begin(), left_.end(), is_blank)) return true;
  }
  left_ = {};
  return false;
}

void TextScanner::require_line(std::string_view what) {
  if (!next_line()) throw MeshFileError("file ends before " + std::string(what), line_number_, 0);
}

std::string_view TextScanner::word() {
  const auto* const begin = std::find_if_not(left_.begin(), left_.end(), is_blank);
  left_.remove_prefix(static_cast<std::size_t>(begin - left_.begin()));
  column_ = static_cast<int>(left_.data() - line_.data()) + 1;
  const auto* const end = std::find_if(left_.begin(), left_.end(), is_blank);
  word_ = left_.substr(0, static_cast<std::size_t>(end - left_.begin()));
  left_.remove_prefix(word_.size());
  return word_;
}

std::string_view TextScanner::require_word(std::string_view what) {
  if (word().empty()) throw MeshFileError("line ends before " + std::string(what), line_number_, column_);
  return word_;
}

void TextScanner::expect(std::initializer_list<std::string_view> words) {
  for (const std::string_view expected : words) {
    if (!equal_ignoring_case(require_word(expected), expected)) {
      fail("unexpected word", std::string(expected).append(" must be here"));
    }
  }
}

void TextScanner::expect_end_of_line() {
  if (!word().empty()) fail("unexpected word", "the line must end here");
}

double TextScanner::number(std::string_view what) {
  const std::string_view digits = without_plus(require_word(what));
  double value = 0.0;
  const auto [end, error] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) fail(what, "must be in the range of double precision");
  if (error != std::errc() || end != digits.data() + digits.size()) fail(what, "must be a number");
  return value;
}

double TextScanner::coordinate(std::string_view what) {
  const double value = number(what);
  if (is_too_far(value)) fail(what, "allowed -1e150 to 1e150");
  return value;
}

long long TextScanner::integer(std::string_view what, long long low, long long high) {
  return to_integer(require_word(what), what, low, high);
}

long long TextScanner::to_integer(std::string_view part, std::string_view what, long long low,
                                  long long high) const {
  const std::string_view digits = without_plus(part);
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (!whole || (error != std::errc() && error != std::errc::result_out_of_range)) {
    fail(what, "must be an integer");
  }
  if (error != std::errc() || value < low || value > high) {
    fail(what, "allowed " + std::to_string(low) + " to " + std::to_string(high));
  }
  return value;
}

void TextScanner::fail(std::string_view what, std::string_view allowed) const {
  throw MeshFileError(std::string(what) + " (" + printable(word_) + "), " + std::string(allowed),
                      line_number_, column_);
}

}  // namespace ashlar
