#include "apps/scene/import/poly_statement.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

bool separates(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '(' || c == ')' || c == ',' ||
         c == '=';
}

std::optional<double> command_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = parse_number(word.data(), word.data() + word.size(), value);
  // Not words like `inf`, which no command has.
  const bool begins_as_number = word.find_first_of("0123456789") <= 2;
  if (error != std::errc() || end != word.data() + word.size() || !begins_as_number) return std::nullopt;
  return value;
}

/// Words of a line without comment. @return true if the command goes on in the next one
bool split(std::string_view line, int number, std::vector<PolyWord>& words) {
  std::string_view text = line.substr(0, line.find(';'));
  const std::size_t last = text.find_last_not_of(" \t\r\v\f");
  const bool may_continue = last != std::string_view::npos && text[last] == '&';
  if (may_continue) text = text.substr(0, last);
  for (std::size_t begin = 0; begin < text.size();) {
    if (separates(text[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < text.size() && !separates(text[end])) ++end;
    words.push_back({text.substr(begin, end - begin), number, static_cast<int>(begin) + 1});
    begin = end;
  }
  return may_continue;
}

}  // namespace

bool is_poly_word(std::string_view word, std::string_view name, std::size_t least) {
  return word.size() >= least && word.size() <= name.size() &&
         equal_ignoring_case(word, name.substr(0, word.size()));
}

std::vector<PolyStatement> poly_statements(std::string_view text) {
  std::vector<PolyStatement> statements;
  std::vector<PolyWord> words;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const bool may_continue = split(text.substr(0, end), ++number, words);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (may_continue && !text.empty()) continue;
    if (!words.empty()) statements.emplace_back(std::exchange(words, {}));
  }
  return statements;
}

const PolyWord& PolyStatement::take() {
  if (done()) fail("command ends early, a word is needed");
  return words_[next_++];
}

bool PolyStatement::take_if(std::string_view name, std::size_t least) {
  if (done() || !is_poly_word(front().text, name, least)) return false;
  ++next_;
  return true;
}

bool PolyStatement::at_number() const {
  return !done() && command_number(front().text).has_value();
}

double PolyStatement::number(const char* what) {
  const std::optional<double> value = done() ? std::nullopt : command_number(front().text);
  if (!value) fail(fmt::format("{} ({}), must be a number", what, done() ? "" : printable(front().text)));
  if (is_too_far(*value))
    fail(fmt::format("{} ({}), allowed -1e150 to 1e150", what, printable(front().text)));
  ++next_;
  return *value;
}

int PolyStatement::whole_number(const char* what) {
  const double value = number(what);
  if (!(value >= 0.0 && value <= std::numeric_limits<int>::max()) || value != static_cast<int>(value)) {
    --next_;
    fail(fmt::format("{} ({}), must be a whole number", what, printable(front().text)));
  }
  return static_cast<int>(value);
}

std::vector<double> PolyStatement::numbers() {
  std::vector<double> values;
  while (at_number()) values.push_back(number("coordinate"));
  return values;
}

void PolyStatement::fail(const std::string& what) const {
  const PolyWord& place = words_[done() ? words_.size() - 1 : next_];
  throw MeshFileError(what, place.line, place.column);
}

}  // namespace ashlar
