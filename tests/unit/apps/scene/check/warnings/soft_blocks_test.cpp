#include "apps/scene/check/warnings/soft_blocks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/expand/scene_solids.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::soft_blocks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A cube of 1 m and a beam 4 x 1 x 1 m of 2500 kg/m^3, 1e5 Pa on the beam's end.
std::vector<std::string> warnings(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample(), "s.toml", overrides, diagnostics);
  warn_of_soft_blocks(ExpandedScene(scene), build_solids(scene, diagnostics), diagnostics);
  EXPECT_TRUE(diagnostics.good());
  return printed(diagnostics);
}

const std::string unloaded = "block.B.load.0.traction=[0, 0, 0]";

TEST(SoftBlocks, OrdinaryOnesGiveNoWarning) {
  EXPECT_THAT(warnings({}), IsEmpty());
}

TEST(SoftBlocks, OwnWeightCountsByTheHeightAlongGravity) {
  // 2500 kg/m^3 x 9.81 m/s^2 x 1 m = 24525 Pa
  EXPECT_THAT(warnings({unloaded, "material.rock.young_modulus=245251"}), IsEmpty());
  EXPECT_THAT(
      warnings({unloaded, "material.rock.young_modulus=5"}),
      ElementsAre("--set material.rock.young_modulus=5: warning: young_modulus is small (5 Pa): block "
                  "\"A\" is strained by 4.9e+03 under its own weight, up to 0.1 is ordinary; rock has "
                  "1e9 to 1e11 Pa"));
  // Along x the beam is 4 m high: 98100 Pa.
  EXPECT_THAT(warnings({unloaded, "material.rock.young_modulus=245251", "analysis.gravity=[9.81, 0, 0]"}),
              ElementsAre("--set material.rock.young_modulus=245251: warning: young_modulus is small (245251 "
                          "Pa): block \"B\" is strained by 0.4 under its own weight, up to 0.1 is ordinary; "
                          "rock has 1e9 to 1e11 Pa"));
}

TEST(SoftBlocks, GravityThatChangesCountsWhereItIsLargest) {
  // Ten times the weight above: a strain of 1.
  EXPECT_THAT(warnings({unloaded, "material.rock.young_modulus=245250",
                        "analysis.gravity_history=[[0, 0, 0, 0], [1, 0, 0, -98.1], [2, 1, 0, 0]]"}),
              ElementsAre(HasSubstr("block \"A\" is strained by 1 under its own weight")));
}

TEST(SoftBlocks, LoadsAndVelocitiesCountWithoutGravity) {
  const std::string weightless = "analysis.gravity=[0, 0, 0]";
  EXPECT_THAT(warnings({weightless, unloaded, "material.rock.young_modulus=5"}), IsEmpty());
  EXPECT_THAT(warnings({weightless, "material.rock.young_modulus=1.0001e6"}), IsEmpty());
  EXPECT_THAT(
      warnings({weightless, "material.rock.young_modulus=5e5"}),
      ElementsAre("--set material.rock.young_modulus=5e5: warning: young_modulus is small (500000 Pa): "
                  "block \"B\" is strained by 0.2 under its load, up to 0.1 is ordinary; rock has 1e9 "
                  "to 1e11 Pa"));
  // The largest factor is 10, whatever its sign.
  EXPECT_EQ(warnings({weightless, "material.rock.young_modulus=1.0001e6",
                      "block.B.load.0.history=[[0, 0], [1, -10]]"})
                .size(),
            1U);
  // Sound travels at sqrt(1e7 / 2500) = 63.2 m/s.
  EXPECT_THAT(warnings({weightless, "material.rock.young_modulus=1e7", "block.A.velocity=[6.3, 0, 0]"}),
              IsEmpty());
  EXPECT_EQ(warnings({weightless, "material.rock.young_modulus=1e7", "block.A.velocity=[6.4, 0, 0]"}).size(),
            1U);
  // 0.866 m from the centre to a corner: 8 rad/s are 6.93 m/s there.
  EXPECT_EQ(
      warnings({weightless, "material.rock.young_modulus=1e7", "block.A.angular_velocity=[0, 8, 0]"}).size(),
      1U);
}

TEST(SoftBlocks, StiffnessesThatAreGivenCount) {
  // 24525 Pa / 0.1 m
  EXPECT_THAT(warnings({"contact.normal_stiffness=245251"}), IsEmpty());
  EXPECT_THAT(warnings({"contact.normal_stiffness=122625"}),
              ElementsAre("--set contact.normal_stiffness=122625: warning: normal_stiffness is small (122625 "
                          "Pa/m): block \"A\" sinks by 0.2 of its size under its own weight, up to "
                          "0.1 is ordinary"));
  EXPECT_EQ(warnings({"joint.0.normal_stiffness=122625"}).size(), 1U);
  // Three points transmit 98100 N of B, whose size is cbrt(4) m: 0.1 of it at 206e3 N/m.
  EXPECT_THAT(warnings({"contact.springs=point", "contact.normal_stiffness=2.1e5"}), IsEmpty());
  EXPECT_THAT(warnings({"contact.springs=point", "contact.normal_stiffness=2e5"}),
              ElementsAre("--set contact.normal_stiffness=2e5: warning: normal_stiffness is small (200000 "
                          "N/m): block \"B\" sinks by 0.103 of its size under its own weight, up to "
                          "0.1 is ordinary"));
}

}  // namespace
}  // namespace ashlar::test::soft_blocks_test
