#include "apps/program/mcp/argument_schema.hpp"

#include <gmock/gmock.h>

namespace ashlar::argument_schema_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

Json sample_schema() {
  return arguments_schema({{"text", text_argument("a text", 5)},
                           {"word", word_argument("a word", {"one", "two"})},
                           {"count", whole_number_argument("a count", 1, 9)},
                           {"share", number_argument("a share", 0.0, 1.0)},
                           {"flag", flag_argument("a flag")},
                           {"names", texts_argument("names", 2)},
                           {"set", settings_argument("settings")}},
                          {"text"});
}

TEST(FaultOfArguments, IsEmptyForThoseThatFit) {
  EXPECT_EQ(fault_of_arguments(sample_schema(), {{"text", ""}}), "");
  EXPECT_EQ(fault_of_arguments(sample_schema(), {{"text", "abcde"},
                                                 {"word", "two"},
                                                 {"count", 9.0},
                                                 {"share", 1},
                                                 {"flag", false},
                                                 {"names", {"a", "b"}},
                                                 {"set", {{"a.b", 1.5}, {"c", "d"}, {"e", true}}}}),
            "");
}

TEST(FaultOfArguments, SaysWhatIsWrongAndWhatIsAllowed) {
  const auto fault = [](const char* name, const Json& value) {
    Json arguments = {{"text", "a"}};
    arguments[name] = value;
    return fault_of_arguments(sample_schema(), arguments);
  };
  EXPECT_EQ(fault("text", "abcdef"), "text is \"abcdef\", a text of at most 5 bytes is needed");
  EXPECT_EQ(fault("word", "three"), "word is \"three\", one of one, two is needed");
  EXPECT_EQ(fault("count", 10), "count is 10, a whole number from 1 to 9 is needed");
  EXPECT_THAT(fault("count", 1.5), HasSubstr("a whole number"));
  EXPECT_THAT(fault("share", -0.1), HasSubstr("a number from 0.0 to 1.0"));
  EXPECT_THAT(fault("flag", 1), HasSubstr("true or false"));
  EXPECT_THAT(fault("names", {"a", "b", "c"}), HasSubstr("a list of at most 2 texts"));
  EXPECT_THAT(fault("names", {1}), HasSubstr("a list"));
  EXPECT_THAT(fault("set", {{"a", nullptr}}), HasSubstr("an object"));
  EXPECT_THAT(fault("cuont", 1), HasSubstr("did you mean count? "));
  EXPECT_EQ(fault_of_arguments(sample_schema(), Json::object()),
            "text is missing, a text of at most 5 bytes is needed");
  EXPECT_EQ(fault_of_arguments(arguments_schema({}), {{"a", 1}}), "unknown argument (a), none is allowed");
}

}  // namespace
}  // namespace ashlar::argument_schema_test
