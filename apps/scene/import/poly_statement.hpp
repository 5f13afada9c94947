// Commands of a 3DEC data file as words and numbers: a line each, continued after an `&` at its end; `;` begins a
// comment, and brackets, commas and `=` separate as blanks do.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

struct PolyWord {
  std::string_view text;
  int line = 0, column = 0;
};

/// A command with its words, read from the front.
class PolyStatement {
 public:
  explicit PolyStatement(std::vector<PolyWord> words) : words_(std::move(words)) {}

  [[nodiscard]] bool done() const { return next_ == words_.size(); }
  /// The next word, which is there unless done().
  [[nodiscard]] const PolyWord& front() const { return words_[next_]; }
  const PolyWord& take();
  /// Takes the next word if it is `name` or the beginning of it with `least` characters or more, in any case.
  bool take_if(std::string_view name, std::size_t least);
  /// True for a number.
  [[nodiscard]] bool at_number() const;
  /// @throws MeshFileError if there is no number, at its place
  double number(const char* what);
  int whole_number(const char* what);
  /// Numbers up to the next word.
  std::vector<double> numbers();

  /// @throws MeshFileError at the next word, or the last one
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::vector<PolyWord> words_;
  std::size_t next_ = 0;
};

/// All commands of a text. The text must outlive them.
[[nodiscard]] std::vector<PolyStatement> poly_statements(std::string_view text);

/// True if `word` is `name` or its beginning with `least` characters or more, in any case.
[[nodiscard]] bool is_poly_word(std::string_view word, std::string_view name, std::size_t least);

}  // namespace ashlar
