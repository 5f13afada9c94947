// Numbers of the command line. CLI11 alone reads 010 as 8, 0x10 as 16 and 1e-400 as 0, and takes NaN for a number in any
// range.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/text/parse_number.hpp"

namespace ashlar {

inline constexpr std::uint64_t largest_int = std::numeric_limits<int>::max();

/// For Option::transform: an argument that is one whole number in decimal digits, low to high. Anything else is an
/// error of usage: "value is out of range (5), a whole number from 1 to 4 is needed".
/// @param high the default: what an int holds, which is not told
[[nodiscard]] CLI::Validator whole_number_option(std::uint64_t low, std::uint64_t high = largest_int);

/// Values of an option of real numbers, in the option's unit.
struct RealOptionRange {
  double low = std::numeric_limits<double>::lowest(), high = std::numeric_limits<double>::max();
  bool low_allowed = true;
  const char* words = "a number";  ///< description, as "a number > 0"
};

/// The same for one finite real number, which is read to the nearest of double precision; one that is too large or too
/// small for that is an error of usage.
[[nodiscard]] CLI::Validator real_number_option(RealOptionRange range);

/// Numbers between separators; empty if the text is anything else, or has a number out of the range of its type.
template <class T>
[[nodiscard]] std::vector<T> numbers_of(std::string_view text, char separator) {
  std::vector<T> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    T number{};
    const auto [next, error] = parse_number(at, end, number);
    if (error != std::errc{}) return {};
    numbers.push_back(number);
    if (next == end) return numbers;
    if (*next != separator) return {};
    at = next + 1;
  }
}

}  // namespace ashlar
