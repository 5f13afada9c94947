// JSON as written and read by all commands.
//
// JSON cannot represent infinity and NaN: such numbers are written as null. Text that is not UTF-8, which file names
// may contain, gets the replacement character.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ashlar {

/// Appends the shortest decimal that reads back as the same double, with a point or an exponent, so that it is not
/// read as an integer; "null" for infinity and NaN.
void append_json_number(fmt::memory_buffer& text, double value);

/// The text of a tree. @param indent blanks a level, -1: all in one line
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// Reads JSON of this program: nested at most 100 deep, with at most 1000 keys in an object. No file of the program
/// exceeds this, and larger trees would need unbounded time and stack.
/// @throws std::runtime_error with the reason
[[nodiscard]] nlohmann::ordered_json parse_json(std::string_view text);

}  // namespace ashlar
