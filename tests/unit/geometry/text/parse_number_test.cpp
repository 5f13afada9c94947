#include "geometry/text/parse_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace ashlar::parse_number_test {
namespace {

struct Parsed {
  double value = 7.0;
  std::size_t used = 0;
  std::errc reason{};
};

template <class Parse>
Parsed parsed(const std::string& text, Parse parse) {
  Parsed result;
  const auto [end, reason] = parse(text.data(), text.data() + text.size(), result.value);
  result.used = static_cast<std::size_t>(end - text.data());
  result.reason = reason;
  return result;
}

Parsed by_strtod(const std::string& text) {
  return parsed(text, parse_real_by_strtod);
}

void expect_number(const std::string& text, double value, std::size_t used) {
  const Parsed result = by_strtod(text);
  EXPECT_EQ(result.reason, std::errc()) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(result.value), std::bit_cast<std::uint64_t>(value)) << text;
  EXPECT_EQ(result.used, used) << text;
}

TEST(ParseNumber, ReadsTheLongestStartThatIsANumber) {
  expect_number("1,5", 1.0, 1);
  expect_number("1.5.2", 1.5, 3);
  expect_number("-.25x", -0.25, 4);
  expect_number("3.", 3.0, 2);
  expect_number("2e", 2.0, 1);
  expect_number("2e+", 2.0, 1);
  expect_number("2E-1e", 0.2, 4);
  expect_number("0x10", 0.0, 1);
  expect_number("-0", -0.0, 2);
  expect_number("0e999", 0.0, 5);
}

TEST(ParseNumber, RoundsToTheNearest) {
  // 2^53 + 1 lies between two doubles: the even one, unless a digit far behind says more.
  expect_number("9007199254740993", 9007199254740992.0, 16);
  expect_number("9007199254740993.00000000000000000000000000000001", 9007199254740994.0, 49);
  expect_number("4.9406564584124654e-324", std::numeric_limits<double>::denorm_min(), 23);
  expect_number("1.7976931348623157e308", std::numeric_limits<double>::max(), 22);
}

TEST(ParseNumber, WordsAreNumbersToo) {
  const double infinity = std::numeric_limits<double>::infinity();
  expect_number("inf", infinity, 3);
  expect_number("-INFinity", -infinity, 9);
  expect_number("infinit", infinity, 3);
  EXPECT_TRUE(std::isnan(by_strtod("NaN(a_1)").value));
  EXPECT_EQ(by_strtod("nan(a-1)").used, 3U);
}

TEST(ParseNumber, NothingElseIs) {
  for (const char* text : {"", "+1", " 1", "-", ".", "-.", "e5", "x", "-+1", "in", "$1"}) {
    const Parsed result = by_strtod(text);
    EXPECT_EQ(result.reason, std::errc::invalid_argument) << text;
    EXPECT_EQ(result.used, 0U) << text;
    EXPECT_EQ(result.value, 7.0) << text;
  }
  for (const char* text : {"1e400", "-1e400", "1e-400"}) {
    const Parsed result = by_strtod(text);
    EXPECT_EQ(result.reason, std::errc::result_out_of_range) << text;
    EXPECT_EQ(result.used, std::string_view(text).size()) << text;
    EXPECT_EQ(result.value, 7.0) << text;
  }
}

#if defined(__cpp_lib_to_chars)
TEST(ParseNumber, IsThatOfTheStandardLibrary) {
  std::uint64_t state = 1;
  const auto random = [&state](std::uint64_t below) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return (state >> 33U) % below;
  };
  constexpr std::string_view letters = "0123456789.-+eEinfa(0)12345";
  for (int k = 0; k < 200000; ++k) {
    std::string text;
    for (std::uint64_t left = random(12); left > 0; --left) text += letters[random(letters.size())];
    const Parsed expected = parsed(text, [](const char* begin, const char* end, double& value) {
      return std::from_chars(begin, end, value);
    });
    const Parsed result = by_strtod(text);
    ASSERT_EQ(result.reason, expected.reason) << text;
    ASSERT_EQ(result.used, expected.used) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(result.value), std::bit_cast<std::uint64_t>(expected.value))
        << text;
  }
}
#endif

}  // namespace
}  // namespace ashlar::parse_number_test
