// Fields of a line of a table: numbers and names between separators.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace ashlar {

struct TextField {
  std::string_view text;  ///< without surrounding blanks and quotes
  int column;             ///< 1-based
};

/// Without surrounding blanks, tabs and carriage returns.
[[nodiscard]] std::string_view trimmed_text(std::string_view text);

/// The first of ; tab and , in a line; a blank if it has none.
[[nodiscard]] char separator_of(std::string_view line);

/// The fields between separators; between runs of blanks if these are the separator.
[[nodiscard]] std::vector<TextField> fields_of(std::string_view line, char separator);

/// A finite number that is the whole text; a plus may precede it.
[[nodiscard]] std::optional<double> number_of(std::string_view text);

}  // namespace ashlar
