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

TEST(TomlFaults, OthersAreInTheParsersWords) {
  EXPECT_THAT(reading_faults("end_time = \n"), ElementsAre(HasSubstr("error: malformed TOML (")));
  EXPECT_THAT(reading_faults("[analysis\n"), ElementsAre(HasSubstr("error: malformed TOML (")));
}

}  // namespace
}  // namespace ashlar::test::toml_faults_test
