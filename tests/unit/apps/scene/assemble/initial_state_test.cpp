#include "apps/scene/assemble/initial_state.hpp"

#include <gmock/gmock.h>

#include "apps/scene/assemble/build_simulation.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::initial_state_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// The sample: a cube on a beam that is clamped at one end.
class InitialState : public ::testing::Test {
 protected:
  std::vector<std::string> as_placed(std::vector<std::string> overrides = {}) {
    const TemporaryFolder folder;
    write_text(folder / "s.toml", sample());
    overrides.emplace_back("analysis.initial_state=equilibrium");
    Diagnostics diagnostics;
    const auto loaded = load_scene(folder / "s.toml", overrides, diagnostics);
    auto built = loaded ? build_simulation(*loaded, 1, diagnostics) : std::nullopt;
    printed_ = printed(diagnostics);
    return built ? built->as_placed : std::vector<std::string>{"not built"};
  }

  std::vector<std::string> printed_;
};

TEST_F(InitialState, BlocksWithoutSupportsAreNamed) {
  EXPECT_THAT(as_placed(), ElementsAre("A"));
  EXPECT_THAT(printed_, IsEmpty());
}

TEST_F(InitialState, SupportsThatLeaveARotationDoNotHold) {
  // Two points hold all but the rotation about the line through them.
  EXPECT_THAT(as_placed({"block.B.fix=[{ point = [0, 0, 0] }, { point = [4, 0, 0] }]"}),
              ElementsAre("A", "B"));
  EXPECT_THAT(printed_, ElementsAre(StartsWith("--set analysis.initial_state=equilibrium: warning: "
                                               "initial_state has no effect (\"equilibrium\"): ")));
}

TEST_F(InitialState, TiedBlocksStartAsPlaced) {
  EXPECT_THAT(as_placed({"joint.0.tied=true"}), ElementsAre("A", "B"));
  EXPECT_THAT(printed_, ElementsAre(StartsWith("--set analysis.initial_state=equilibrium: warning: "
                                               "initial_state has no effect")));
}

TEST_F(InitialState, ABlockWithoutEquilibriumIsWarnedOf) {
  // Its elastic energy is beyond the largest double.
  EXPECT_THAT(
      as_placed({"material.rock.elasticity=st-venant-kirchhoff", "block.B.load.0.traction=[0, 0, -1e300]"}),
      ElementsAre("A", "B"));
  EXPECT_THAT(printed_, ElementsAre(HasSubstr("warning: young_modulus is small"),
                                    AllOf(StartsWith("--set analysis.initial_state=equilibrium: warning: "),
                                          HasSubstr("was not found for block \"B\""))));
}

TEST_F(InitialState, ABlockTurnedInsideOutIsRefused) {
  // Of order 1, without lateral contraction, pressed towards its clamped face: strain -1e5 / E.
  const auto settle = [&](const char* young_modulus) {
    return as_placed({"material.rock.poisson_ratio=0", "analysis.gravity=[0, 0, 0]",
                      "block.B.load.0.traction=[-1e5, 0, 0]",
                      std::string("material.rock.young_modulus=") + young_modulus});
  };
  EXPECT_THAT(settle("1.01e5"), ElementsAre("A"));
  EXPECT_THAT(settle("0.99e5"), ElementsAre("not built"));
  EXPECT_THAT(printed_, Contains(StartsWith("--set analysis.initial_state=equilibrium: error: initial_state "
                                            "(\"equilibrium\") turns block \"B\" inside out")));
}

TEST_F(InitialState, FixedBlocksAreNotNamed) {
  EXPECT_THAT(as_placed({"block.A.fixed=true"}), IsEmpty());
  EXPECT_THAT(printed_, IsEmpty());
}

TEST(FirstNames, NamesBeyondTheFifthAreCounted) {
  EXPECT_EQ(first_names({"a"}), "a");
  EXPECT_EQ(first_names({"a", "b", "c", "d", "e"}), "a, b, c, d, e");
  EXPECT_EQ(first_names({"a", "b", "c", "d", "e", "f", "g"}), "a, b, c, d, e and 2 more");
}

}  // namespace
}  // namespace ashlar::test::initial_state_test
