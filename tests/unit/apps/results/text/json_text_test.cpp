#include "apps/results/text/json_text.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace ashlar::json_text_test {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string number_text(double value) {
  fmt::memory_buffer text;
  append_json_number(text, value);
  return fmt::to_string(text);
}

std::string nested(int levels) {
  return fmt::format("{}{}", std::string(static_cast<std::size_t>(levels), '['),
                     std::string(static_cast<std::size_t>(levels), ']'));
}

std::string object_of(int keys) {
  std::string text = "{";
  for (int k = 0; k < keys; ++k) text += fmt::format("{}\"{}\":0", k == 0 ? "" : ",", k);
  text += '}';
  return text;
}

auto refused_with(const std::string& what) {
  return ThrowsMessage<std::runtime_error>(HasSubstr(what));
}

TEST(JsonNumber, ReadsBackTheSameAndIsNoInteger) {
  EXPECT_EQ(number_text(1.0), "1.0");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e300), "1e+300");
  for (const double value : {5e-324, 1.0 / 3.0, -1.7976931348623157e308})
    EXPECT_EQ(ordered_json::parse(number_text(value)).get<double>(), value);
}

TEST(JsonNumber, IsNullWhereNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(number_text(value), "null");
    EXPECT_EQ(json_text({{"value", value}}), "{\"value\":null}");
  }
}

TEST(JsonText, HoldsTextThatIsNotUtf8) {
  EXPECT_TRUE(ordered_json::accept(json_text({{"name", "a\xff"}})));
}

TEST(JsonText, KeepsTheOrderOfKeys) {
  const std::string text = R"({"b":[1,2.5,"x"],"a":{"c":null}})";
  EXPECT_EQ(json_text(parse_json(text)), text);
}

TEST(JsonText, DepthAndKeysAreLimited) {
  EXPECT_EQ(json_text(parse_json(nested(100))), nested(100));
  EXPECT_THAT([] { (void)parse_json(nested(101)); }, refused_with("nested more than 100 deep"));
  EXPECT_THAT([] { (void)parse_json(std::string(1'000'000, '[')); },
              refused_with("nested more than 100 deep"));
  EXPECT_EQ(parse_json(object_of(1000)).size(), 1000U);
  EXPECT_THAT([] { (void)parse_json(object_of(1001)); }, refused_with("more than 1000 keys"));
  EXPECT_EQ(parse_json(fmt::format("[{0},{0}]", object_of(1000))).size(), 2U);
}

TEST(JsonText, WhatIsNoJsonIsRefused) {
  for (const std::string text : {"", "{", "[1,]", "nan", "1e999", "\"\xff\"", "{} {}", "[1"})
    EXPECT_THAT([&] { (void)parse_json(text); }, refused_with("it is no JSON from byte ")) << text;
}

}  // namespace
}  // namespace ashlar::json_text_test
