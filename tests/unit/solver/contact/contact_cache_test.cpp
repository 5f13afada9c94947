#include "solver/contact/contact_cache.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::contact_cache_test {
namespace {

using test_support::block_of;

const Material rock{2500.0, 1e10, 0.2};
constexpr double limit = 1e-6;  // m, of the tests of pairs

/// Two unit cubes, b below a, whose contacts were found where they are: one point in the middle, closed by 1e-7 m.
class TwoCubes : public ::testing::Test {
 protected:
  TwoCubes()
      : above_(block_of("above", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), rock, 1)),
        below_(block_of("below", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1)),
        of_a_(above_.initial_state()),
        of_b_(below_.initial_state()) {
    ContactCache found;
    found.positions = {of_a_.position, of_b_.position};
    found.reach = 1e-3;
    found.law.normal_stiffness = 1e9;
    found.found.points = {test_support::level_point({0.5, 0.5, 1.0}, -1e-7)};
    found.rows = PairRows::values_of(above_, below_, found.found.points);
    lasting_ = std::make_shared<const ContactCache>(std::move(found));
  }

  static void move(const BlockModel& model, BlockState& state, const Vector3& by,
                   const Eigen::Matrix3d& gradient = Eigen::Matrix3d::Zero()) {
    state.position += model.basis().linear_field(by - gradient * model.basis().centroid(), gradient);
  }

  [[nodiscard]] std::optional<KeptContacts> kept(double reach = 1e-3) const {
    const auto bound_of = [](const BlockModel& model) {
      return [surface = std::make_shared<BlockSurface>(model, 0, Eigen::Matrix3d::Identity())](
                 const Eigen::MatrixX3d& change) { return surface->quick_motion_bound(change); };
    };
    return kept_contacts(lasting_, {&above_, &of_a_, nullptr}, {&below_, &of_b_, nullptr}, law_,
                         {limit, reach}, {bound_of(above_), bound_of(below_)});
  }

  BlockModel above_;
  BlockModel below_;
  BlockState of_a_;
  BlockState of_b_;
  JointLaw law_{1e9};
  std::shared_ptr<const ContactCache> lasting_;
};

TEST_F(TwoCubes, AGapFollowsTheMotionAlongTheNormal) {
  move(above_, of_a_, {2e-8, 0, 3e-8});
  move(below_, of_b_, {0, 0, -1e-8});
  const auto now = kept();
  ASSERT_TRUE(now);
  // -1e-7 + 3e-8 + 1e-8; motion along the surface has no effect.
  EXPECT_NEAR(now->points[0].gap, -6e-8, 1e-15);
  EXPECT_NEAR(now->points[0].place_a.x(), 0.5 + 2e-8, 1e-15);
}

TEST_F(TwoCubes, LastWhileBothMoveAlike) {
  for (BlockState* state : {&of_a_, &of_b_}) move(state == &of_a_ ? above_ : below_, *state, {3, -2, 1});
  const auto now = kept();
  ASSERT_TRUE(now);
  EXPECT_NEAR((now->shift - Vector3(3, -2, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(now->points[0].gap, -1e-7, 1e-14);
}

TEST_F(TwoCubes, ShiftByTheMeanOfBothWhicheverIsFirst) {
  move(above_, of_a_, {3e-8, 0, 0});
  move(below_, of_b_, {0, 1e-8, 0});
  const auto now = kept();
  ASSERT_TRUE(now);
  EXPECT_NEAR((now->shift - Vector3(1.5e-8, 0.5e-8, 0)).norm(), 0.0, 1e-15);
}

TEST_F(TwoCubes, AreFoundAnewWhereTheyMoveMoreThanTheLimit) {
  move(above_, of_a_, {1.1 * limit, 0, 0});
  EXPECT_FALSE(kept());
}

TEST_F(TwoCubes, AreFoundAnewWhereTheyTurnTogether) {
  // By 1e-5: points half a diagonal from the centroid, 0.87 m, move by more than the limit.
  Eigen::Matrix3d turn;
  turn << 0, 0, 0, 0, 0, -1e-5, 0, 1e-5, 0;
  move(above_, of_a_, Vector3::Zero(), turn);
  move(below_, of_b_, Vector3::Zero(), turn);
  EXPECT_FALSE(kept());
}

TEST_F(TwoCubes, AreFoundAnewWhereABlockIsStrained) {
  move(below_, of_b_, Vector3::Zero(), 1e-5 * Eigen::Matrix3d::Identity());
  EXPECT_FALSE(kept());
}

TEST_F(TwoCubes, AreFoundAnewForAnotherLawOrALongerReach) {
  EXPECT_TRUE(kept(1e-3 + 0.9 * limit));
  EXPECT_FALSE(kept(1e-3 + 1.1 * limit));
  law_.friction = 0.5;
  EXPECT_FALSE(kept());
}

/// Three blocks of which each meets the others, and one far from them that meets a.
struct Neighbours {
  std::vector<BlockModel> blocks;
  std::vector<BlockState> states;
};

Neighbours neighbours() {
  Neighbours scene;
  const std::vector<std::pair<Vector3, Vector3>> boxes = {
      {{0, 0, 0}, {4, 1, 1}}, {{0, 0, 1}, {1, 1, 2}}, {{1, 0, 1}, {2, 1, 2}}, {{3, 0, 1}, {4, 1, 2}}};
  for (const auto& [low, high] : boxes) {
    scene.blocks.emplace_back(
        block_of(std::string(scene.blocks.size() + 1, 'b'), Polyhedron(make_box(low, high)), rock, 1));
    scene.states.push_back(scene.blocks.back().initial_state());
  }
  return scene;
}

TEST(ContactCache, ANeighbourNearToBothIsFoundAnewWithAPair) {
  const Neighbours scene = neighbours();
  SimulationSettings settings;
  settings.contact_distance = 1e-3;
  ContactFinder finder(scene.blocks, settings);
  PairHistories histories;
  const std::vector<double> still(4, 0.0);
  const ExpectedMotion motion{still, [](int) { return 0.0; }};
  ASSERT_EQ(finder.near_pairs(scene.states, motion, histories).size(), 4U);  // 01 02 03 12
  const PairContacts some;
  KnownContacts known = {&some, nullptr, &some, &some};
  const std::vector<FoundContacts> found = finder.find(scene.states, known, histories);
  // Block 1 is near to 0 and 2: its pairs with both go with theirs. Block 3 is not near to 2.
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].blocks, (PairKey{0, 1}));
  EXPECT_EQ(found[1].blocks, (PairKey{0, 2}));
  EXPECT_EQ(found[2].blocks, (PairKey{1, 2}));
  EXPECT_EQ(known[2], &some);
}

/// A column of bricks, the last one half over the edge, that comes to rest under its weight on a slab.
/// @param share of contact_distance. @param augmented contact
Simulation column(double share, bool augmented, int threads = 1) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::fixed_box({-2, -2, -1}, {2, 2, 0}));
  for (int k = 0; k < 3; ++k) {
    const Vector3 low(k == 2 ? 0.3 : 0.0, 0.0, 0.5 * k);
    blocks.emplace_back(block_of(std::string(static_cast<std::size_t>(k) + 1, 'b'),
                                 Polyhedron(make_box(low, low + Vector3(1.0, 0.5, 0.5))), rock, 1));
  }
  SimulationSettings settings;
  settings.time_step = 1.0 / 240.0;
  settings.contact_distance = 5e-4;
  settings.augmented = augmented;
  settings.search.cache_share = share;
  settings.rest.sleeps = false;
  settings.threads = threads;
  const JointLaw law{4e11, 2e11, 0.5, 0.0, 0.0, true};
  return {std::move(blocks), std::vector<InitialMotion>(4), test_support::same_law(law), settings};
}

void take_steps(Simulation& simulation, int count) {
  for (int k = 0; k < count; ++k) ASSERT_EQ(simulation.step(100.0), StepStatus::accepted);
}

TEST(ContactCache, NothingIsFoundAnewAtRest) {
  for (const bool augmented : {false, true}) {
    Simulation simulation = column(1e-3, augmented);
    take_steps(simulation, 150);
    const SimulationCounts before = simulation.counts();
    const Ledger ledger = simulation.snapshot().run.ledger.ledger();
    take_steps(simulation, 30);
    const SimulationCounts after = simulation.counts();
    const Ledger now = simulation.snapshot().run.ledger.ledger();
    EXPECT_EQ(after.finder.block_pairs_tested, before.finder.block_pairs_tested) << augmented;
    EXPECT_GE(after.finder.block_pairs_kept, before.finder.block_pairs_kept + 90) << augmented;
    // Rounding of what springs hold.
    const double rounding = 1e-13 * now.contact;
    EXPECT_NEAR(now.redetection_gained, ledger.redetection_gained, rounding);
    EXPECT_NEAR(now.redetection_lost, ledger.redetection_lost, rounding);
  }
}

TEST(ContactCache, ComeToRestWhereContactsFoundInEachStepDo) {
  for (const bool augmented : {false, true}) {
    Simulation lasting = column(1e-3, augmented);
    Simulation anew = column(0.0, augmented);
    take_steps(lasting, 150);
    take_steps(anew, 150);
    for (std::size_t k = 1; k < 4; ++k) {
      // Far below the compression of the column, 1e-7 m; the limit of motion is 5e-7 m.
      EXPECT_LT((lasting.states()[k].position - anew.states()[k].position).norm(), 1e-9) << k << augmented;
    }
  }
}

TEST(ContactCache, ResumedRunsKeepEveryBitWhateverTheThreads) {
  for (const bool augmented : {false, true}) {
    Simulation straight = column(1e-3, augmented);
    take_steps(straight, 60);
    const std::string bytes = to_bytes(straight.snapshot());
    take_steps(straight, 40);
    Simulation resumed = column(1e-3, augmented, 2);
    resumed.restore(snapshot_from_bytes(bytes));
    EXPECT_EQ(to_bytes(resumed.snapshot()), bytes);
    take_steps(resumed, 40);
    EXPECT_EQ(resumed.counts().finder.block_pairs_kept, straight.counts().finder.block_pairs_kept);
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_EQ(resumed.states()[k].position, straight.states()[k].position) << k << augmented;
      EXPECT_EQ(resumed.states()[k].velocity, straight.states()[k].velocity) << k << augmented;
    }
  }
}

TEST(ContactCache, ContactsOfOtherBlocksAreRefused) {
  Simulation straight = column(1e-3, false);
  take_steps(straight, 60);
  SimulationSnapshot snapshot = snapshot_from_bytes(to_bytes(straight.snapshot()));
  const auto pair = snapshot.run.pairs.find({0, 1});
  ASSERT_NE(pair, snapshot.run.pairs.end());
  ASSERT_NE(pair->second.cache, nullptr);
  ContactCache wrong = *pair->second.cache;
  ASSERT_FALSE(wrong.contacts.overlaps.empty());
  wrong.contacts.overlaps[0].cell_b = 6;
  pair->second.cache = std::make_shared<const ContactCache>(std::move(wrong));
  Simulation other = column(1e-3, false);
  EXPECT_THROW(other.restore(snapshot), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::contact_cache_test
