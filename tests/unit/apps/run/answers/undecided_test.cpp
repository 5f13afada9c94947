#include "apps/run/answers/undecided.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "apps/scene/assemble/build_simulation.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::undecided_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* head = R"(
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-3, -3, -1], max = [3, 3, 0] }
)";

/// Of a scene as placed. @param may_continue of the search
std::string factors_of(const std::string& text, bool may_continue = true) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", text);
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(folder / "s.toml", {}, diagnostics);
  EXPECT_TRUE(loaded) << to_string(diagnostics.sorted().front());
  const std::optional<BuiltSimulation> built = build_simulation(*loaded, 1, diagnostics);
  EXPECT_TRUE(built);
  return undecided_factors(built->simulation, 1.0, 1, [may_continue] { return may_continue; });
}

// One block on a plane: both limits are the ratio of the tangents.
TEST(UndecidedFactors, OfABlockOnAPlaneAreOne) {
  const double slope = std::numbers::pi / 6, friction = 35.0 * std::numbers::pi / 180;
  const double factor = std::tan(friction) / std::tan(slope);  // 1.2128
  const std::string scene = fmt::format("analysis = {{ type = \"static\", gravity = [{}, 0, {}] }}\n",
                                        9.81 * std::sin(slope), -9.81 * std::cos(slope)) +
                            "contact = { friction_angle = 35 }" + head + R"(
[[block]]
name = "cube"
material = "m"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)";
  const std::string text = factors_of(scene);
  EXPECT_THAT(text, StartsWith("rigid blocks have a factor of safety of 1.2"));
  double released = 0.0, associated = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str(), "rigid blocks have a factor of safety of %lf", &released), 1);
  const std::size_t second = text.find("and of ");
  ASSERT_NE(second, std::string::npos) << text;
  ASSERT_EQ(std::sscanf(text.c_str() + second, "and of %lf", &associated), 1) << text;
  EXPECT_NEAR(released, factor, 0.01 * factor);
  EXPECT_NEAR(associated, factor, 0.01 * factor);
  EXPECT_THAT(text, HasSubstr("(block cube slides"));
  EXPECT_EQ(factors_of(scene, false), "") << "the search was ended";
}

// A block between two walls that nothing presses on it: it falls without stresses, and wedges with the best of them.
TEST(UndecidedFactors, OfABlockThatWedgesAreFarApart) {
  const std::string text = factors_of("analysis = { type = \"static\" }\ncontact = { friction_angle = 30 }" +
                                      std::string(head) + R"(
[[block]]
name = "left"
fixed = true
box = { min = [-1, 0, 0], max = [0, 1, 3] }
[[block]]
name = "right"
fixed = true
box = { min = [1, 0, 0], max = [2, 1, 3] }
[[block]]
name = "stone"
material = "m"
box = { min = [0, 0, 1], max = [1, 1, 2] }
)");
  EXPECT_THAT(text, HasSubstr("a factor of safety of at most 0.1 without the stresses"));
  EXPECT_THAT(text, HasSubstr("(block stone"));
  EXPECT_THAT(text, HasSubstr("and of more than 10 with the most favourable ones"));
}

}  // namespace
}  // namespace ashlar::undecided_test
