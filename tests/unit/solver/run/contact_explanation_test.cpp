// Contacts of two blocks with the stage that found each and the one that left it out.
#include "solver/run/contact_explanation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "solver/run/simulation.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::contact_explanation_test {
namespace {

using test_support::block_of;
using test_support::run_until;
using test_support::same_law;

const Material rock{2500.0, 1e10, 0.2};

/// @param speed m/s along x, of blocks that are not fixed
Simulation boxes(const std::vector<std::pair<Vector3, Vector3>>& corners, const std::vector<bool>& fixed,
                 double speed, const std::vector<TieRequest>& ties = {}, std::vector<bool> absent = {}) {
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    BlockDefinition block =
        block_of("block", Polyhedron(make_box(corners[k].first, corners[k].second)), rock, 1);
    block.fixed = fixed[k];
    blocks.emplace_back(std::move(block));
    motions.emplace_back();
    if (!fixed[k]) motions.back().velocity = {speed, 0, 0};
  }
  SimulationSettings settings;
  settings.time_step = 1e-3;
  return {std::move(blocks), motions, same_law({1e9, 1e9, 0.0, 0.0, 0.0, true}),
          settings,          ties,    std::move(absent)};
}

std::size_t count(const ContactExplanation& explanation, std::optional<ContactStage> removed) {
  return static_cast<std::size_t>(
      std::count_if(explanation.contacts.begin(), explanation.contacts.end(),
                    [&](const ExplainedContact& one) { return one.removed == removed; }));
}

TEST(ContactExplanation, ACubeOnASlabHasOneContact) {
  const Simulation simulation =
      boxes({{{-1, -1, -1}, {2, 2, 0}}, {{0, 0, 0}, {1, 1, 1}}}, {true, false}, 0.0);
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 0)}) {
    const ContactExplanation explanation = simulation.explain_contacts(a, b);
    EXPECT_EQ(explanation.blocks, (PairKey{0, 1}));
    EXPECT_EQ(explanation.search, PairSearch::searched);
    // Contact distance, and half of g dt^2 that gravity moves a block at rest by.
    EXPECT_NEAR(explanation.reach, 1e-3 + 0.5 * 9.81 * 1e-6, 1e-12);
    EXPECT_EQ(explanation.type, ContactType::face_face);
    double area = 0.0;
    for (const ExplainedContact& contact : explanation.contacts) {
      if (contact.removed) continue;
      EXPECT_EQ(contact.features, ContactFeatures::faces);
      EXPECT_NEAR(contact.gap, 0.0, 1e-15);
      // Out of the second block, which is the cube.
      EXPECT_NEAR((contact.normal + Vector3::UnitZ()).norm(), 0.0, 1e-15);
      EXPECT_NEAR(contact.place.z(), 0.0, 1e-15);
      area += contact.area;
    }
    EXPECT_NEAR(area, 1.0, 1e-12);
  }
}

TEST(ContactExplanation, TheSideOfTheNextSlabIsAnInternalEdge) {
  // The cube has sunk by its weight, and its front comes to the side of the next slab at x = 1 after 0.1 s.
  Simulation simulation =
      boxes({{{-1, -1, -1}, {1, 1, 0}}, {{1, -1, -1}, {3, 1, 0}}, {{-0.5, -0.5, 0}, {0.5, 0.5, 1}}},
            {true, true, false}, 5.0);
  ASSERT_TRUE(run_until(simulation, 0.0995));
  const ContactExplanation explanation = simulation.explain_contacts(1, 2);
  ASSERT_GT(count(explanation, ContactStage::internal_edge), 0U);
  for (const ExplainedContact& contact : explanation.contacts) {
    if (contact.removed != ContactStage::internal_edge) continue;
    EXPECT_GT(std::abs(contact.normal.x()), 0.9) << "only the side is left out";
    // On the front of the cube, which has gone 0.4975 m.
    EXPECT_NEAR(contact.place.x(), 0.9975, 1e-6);
    EXPECT_NEAR(contact.gap, 1.0 - 0.9975, 1e-6);
  }
  // The slab that it lies on holds it.
  EXPECT_GT(count(simulation.explain_contacts(0, 2), std::nullopt), 0U);
}

TEST(ContactExplanation, AnOverlapAsThinAsRoundingHasNoArea) {
  // The cube stands beside the slab, except for a face overlap of 4e-16 m.
  const Simulation simulation =
      boxes({{{-1, 0, -1}, {4e-16, 1, 0}}, {{0, 0, 0}, {1, 1, 1}}}, {true, false}, 0.0);
  const ContactExplanation explanation = simulation.explain_contacts(0, 1);
  EXPECT_GT(count(explanation, ContactStage::area), 0U);
  for (const ExplainedContact& contact : explanation.contacts) {
    if (contact.removed != ContactStage::area) continue;
    EXPECT_EQ(contact.features, ContactFeatures::faces);
    EXPECT_NEAR(contact.area, 0.0, 1e-15);
  }
}

TEST(ContactExplanation, SaysWhyAPairIsNotSearched) {
  const std::vector<std::pair<Vector3, Vector3>> corners = {
      {{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{0, 0, 1}, {1, 1, 2}}, {{50, 0, 0}, {51, 1, 1}}};
  const Simulation simulation = boxes(corners, {true, true, false, false}, 0.0, {{0, 2, 1e12}});
  EXPECT_EQ(simulation.explain_contacts(0, 1).search, PairSearch::both_held);
  EXPECT_EQ(simulation.explain_contacts(0, 2).search, PairSearch::tied);
  EXPECT_EQ(simulation.explain_contacts(3, 0).search, PairSearch::far_apart);
  const Simulation without = boxes(corners, {true, true, false, false}, 0.0, {}, {false, false, true, false});
  EXPECT_EQ(without.explain_contacts(0, 2).search, PairSearch::absent);
  EXPECT_THROW((void)simulation.explain_contacts(1, 1), std::invalid_argument);
  EXPECT_THROW((void)simulation.explain_contacts(0, 4), std::invalid_argument);
  EXPECT_THROW((void)simulation.explain_contacts(-1, 0), std::invalid_argument);
}

TEST(ContactExplanation, ReachGrowsWithTheMotionOfBothBlocks) {
  const Simulation simulation =
      boxes({{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 1.002}, {1, 1, 2.002}}}, {false, false}, 1.0);
  const ContactExplanation explanation = simulation.explain_contacts(0, 1);
  EXPECT_EQ(explanation.search, PairSearch::searched);
  // Both may move 1 mm in the step, towards each other for all that is known.
  EXPECT_NEAR(explanation.reach, 1e-3 + 2.0 * (1e-3 + 0.5 * 9.81e-6), 1e-8);
  ASSERT_FALSE(explanation.contacts.empty());
  for (const ExplainedContact& contact : explanation.contacts) EXPECT_NEAR(contact.gap, 2e-3, 1e-12);
}

TEST(ContactExplanation, SupportsThatMoveTakePartInTheReach) {
  // The floor is driven up by 5 m/s, 5 mm in the step, to a cube 4 mm above it.
  BlockDefinition floor = block_of("floor", Polyhedron(make_box({-1, -1, -1}, {2, 2, 0})), rock, 1);
  const SupportHistory history{{0.0, 10.0}, {Vector3::Zero(), {0, 0, 50}}};
  for (const double z : {-1.0, 0.0})
    floor.supports.push_back(
        {Plane{{0, 0, z}, z < 0.0 ? Vector3(-Vector3::UnitZ()) : Vector3(Vector3::UnitZ())},
         {true, true, true},
         history});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(floor));
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({0, 0, 4e-3}, {1, 1, 1})), rock, 1));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  const Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e9, 1e9, 0.0, 0.0, 0.0, true}),
                              settings);
  const ContactExplanation explanation = simulation.explain_contacts(0, 1);
  EXPECT_EQ(explanation.search, PairSearch::searched);
  EXPECT_GE(explanation.reach, 1e-3 + 5e-3);
  EXPECT_GT(count(explanation, std::nullopt), 0U);
}

TEST(ContactExplanation, BlocksWhoseBoxesMeetMayBeApart) {
  // A plate at 45 degrees, and a cube in the corner below it; boxes lie along the ground, the largest face.
  std::vector<BlockModel> blocks;
  const std::vector<Polyhedron> solids = {Polyhedron(make_box({-50, -50, -60}, {50, 50, -50})),
                                          test_support::tilted_box({0, 0, 0}, {4, 1, 0.1}, 45.0),
                                          Polyhedron(make_box({2.2, 0, 0}, {2.7, 1, 0.5}))};
  for (std::size_t k = 0; k < solids.size(); ++k) {
    BlockDefinition block = block_of("block", solids[k], rock, 1);
    block.fixed = k == 0;
    blocks.emplace_back(std::move(block));
  }
  SimulationSettings settings;
  settings.time_step = 1e-3;
  const Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law({1e9, 1e9, 0.0, 0.0, 0.0, true}),
                              settings);
  const ContactExplanation explanation = simulation.explain_contacts(1, 2);
  EXPECT_EQ(explanation.search, PairSearch::searched);
  EXPECT_TRUE(explanation.contacts.empty());
  // From the upper edge of the cube at (2.2, 0.5) to the plane x = z.
  ASSERT_TRUE(explanation.clearance);
  EXPECT_GT(*explanation.clearance, explanation.reach);
  EXPECT_LE(*explanation.clearance, (2.2 - 0.5) / std::sqrt(2.0) + 1e-12);
}

TEST(ContactExplanation, ChangesNothingOfTheRun) {
  Simulation simulation = boxes({{{-1, -1, -1}, {2, 2, 0}}, {{0, 0, 0}, {1, 1, 1}}}, {true, false}, 1.0);
  ASSERT_TRUE(run_until(simulation, 0.01));
  const std::string before = to_bytes(simulation.snapshot());
  (void)simulation.explain_contacts(0, 1);
  EXPECT_EQ(to_bytes(simulation.snapshot()), before);
}

}  // namespace
}  // namespace ashlar::contact_explanation_test
