// The pairs of lines of a DXF file: a group code, then its value.
#pragma once

#include <string>
#include <string_view>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

class DxfPairs {
 public:
  /// The text must outlive this.
  explicit DxfPairs(std::string_view text) : rest_(text) {}

  /// Reads the next pair, skipping comments. @throws MeshFileError "file ends before EOF", a code that is not a
  /// number
  void next();

  [[nodiscard]] int code() const { return code_; }
  /// Value without surrounding blanks.
  [[nodiscard]] std::string_view value() const { return value_; }
  /// Value in UTF-8. Older drawings use a national code page; invalid UTF-8 is read as Latin-1.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool is(int code, std::string_view value) const { return code_ == code && value_ == value; }

  /// Value as a number, finite and in the range of coordinates.
  [[nodiscard]] double number(const char* what) const;
  [[nodiscard]] long long integer(const char* what) const;

  [[nodiscard]] int line() const { return line_; }
  /// @throws MeshFileError at the line of the value
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view next_line();

  std::string_view rest_;
  std::string_view value_;
  int code_ = -1;
  int line_ = 0;
};

}  // namespace ashlar
