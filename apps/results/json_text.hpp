// JSON as every command writes and reads it.
//
// JSON has no words for infinity and NaN: such a number is null wherever this program writes JSON. Text that
// is not UTF-8, as file names may be, gets the replacement character.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ashlar {

/// Appends the shortest decimal that reads back as the same double, with a point or an exponent, so that no
/// reader takes it for an integer; "null" for infinity and NaN.
void append_json_number(fmt::memory_buffer& text, double value);

/// The text of a tree. @param indent blanks a level, -1: all in one line
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// Reads JSON of this program: nested at most 100 deep, with at most 1000 keys in an object. Beyond that no
/// file of ours goes, and the time and the stack that a tree takes have no bound.
/// @throws std::runtime_error with the reason
[[nodiscard]] nlohmann::ordered_json parse_json(std::string_view text);

}  // namespace ashlar
