// Values of an MSH file in their order: words of lines in a text file; in a binary one bytes, between lines that name the
// sections. A reader asks for values, and need not know which of the two it reads.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>

#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {

/// All members @throws MeshFileError "what (value), allowed" with line and column; in a binary file with the byte
/// instead. No more is read than there is.
class MshScanner {
 public:
  /// The text must outlive the scanner.
  explicit MshScanner(std::string_view text) : text_(text), scan_(text, '\0') {}

  /// From here on numbers are bytes in this order. Reads the number 1 that begins such a file, which tells it.
  void begin_binary();
  [[nodiscard]] bool binary() const { return binary_; }

  /// Lines and their words, of both kinds of files; as the members of TextScanner.
  /// @{
  bool next_line();
  void require_line(std::string_view what);
  std::string_view word();
  std::string_view require_word(std::string_view what);
  void expect(std::initializer_list<std::string_view> words);
  long long word_as_integer(std::string_view what, long long low, long long high);
  /// @}

  /// Goes behind the line with this word.
  void skip_past_line(const std::string& word);

  /// Numbers of a record: it begins with a line of its own in a text file.
  /// @{
  void begin_record(std::string_view what);
  /// 4 bytes.
  long long integer(std::string_view what, long long low, long long high);
  /// 8 bytes.
  long long size(std::string_view what, long long low, long long high);
  /// 8 bytes.
  double number(std::string_view what);
  /// The same, no farther from zero than largest_coordinate.
  double coordinate(std::string_view what);
  /// Passes over numbers of `bytes` bytes each in a binary file; in a text file the rest of a line is not read.
  void skip_numbers(std::string_view what, long long count, int bytes);
  /// @}

  /// Place of the last number: its line, or byte.
  [[nodiscard]] long long place() const;
  [[nodiscard]] std::string_view unit_of_place() const { return binary_ ? "byte" : "line"; }
  /// 0 in a binary file.
  [[nodiscard]] int line() const { return binary_ ? 0 : scan_.line(); }

  [[noreturn]] void fail(std::string_view what, std::string_view allowed) const;

 private:
  /// The next bytes, as they are.
  std::string_view take(std::string_view what, std::size_t bytes);
  template <class Number>
  Number value(std::string_view what);
  [[noreturn]] void fail_at_byte(std::string_view what, std::string_view allowed) const;
  /// Runs a member of the text scanner, whose lines are unknown in a binary file.
  template <class Read>
  auto of_line(Read read);

  std::string_view text_;
  TextScanner scan_;
  bool binary_ = false;
  std::endian order_ = std::endian::native;
  std::size_t byte_ = 0;                                    ///< where it begins
  std::variant<std::int32_t, std::uint64_t, double> last_;  ///< last number read from bytes
};

}  // namespace ashlar
