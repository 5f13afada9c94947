// Words and numbers of a text file, line by line, with the place of each for error messages. Reading is
// strict: a number is a whole word, correctly rounded whatever the locale.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

class TextScanner {
 public:
  /// @param comment character that starts a comment up to the end of the line, 0 for none.
  /// The text must outlive the scanner.
  TextScanner(std::string_view text, char comment) : rest_(text), comment_(comment) {}

  /// Goes to the next line with a word in it. @return false at the end of the text.
  bool next_line();
  /// The same; at the end @throws MeshFileError "file ends before <what>".
  void require_line(std::string_view what);

  /// The next word of the line, empty at its end.
  std::string_view word();
  /// The next word of the line, which must be there.
  std::string_view require_word(std::string_view what);
  /// Reads one of the words, in any case, or fails.
  void expect(std::initializer_list<std::string_view> words);
  /// Refuses further words on the line.
  void expect_end_of_line();

  /// A decimal number, "inf" and "nan" included; overflow and underflow to zero are refused.
  double number(std::string_view what);
  /// A number that is no coordinate beyond largest_coordinate.
  double coordinate(std::string_view what);
  /// A decimal integer from low to high.
  long long integer(std::string_view what, long long low, long long high);
  /// The same from a given part of the last word.
  [[nodiscard]] long long to_integer(std::string_view part, std::string_view what, long long low,
                                     long long high) const;

  /// Text after the current line.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] int line() const { return line_number_; }
  /// Column of the last word.
  [[nodiscard]] int column() const { return column_; }

  /// @throws MeshFileError at the last word: "what (word), allowed".
  [[noreturn]] void fail(std::string_view what, std::string_view allowed) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  std::string_view left_;
  std::string_view word_;
  char comment_;
  int line_number_ = 0;
  int column_ = 0;
};

/// Compares without regard to case (ASCII).
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Shortened and without control characters, fit for a message.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace ashlar
