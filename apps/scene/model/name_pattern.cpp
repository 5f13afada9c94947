#include "apps/scene/model/name_pattern.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace ashlar {
namespace {

struct Letter {
  char32_t code = 0;      ///< above all code points: a byte that belongs to none
  std::size_t bytes = 1;  ///< of it in the text
};

constexpr char32_t largest_code = 0x10FFFF;

constexpr bool is_between(char32_t code, char32_t first, char32_t last) {
  return first <= code && code <= last;
}

/// @param at less than the text's size
Letter letter_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
  const char32_t lead = byte(0);
  if (lead < 0x80U) return {lead, 1};
  const Letter alone{largest_code + 1 + lead, 1};
  const std::size_t bytes = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (!is_between(lead, 0xC2, 0xF4) || text.size() - at < bytes) return alone;
  char32_t code = lead & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return alone;
    code = code << 6U | (byte(k) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > largest_code || is_between(code, 0xD800, 0xDFFF)) return alone;
  return {code, bytes};
}

/// POSIX classes of the C locale. An unknown class has no members.
bool is_in_class(std::string_view name, char32_t code) {
  const bool upper = is_between(code, 'A', 'Z'), lower = is_between(code, 'a', 'z');
  const bool digit = is_between(code, '0', '9'), graph = is_between(code, '!', '~');
  const std::array<std::pair<std::string_view, bool>, 12> classes = {{
      {"alpha", upper || lower},
      {"digit", digit},
      {"alnum", upper || lower || digit},
      {"upper", upper},
      {"lower", lower},
      {"space", code == ' ' || is_between(code, '\t', '\r')},
      {"blank", code == ' ' || code == '\t'},
      {"punct", graph && !upper && !lower && !digit},
      {"print", graph || code == ' '},
      {"graph", graph},
      {"cntrl", code < 0x20U || code == 0x7FU},
      {"xdigit", digit || is_between(code, 'A', 'F') || is_between(code, 'a', 'f')},
  }};
  return std::any_of(classes.begin(), classes.end(),
                     [&](const auto& known) { return known.first == name && known.second; });
}

/// Result of a part of a pattern for one letter.
struct Verdict {
  bool matches;
  std::size_t next;  ///< next part of the pattern
};

/// Matches a set of a pattern with one letter.
class LetterSet {
 public:
  /// @param start of the set's [
  LetterSet(std::string_view pattern, std::size_t start, char32_t letter)
      : pattern_(pattern), at_(start + 1), letter_(letter) {}

  /// Empty: the set has no end.
  std::optional<Verdict> read() {
    const bool negated = is_at("!") || is_at("^");
    if (negated) ++at_;
    for (bool first = true; at_ < pattern_.size(); first = false) {
      if (is_at("]") && !first) return Verdict{found_ != negated, at_ + 1};
      if (!read_class() && !read_range()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_at(std::string_view text) const { return pattern_.substr(at_).starts_with(text); }

  bool read_class() {
    if (!is_at("[:")) return false;
    const std::size_t end = pattern_.find(":]", at_ + 2);
    if (end == std::string_view::npos) return false;
    found_ = found_ || is_in_class(pattern_.substr(at_ + 2, end - at_ - 2), letter_);
    at_ = end + 2;
    return true;
  }

  /// One member: a character, escaped or not.
  std::optional<char32_t> read_member() {
    if (is_at("\\")) ++at_;
    if (at_ >= pattern_.size()) return std::nullopt;
    const Letter member = letter_at(pattern_, at_);
    at_ += member.bytes;
    return member.code;
  }

  /// Reads a member, or a range of members.
  bool read_range() {
    const std::optional<char32_t> low = read_member();
    if (!low) return false;
    std::optional<char32_t> high = low;
    if (is_at("-") && !is_at("-]")) {
      ++at_;
      high = read_member();
      if (!high) return false;
    }
    found_ = found_ || is_between(letter_, *low, *high);
    return true;
  }

  std::string_view pattern_;
  std::size_t at_;
  char32_t letter_;
  bool found_ = false;
};

/// True if the part of a pattern at a place, other than *, matches a letter.
Verdict match_letter(std::string_view pattern, std::size_t at, char32_t letter) {
  if (pattern[at] == '[')
    if (const std::optional<Verdict> verdict = LetterSet(pattern, at, letter).read()) return *verdict;
  const bool escaped = pattern[at] == '\\';
  if (escaped && ++at == pattern.size()) return {false, at};
  const Letter wanted = letter_at(pattern, at);
  const bool any = !escaped && wanted.code == '?';
  return {any || wanted.code == letter, at + wanted.bytes};
}

}  // namespace

bool pattern_matches(std::string_view pattern, std::string_view name) {
  std::size_t at = 0, reached = 0;
  // Place after the last *, and the end of its match: a longer match is tried if the rest does not match.
  std::size_t after_star = std::string_view::npos, star_end = 0;
  while (at < pattern.size() || reached < name.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      after_star = ++at;
      star_end = reached;
      continue;
    }
    if (at < pattern.size() && reached < name.size()) {
      const Letter letter = letter_at(name, reached);
      if (const Verdict verdict = match_letter(pattern, at, letter.code); verdict.matches) {
        at = verdict.next;
        reached += letter.bytes;
        continue;
      }
    }
    if (after_star == std::string_view::npos || reached == name.size()) return false;
    star_end += letter_at(name, star_end).bytes;
    reached = star_end;
    at = after_star;
  }
  return true;
}

std::string pattern_of(const std::string& name) {
  std::string pattern;
  for (const char letter : name) {
    if (std::string_view("*?[\\").find(letter) != std::string_view::npos) pattern += '\\';
    pattern += letter;
  }
  return pattern;
}

bool pattern_matches_pair(const std::array<std::string, 2>& patterns, const std::string& a,
                          const std::string& b) {
  return (pattern_matches(patterns[0], a) && pattern_matches(patterns[1], b)) ||
         (pattern_matches(patterns[0], b) && pattern_matches(patterns[1], a));
}

}  // namespace ashlar
