// What slips look like to a TOML parser, and what they are.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace ashlar {

/// "what is wrong (the parser's words), what is allowed" of a document that cannot be parsed: [name] for
/// [[name]], units behind numbers, decimal commas; else in the parser's words.
[[nodiscard]] std::string malformed_toml(std::string_view text, const toml::parse_error& error);

/// What a text in place of a number may have meant: "; numbers have no unit and no quotes (SI units)" or a
/// hint to the decimal point; empty if it begins with no number.
[[nodiscard]] std::string number_hint(std::string_view text);

}  // namespace ashlar
