// Lines of a file of LMGC90: words, then pairs `name= value`, with blanks anywhere around `=`; numbers in Fortran's form
// (0.5D+01). Lines that begin with `!` or `#`, and empty ones, are passed over; `$` begins a keyword.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

class Lmgc90Lines {
 public:
  /// @param text of the file, which must outlive this
  Lmgc90Lines(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  /// Goes to the next line. @return false at the end of the file
  bool next();
  /// The same. @throws ImportError "file ends before <what>"
  void require_next(const char* what);
  /// Stays on this line: the next call of next() returns it again.
  void put_back() { kept_ = true; }

  /// Words before the pairs.
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] std::string_view word(std::size_t index) const {
    return index < words_.size() ? words_[index] : std::string_view();
  }
  [[nodiscard]] bool has(std::string_view name) const;

  /// All members @throws ImportError with the place.
  /// @{
  [[nodiscard]] std::string_view text(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] int whole_number(std::string_view name) const;
  [[nodiscard]] double number_of_word(std::size_t index) const;
  [[nodiscard]] int whole_number_of_word(std::size_t index) const;
  /// @}

  /// @param at a part of the line, for the column
  [[noreturn]] void fail(std::string_view at, const std::string& what) const;

 private:
  [[nodiscard]] double number_in(std::string_view text, std::string_view what) const;
  [[nodiscard]] int whole_number_in(std::string_view text, std::string_view what) const;

  std::string file_;
  std::string_view rest_, line_;
  int number_ = 0;
  bool kept_ = false;
  std::vector<std::string_view> words_;
  std::vector<std::pair<std::string_view, std::string_view>> pairs_;
};

}  // namespace ashlar
