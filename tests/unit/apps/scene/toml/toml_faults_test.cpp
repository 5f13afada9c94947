// Slips that a TOML parser has no words for.
#include "apps/scene/toml/toml_faults.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::toml_faults_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(TomlFaults, AListNeedsTwoBrackets) {
  EXPECT_THAT(reading_faults("[block]\nname = \"a\"\n[block]\nname = \"b\"\n"),
              ElementsAre(AllOf(HasSubstr("[block] for one of a list"), HasSubstr("headed [[block]]"))));
  EXPECT_THAT(reading_faults("[analysis]\nend_time = 1\n[analysis]\n"),
              ElementsAre(HasSubstr("analysis is given twice")));
}

TEST(TomlFaults, NumbersHaveNoUnit) {
  for (const char* value : {"1.0 s", "10 kPa", "5e9Pa", "30\xC2\xB0", "3 %"})
    EXPECT_THAT(reading_faults(sample_with(2, std::string("end_time = ") + value)),
                ElementsAre(HasSubstr("error: a unit behind a number")))
        << value;
  EXPECT_THAT(reading_faults(sample_with(22, "point = [0 m, 0, 0]")),
              ElementsAre(HasSubstr("a unit behind a number")));
  EXPECT_THAT(
      reading_faults(sample_with(11, "young_modulus = \"10 kPa\"")),
      ElementsAre(
          "s.toml:11:17: error: young_modulus has the wrong type (\"10 kPa\"), a number > 0 is needed; a "
          "number has no unit and no quotes (SI units, degrees)"));
}

TEST(TomlFaults, DecimalsHaveAPoint) {
  EXPECT_THAT(reading_faults(sample_with(2, "end_time = 1,5")),
              ElementsAre(HasSubstr("a comma in a number")));
  EXPECT_THAT(reading_faults(sample_with(2, "end_time = \"1,5\"")),
              ElementsAre(HasSubstr("a number > 0 is needed; a decimal point, not a comma")));
}

// 2^53 + 1 is the first whole number between two of double precision.
TEST(TomlFaults, WholeNumbersAreExactOrRefused) {
  for (const char* value : {"9007199254740993", "-9007199254740993", "9223372036854775807",
                            "0x20000000000001", "9223372036854775808", "123456789012345678901234567890"}) {
    EXPECT_THAT(reading_faults(sample_with(2, std::string("end_time = ") + value)),
                ElementsAre(AllOf(StartsWith("s.toml:2:"),
                                  HasSubstr("error: whole number is not exact in double precision ("))))
        << value;
    Diagnostics faults;
    (void)parse_scene(sample(), "s.toml", {std::string("material.0.young_modulus=") + value}, faults);
    EXPECT_THAT(printed(faults), ElementsAre(HasSubstr("error: whole number is not exact"))) << value;
  }
  // A place on the left of what the parser has read, in a row, and behind letters of several bytes.
  EXPECT_THAT(reading_faults(sample_with(22, "name = \"\u00e4\", point = [0, 9007199254740993, 0]")).front(),
              StartsWith("s.toml:22:"));
}

TEST(TomlFaults, LargeWholeNumbersAreReadAsGiven) {
  const std::vector<std::pair<std::string, double>> exact = {{"9007199254740992", 0x1p53},
                                                             {"9007199254740994", 0x1p53 + 2},
                                                             {"10000000000000000", 1e16},
                                                             {"4611686018427387904", 0x1p62},
                                                             {"9223372036854774784", 0x1.fffffffffffffp62},
                                                             {"0x4000_0000_0000_0000", 0x1p62}};
  for (const auto& [text, value] : exact) {
    Diagnostics faults;
    const Scene scene = parse_scene(sample_with(11, "young_modulus = " + text), "s.toml",
                                    {"material.0.density=" + text}, faults);
    EXPECT_THAT(printed(faults), ElementsAre()) << text;
    EXPECT_EQ(scene.material.at(0).young_modulus, value) << text;
    EXPECT_EQ(scene.material.at(0).density, value) << text;
  }
}

TEST(TomlFaults, NumbersOutOfRangeAreNoZeros) {
  for (const char* value : {"1e400", "-1e400", "1e-400", "0.0e0001e", "1_0.5e-5_000", "\"= 1e-400\"",
                            "\"= 2*1e400\"", "\"= -.5e-999 + 1\""}) {
    const auto faults = reading_faults(sample_with(2, std::string("end_time = ") + value));
    ASSERT_FALSE(faults.empty()) << value;
    EXPECT_THAT(faults.front(), StartsWith("s.toml:2:")) << value;
    if (std::string_view(value) == "0.0e0001e") continue;
    EXPECT_THAT(faults.front(), HasSubstr("number is out of the range of double precision (")) << value;
  }
  // Zeros of any form are zeros.
  for (const char* value : {"0.0", "-0.0", "0e-999", "0.000e5_000", "+0.0", "\"= 0e-999\""}) {
    Diagnostics faults;
    const Scene scene = parse_scene(sample(), "s.toml", {std::string("contact.cohesion=") + value}, faults);
    EXPECT_THAT(printed(faults), ElementsAre()) << value;
    EXPECT_EQ(scene.contact.law.cohesion, 0.0) << value;
  }
}

TEST(TomlFaults, PlacesOfLostNumbersCountCharacters) {
  EXPECT_THAT(
      reading_faults("\xef\xbb\xbftitle = \"\xc3\xa4\xe2\x82\xac\"\nparameters = {a = 0.0, b = 1e-999}\n"),
      ElementsAre(StartsWith("s.toml:2:28: error: number is out of the range")));
  EXPECT_THAT(reading_faults("parameters = {\"\xc3\xa4\xe2\x82\xac\" = 2e-999}\n"),
              ElementsAre(StartsWith("s.toml:1:22: error: number is out of the range")));
}

TEST(TomlFaults, OthersAreInTheParsersWords) {
  EXPECT_THAT(reading_faults("end_time = \n"), ElementsAre(HasSubstr("error: malformed TOML (")));
  EXPECT_THAT(reading_faults("[analysis\n"), ElementsAre(HasSubstr("error: malformed TOML (")));
}

}  // namespace
}  // namespace ashlar::test::toml_faults_test
