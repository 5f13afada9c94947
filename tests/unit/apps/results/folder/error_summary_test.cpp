#include "apps/results/folder/error_summary.hpp"

#include <gmock/gmock.h>

#include "support/simulations.hpp"

namespace ashlar::error_summary_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class AccuracySummary : public ::testing::Test {
 protected:
  AccuracySummary() {
    scene_.analysis.accuracy = 0.01;
    scene_.measure.resize(2);
    scene_.measure[0].name = "first";
    scene_.measure[1].name = "second";
  }

  static Simulation of_a_box() {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(test_support::fixed_box({-1, -1, -1}, {2, 2, 0}));
    blocks.emplace_back(
        test_support::block_of("box", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 3));
    return {std::move(blocks), {{}, {}}, test_support::same_law({1e9, 1e9, 0.5}), SimulationSettings{}};
  }

  [[nodiscard]] std::string advice() const { return accuracy_advice(scene_, simulation_, state_); }

  Scene scene_;
  AccuracyState state_;
  Simulation simulation_ = of_a_box();
};

TEST_F(AccuracySummary, TheLargestMeasureAndTheStepsAddUp) {
  scene_.analysis.automatic_step = true;
  state_.order_error = 0.002;
  state_.goals = {0.001, 0.002};
  state_.motion.error = 0.003;
  state_.motion.noise = 0.0005;
  state_.rounds = 4;
  const auto json = accuracy_summary(scene_, simulation_, state_);
  EXPECT_NEAR(json["estimate"], 0.0055, 1e-15);
  EXPECT_NEAR(json["by"]["step"], 0.0035, 1e-15);
  EXPECT_NEAR(json["measures"]["first"], 0.0045, 1e-15);
  EXPECT_EQ(json["orders"], (nlohmann::ordered_json{{"3", 1}})) << "the base does not move";
  EXPECT_EQ(json["analyses"], 4);
  EXPECT_EQ(json["skipped"], 0);
  EXPECT_EQ(json["advice"], "");
}

TEST_F(AccuracySummary, BlocksLeftAtLowOrdersAreCounted) {
  state_.orders = {{0, 1}, {1, 3}};
  EXPECT_EQ(accuracy_summary(scene_, simulation_, state_)["skipped"], 1);
  state_.orders = {{1, 3}};
  EXPECT_EQ(accuracy_summary(scene_, simulation_, state_)["skipped"], 0);
}

// Lacks of 1 and 3 J beside energies of 3 and 9 J: a quarter of each, and of both, half in the norm of the energy.
TEST_F(AccuracySummary, BlocksThatWereNotEstimatedAreTold) {
  const OrderErrors some{{{1, 3.0, 1.0}, {1, 9.0, 3.0}}, 5};
  const auto json = error_summary(simulation_, some);
  EXPECT_EQ(json["estimate"], 0.5);
  EXPECT_EQ(json["by"]["order"], 0.5);
  EXPECT_EQ(json["blocks"].size(), 2U);
  EXPECT_EQ(json["blocks"][0], (nlohmann::ordered_json{{"block", "box"}, {"order", 3}, {"estimate", 0.5}}));
  EXPECT_EQ(json["blocks_estimated"], 2);
  EXPECT_EQ(json["blocks_in_all"], 5);
  const auto none = error_summary(simulation_, {{}, 5});
  EXPECT_FALSE(none.contains("estimate")) << "nothing is known of it";
  EXPECT_TRUE(none["blocks"].empty());
  EXPECT_EQ(none["blocks_estimated"], 0);
  EXPECT_EQ(none["blocks_in_all"], 5);
}

TEST_F(AccuracySummary, ErrorsOfMeasuresAreByName) {
  nlohmann::ordered_json json;
  add_measure_errors(scene_, {{{1.0}, 0.1}, {{1.0}, 0.2}}, json);
  EXPECT_EQ(json["measures"], (nlohmann::ordered_json{{"first", 0.1}, {"second", 0.2}}));
}

TEST_F(AccuracySummary, AdviceIsAboutTheLargestPart) {
  state_.order_error = 0.005;
  state_.goals = {0.005, 0.0};
  EXPECT_THAT(advice(), IsEmpty());
  state_.order_error = state_.goals[0] = 0.02;
  EXPECT_THAT(advice(), HasSubstr("given or highest orders"));
  state_.slow_block = 1;
  EXPECT_THAT(advice(), HasSubstr("a higher order of block box (now 3) helps little"));
  state_.out_of_reach = 4e-3;
  EXPECT_THAT(advice(), HasSubstr("helps little (order 8 would leave about 0.004)"));
  state_.sub_face_error = 0.03;
  state_.goals[0] = 0.05;
  EXPECT_THAT(advice(), HasSubstr("contact.chord_tolerance"));
  state_.motion.error = 0.1;
  EXPECT_THAT(advice(), HasSubstr("time_step"));
  state_.motion.bounding = {{1}, 3.0};
  EXPECT_THAT(advice(), HasSubstr("the step is bounded by block box, others would allow 3 times the step"));
}

}  // namespace
}  // namespace ashlar::error_summary_test
