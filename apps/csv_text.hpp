// Fields of comma-separated tables (history.csv, contacts.csv, studies).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// Appends the shortest decimal text that reads back as the same double; whole numbers below 1e15 without
/// exponent, "nan", "inf" and "-inf" for what is not finite.
void append_csv_number(std::string& text, double value);

/// RFC 4180: a field with a comma, a quote or a line break is quoted, others are returned as they are.
[[nodiscard]] std::string quote_csv_field(std::string_view field);

/// The fields of one line, unquoted; a line break inside a quoted field belongs to the line.
[[nodiscard]] std::vector<std::string> split_csv_line(std::string_view line);

}  // namespace ashlar
