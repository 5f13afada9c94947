// Fields of comma-separated tables (history.csv, contacts.csv, studies).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// Appends the shortest decimal text that reads back as the same double; whole numbers below 1e15 without
/// exponent, "nan", "inf" and "-inf" for what is not finite.
void append_csv_number(std::string& text, double value);

/// The number that a whole field is; none if it is anything else.
[[nodiscard]] std::optional<double> csv_number(std::string_view field);

/// A field that is text, as a name of the scene: RFC 4180, so that one with a comma, a quote or a line break
/// is quoted; and with an apostrophe before it if it begins with = + - @ or a tab, after any apostrophes,
/// which spreadsheets take for the beginning of a formula. Numbers are not text.
[[nodiscard]] std::string quote_csv_field(std::string_view field);

/// The fields of one line without quotes; a line break inside a quoted field belongs to the line.
[[nodiscard]] std::vector<std::string> split_csv_line(std::string_view line);

/// The text that was given to quote_csv_field, from a field without quotes: the apostrophe is taken off.
[[nodiscard]] std::string unmarked_csv_field(std::string_view field);

}  // namespace ashlar
