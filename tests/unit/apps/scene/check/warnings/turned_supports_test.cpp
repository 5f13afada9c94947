#include "apps/scene/check/warnings/turned_supports.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "apps/scene/assemble/build_simulation.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::turned_supports_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The sample's beam of length 4 m, held at both ends, of which the far one goes up.
std::vector<std::string> warnings(const std::string& last, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  write_text(
      folder / "s.toml",
      sample_with(22,
                  "plane = { point = [0, 0, 0], normal = [-1, 0, 0] }\n[[block.fix]]\nplane = { point = "
                  "[4, 0, 0], normal = [1, 0, 0] }\ndisplacement_history = [[0, 0, 0, 0], " +
                      last + "]"));
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder / "s.toml", overrides, diagnostics);
  EXPECT_TRUE(loaded && build_simulation(*loaded, 1, diagnostics));
  std::vector<std::string> result;
  for (const std::string& line : printed(diagnostics))
    if (line.find(" turns block ") != std::string::npos) result.push_back(line.substr(line.find("s.toml:")));
  return result;
}

TEST(TurnedSupports, LinearElasticityIsWarnedOf) {
  // An affine field with du_z/dx = 1/4 turns by atan(1/8) = 0.1244.
  EXPECT_THAT(warnings("[1, 0, 0, 1]"),
              ElementsAre("s.toml:25:24: warning: displacement_history turns block \"B\" by 0.124 rad, which "
                          "strains it: elasticity \"linear\" does not turn with a block that is held, "
                          "\"st-venant-kirchhoff\" does"));
  EXPECT_THAT(warnings("[1, 0, 0, 1]", {"material.rock.elasticity=st-venant-kirchhoff"}), IsEmpty());
}

TEST(TurnedSupports, SmallTurnsAndThoseAfterTheEndAreNot) {
  EXPECT_THAT(warnings("[1, 0, 0, 0.75]"), IsEmpty());
  EXPECT_THAT(warnings("[2, 0, 0, 1]"), IsEmpty());
  EXPECT_THAT(warnings("[1, 3, 0, 0]"), IsEmpty());
}

// The beam held by its lower face alone, or by four of its points, all moved in the same way or about an
// axis.
std::vector<std::string> warnings_of(const std::string& fixes) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", sample_with(22, fixes));
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder / "s.toml", {}, diagnostics);
  EXPECT_TRUE(loaded && build_simulation(*loaded, 1, diagnostics));
  std::vector<std::string> result;
  for (const std::string& line : printed(diagnostics))
    if (line.find(" turns block ") != std::string::npos) result.push_back(line);
  return result;
}

TEST(TurnedSupports, TranslationOfAFaceIsNoTurn) {
  // The far face stays behind in the field that follows the near one: a shear of 0.5.
  EXPECT_THAT(warnings_of("plane = { point = [0, 0, 0], normal = [0, 0, -1] }\n"
                          "displacement_history = [[0, 0, 0, 0], [1, 0.5, 0, 0]]"),
              IsEmpty());
  EXPECT_THAT(warnings_of("plane = { point = [0, 0, 0], normal = [0, 0, -1] }\n"
                          "velocity_history = [[0, 0, 0, 0], [1, 3, 2, 0]]"),
              IsEmpty());
}

TEST(TurnedSupports, PointsOfOneFaceThatTurnItAre) {
  // Three corners of the lower face turned about x by asin(0.2).
  const double height = 0.2, back = std::sqrt(1.0 - height * height) - 1.0;
  std::string fixes;
  for (const auto& [x, y] : {std::pair{0, 0}, {4, 0}, {0, 1}})
    fixes += fmt::format("{}point = [{}, {}, 0]\ndisplacement_history = [[0, 0, 0, 0], [1, 0, {}, {}]]\n",
                         fixes.empty() ? "" : "[[block.fix]]\n", x, y, y * back, y * height);
  EXPECT_THAT(warnings_of(fixes), ElementsAre(HasSubstr(fmt::format("by {:.3g} rad", std::asin(height)))));
}

}  // namespace
}  // namespace ashlar::test::turned_supports_test
