// Strains at the end of a run, whatever causes them: blocks above, water, bolts.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::strain_warning_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class StrainWarning : public RunCommand {
 protected:
  /// A cube of 1 m^3 of 1 kg/m^3, which cannot move at its base. Order 1: its strain is that of its mean stress.
  /// @param modulus Pa
  void soft_cube(const std::string& modulus, const std::string& more) {
    write_text(scene_, R"([analysis]
type = "static"
gravity = [0, 0, -10]
[[material]]
name = "foam"
density = 1
young_modulus = )" + modulus +
                           R"(
poisson_ratio = 0
[[material]]
name = "rock"
density = 2500
young_modulus = 1e10
poisson_ratio = 0
[[block]]
name = "soft"
material = "foam"
box = { min = [0, 0, 0], max = [1, 1, 1] }
fix = [{ plane = { point = [0, 0, 0], normal = [0, 0, 1] } }]
)" + more);
  }

  /// Runs it. @return the largest strain
  [[nodiscard]] double strain(const std::string& out) {
    EXPECT_EQ(run(out), exit_status::done) << faults_;
    const nlohmann::json largest = nlohmann::json::parse(text(out + "/summary.json"))["largest_strain"];
    EXPECT_EQ(largest["block"], "soft");
    return largest["value"].get<double>();
  }
};

constexpr const char* told = "warning: block soft is strained by 0.125 at the end, up to 0.1 is ordinary";

// Its own weight is 10 Pa at its base, and 5 Pa in the mean: too little for the check before the run.

TEST_F(StrainWarning, CountsTheBlocksAbove) {
  // 2500 kg/m^3 x 10 m/s^2 x 1 m = 25000 Pa.
  const std::string above = R"([[block]]
name = "above"
material = "rock"
box = { min = [0, 0, 1], max = [1, 1, 2] }
)";
  soft_cube("200040", above);
  EXPECT_NEAR(strain("soft"), 0.125, 1e-6);
  EXPECT_THAT(faults_, AllOf(HasSubstr(told), Not(HasSubstr("young_modulus is small"))));
  soft_cube("250050.1", above);
  EXPECT_NEAR(strain("stiffer"), 0.1, 1e-6);
  EXPECT_THAT(faults_, Not(HasSubstr("strained")));
}

TEST_F(StrainWarning, CountsWater) {
  // 2 m of 10 kN/m^3 above the top: 20 kPa. The sides press on each other, which changes no height.
  soft_cube("160040", R"([[water]]
level.point = [0, 0, 3]
level.normal = [0, 0, 1]
unit_weight = 1e4
)");
  EXPECT_NEAR(strain("out"), 0.125, 1e-6);
  EXPECT_THAT(faults_, HasSubstr(told));
}

TEST_F(StrainWarning, CountsPretension) {
  // The bar of E A / L = 1000 N/m shortens with the cube: e = (P + 5 N) / (E + 1000 Pa), by m^2.
  soft_cube("199040", R"([[block]]
name = "floor"
fixed = true
box = { min = [0, 0, -1], max = [1, 1, 0] }
[[bolt]]
name = "bar"
anchored = "ends"
from = [0.5, 0.5, -1]
to = [0.5, 0.5, 1]
area = 1e-6
young_modulus = 2e9
pretension = 25000
)");
  EXPECT_NEAR(strain("out"), 0.125, 1e-6);
  EXPECT_THAT(faults_, HasSubstr(told));
}

}  // namespace
}  // namespace ashlar::strain_warning_test
