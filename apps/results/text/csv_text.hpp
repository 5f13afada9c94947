// Fields of comma-separated tables (history.csv, contacts.csv, studies).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// Appends the shortest decimal text that reads back as the same double; whole numbers below 1e15 without exponent,
/// "nan", "inf" and "-inf" for values that are not finite.
void append_csv_number(std::string& text, double value);

/// Number in a complete field; empty if it is anything else.
[[nodiscard]] std::optional<double> csv_number(std::string_view field);

/// A text field, such as a name of the scene. By RFC 4180 it is quoted if it has a comma, a quote or a line break. It
/// gets a leading apostrophe if it begins with = + - @ or a tab, after any apostrophes, as spreadsheets would read a
/// formula. Numbers are no text.
[[nodiscard]] std::string quote_csv_field(std::string_view field);

/// The fields of one line without quotes; a line break inside a quoted field belongs to the line.
[[nodiscard]] std::vector<std::string> split_csv_line(std::string_view line);

/// Argument of quote_csv_field, from a field without quotes: removes the apostrophe.
[[nodiscard]] std::string unmarked_csv_field(std::string_view field);

}  // namespace ashlar
