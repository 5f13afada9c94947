// Names of results in formulas: columns of history.csv and paths of summary.json, with dots between their parts
// ("cube.uz"), which names of formulas do not have.
#pragma once

#include <cstddef>
#include <string_view>

namespace ashlar {

/// True for a letter or an underscore.
[[nodiscard]] bool begins_name(char c);

/// Number of characters of the name, with dots, that a text begins with; 0 if it begins with none.
[[nodiscard]] std::size_t name_length(std::string_view text);

/// Length of what is not a result at the start of a text: a name, a number with its exponent, or one character.
/// @param text not empty
[[nodiscard]] std::size_t plain_length(std::string_view text);

}  // namespace ashlar
