// std::from_chars for all numbers: not every standard library has it for real ones (LLVM's up to 19).
#pragma once

#include <charconv>

namespace ashlar {

/// As std::from_chars for double by the C library, whose strtod rounds correctly. Takes more time, and memory for a copy.
[[nodiscard]] std::from_chars_result parse_real_by_strtod(const char* begin, const char* end, double& value);

/// As std::from_chars(begin, end, value): the longest start that is a number, without blanks or a plus before it, in
/// no language. std::errc::invalid_argument: there is none; std::errc::result_out_of_range: it is beyond the largest
/// number or below the smallest one. The value is then left as it was.
template <class Number>
std::from_chars_result parse_number(const char* begin, const char* end, Number& value) {
  return std::from_chars(begin, end, value);
}

template <>
inline std::from_chars_result parse_number(const char* begin, const char* end, double& value) {
#if defined(__cpp_lib_to_chars)
  return std::from_chars(begin, end, value);
#else
  return parse_real_by_strtod(begin, end, value);
#endif
}

}  // namespace ashlar
