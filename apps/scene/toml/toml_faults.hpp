// Explanations of frequent mistakes from the errors of a TOML parser.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace ashlar {

/// "what is wrong (the parser's words), what is allowed" for a malformed document: [name] instead of [[name]], units
/// after numbers, decimal commas; otherwise in the parser's words.
[[nodiscard]] std::string malformed_toml(std::string_view text, const toml::parse_error& error);

/// "what is wrong (the number), what is allowed" if a parser's words tell of a number that is too large, too small or
/// not exact; empty otherwise.
[[nodiscard]] std::string number_out_of_range(std::string_view words);

/// Hint for a text in place of a number: "; numbers have no unit and no quotes (SI units)" or a hint on the decimal
/// point; empty if it does not begin with a number.
[[nodiscard]] std::string number_hint(std::string_view text);

}  // namespace ashlar
