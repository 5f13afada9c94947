#include "apps/results/text/csv_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace ashlar::csv_text_test {
namespace {

std::string text_of(double value) {
  std::string text = "before,";
  append_csv_number(text, value);
  return text.substr(7);
}

TEST(CsvNumber, IsShort) {
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(1350.0), "1350");
  EXPECT_EQ(text_of(-2000000.0), "-2000000");
  EXPECT_EQ(text_of(1e15), "1e+15");
  EXPECT_EQ(text_of(1e-300), "1e-300");
  EXPECT_EQ(text_of(-0.0), "-0");
}

TEST(CsvNumber, NamesWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text_of(infinity), "inf");
  EXPECT_EQ(text_of(-infinity), "-inf");
  EXPECT_EQ(text_of(std::abs(std::nan(""))), "nan");
}

TEST(CsvNumber, ReadsBackBitForBit) {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const std::string text = text_of(value);
    double back = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(result.ptr, text.data() + text.size()) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

TEST(CsvField, IsQuotedOnlyWhereNeeded) {
  EXPECT_EQ(quote_csv_field("tip.ux"), "tip.ux");
  EXPECT_EQ(quote_csv_field(""), "");
  EXPECT_EQ(quote_csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(quote_csv_field("the \"tip\""), "\"the \"\"tip\"\"\"");
  EXPECT_EQ(quote_csv_field("a\nb"), "\"a\nb\"");
}

TEST(CsvField, DoesNotBeginAFormula) {
  EXPECT_EQ(quote_csv_field("=cmd|'/c calc'!A1"), "'=cmd|'/c calc'!A1");
  EXPECT_EQ(quote_csv_field("@SUM(1,1)"), "\"'@SUM(1,1)\"");
  EXPECT_EQ(quote_csv_field("+1"), "'+1");
  EXPECT_EQ(quote_csv_field("-1"), "'-1");
  EXPECT_EQ(quote_csv_field("\t=1"), "'\t=1");
  EXPECT_EQ(quote_csv_field("a=b"), "a=b");
  EXPECT_EQ(quote_csv_field("'a'"), "'a'");
  std::string number;
  append_csv_number(number, -1.5);
  EXPECT_EQ(number, "-1.5");
}

TEST(CsvField, GivesTheTextBack) {
  for (const std::string text :
       {"", "'", "=", "'=", "''-x", "'a", "a", "+,", "\"@\"", "\t", "-\"x\"", "it's"}) {
    const auto fields = split_csv_line(quote_csv_field(text));
    ASSERT_EQ(fields.size(), 1U) << text;
    EXPECT_EQ(unmarked_csv_field(fields[0]), text);
  }
}

TEST(CsvLine, IsSplitAtCommasOutsideQuotes) {
  using Fields = std::vector<std::string>;
  EXPECT_EQ(split_csv_line("step,tip.x"), (Fields{"step", "tip.x"}));
  EXPECT_EQ(split_csv_line(",a,"), (Fields{"", "a", ""}));
  EXPECT_EQ(split_csv_line("\"a,b\",\"the \"\"tip\"\"\",c"), (Fields{"a,b", "the \"tip\"", "c"}));
}

}  // namespace
}  // namespace ashlar::csv_text_test
