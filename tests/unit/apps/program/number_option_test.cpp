// Numbers of the command line are what their digits say, or an error of usage.
#include "apps/program/number_option.hpp"

#include <gmock/gmock.h>

#include <optional>

namespace ashlar::test::number_option_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class Number>
std::optional<Number> read(const std::string& text, const CLI::Validator& validator) {
  CLI::App program;
  Number number{};
  program.add_option("--number", number)->transform(validator);
  try {
    program.parse(std::vector<std::string>{"--number=" + text});
  } catch (const CLI::ParseError&) {
    return std::nullopt;
  }
  return number;
}

TEST(NumberOption, WholeNumbersAreDecimal) {
  const CLI::Validator any = whole_number_option(0);
  for (const auto& [text, value] : std::vector<std::pair<std::string, int>>{
           {"0", 0}, {"010", 10}, {"+7", 7}, {"08", 8}, {"2147483647", 2147483647}})
    EXPECT_EQ(read<int>(text, any), value) << text;
  for (const char* text : {"0x10", "1e3", "2.5", "-1", "", " 4", "4 ", "4x", "1_000", "0b1", "2147483648",
                           "4294967297", "18446744073709551616", "99999999999999999999999", "+-1", "nan"})
    EXPECT_EQ(read<int>(text, any), std::nullopt) << text;
  EXPECT_EQ(read<int>("4", whole_number_option(1, 4)), 4);
  EXPECT_EQ(read<int>("5", whole_number_option(1, 4)), std::nullopt);
  EXPECT_EQ(read<int>("0", whole_number_option(1, 4)), std::nullopt);
}

TEST(NumberOption, SeedsHaveAllBits) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(read<std::uint64_t>("18446744073709551615", whole_number_option(0, most)), most);
  EXPECT_EQ(read<std::uint64_t>("9007199254740993", whole_number_option(0, most)), 9007199254740993U);
  EXPECT_EQ(read<std::uint64_t>("18446744073709551616", whole_number_option(0, most)), std::nullopt);
}

TEST(NumberOption, RealNumbersAreTheNearest) {
  const CLI::Validator any = real_number_option({});
  // The fourth is just above the middle between two of double precision: rounded by way of an extended one first, it
  // would be the lower.
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"0.1", 0.1},
           {"-2.5e-3", -2.5e-3},
           {"4.9e-324", 0x1p-1074},
           {"1.00000000000000011102230246251565404236316680908203126", 0x1.0000000000001p0},
           {"1.7976931348623157e308", std::numeric_limits<double>::max()},
           {"0", 0.0},
           {"+3", 3.0}})
    EXPECT_EQ(read<double>(text, any), value) << text;
  for (const char* text :
       {"1e400", "-1e400", "1e-400", "nan", "inf", "-inf", "0x1p3", "1,5", "5 ", " 5", "", "1e", "5s", "+-1"})
    EXPECT_EQ(read<double>(text, any), std::nullopt) << text;
  const CLI::Validator positive = real_number_option({.low = 0.0, .high = 99.0, .low_allowed = false});
  EXPECT_EQ(read<double>("0", positive), std::nullopt);
  EXPECT_EQ(read<double>("99", positive), 99.0);
  EXPECT_EQ(read<double>("99.5", positive), std::nullopt);
}

TEST(NumberOption, ListsHaveNumbersOnly) {
  EXPECT_THAT(numbers_of<double>("1,-2.5,3e5", ','), ElementsAre(1.0, -2.5, 3e5));
  EXPECT_THAT(numbers_of<int>("16x9", 'x'), ElementsAre(16, 9));
  for (const char* text : {"", "1,", ",1", "1,,2", "1,1e400,2", "1e-400", "1;2", "1, 2"})
    EXPECT_THAT(numbers_of<double>(text, ','), IsEmpty()) << text;
  EXPECT_THAT(numbers_of<int>("16x99999999999", 'x'), IsEmpty());
}

}  // namespace
}  // namespace ashlar::test::number_option_test
