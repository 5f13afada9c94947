// Numbers as short texts. A standard library that does not write real numbers has this function by other means
// (geometry/text/browser).
#pragma once

namespace ashlar {

enum class NumberForm {
  shorter,     ///< fixed, or scientific if that is shorter
  fixed,       ///< without exponent; of a whole number below 1e15
  scientific,  ///< a digit, further ones behind a point, an exponent of at least two digits
};

/// Bytes that every number needs at most.
inline constexpr int longest_number = 32;

/// Writes the shortest decimal text that reads back as the same double, as std::to_chars does: "nan" and "inf" too.
/// @param begin place for longest_number bytes
/// @return the end of the text
[[nodiscard]] char* write_number(char* begin, double value, NumberForm form = NumberForm::shorter);

}  // namespace ashlar
