#include "solver/struct_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/run/checkpoint.hpp"
#include "support/stored_numbers.hpp"

namespace ashlar::struct_members_test {

struct OfOneArray {
  std::array<int, 3> numbers;
};
struct OfAllKinds {
  int number = 0;
  std::optional<OfOneArray> optional;
  std::vector<double> list = {};
  Eigen::Vector3d fixed;
  Eigen::MatrixX3d dynamic;
  std::map<int, double> map;
  std::string text;
  std::shared_ptr<const OfOneArray> shared;
  std::array<Eigen::Vector2d, 2> array;
};
static_assert(count_members<OfOneArray>() == 1);
static_assert(count_members<OfAllKinds>() == 9);

namespace {

TEST(StructMembers, AreVisitedInTheirOrder) {
  const Rejection rejection{1.5, 2.5, RejectionReason::too_deep};
  int visits = 0;
  with_members(rejection, [&](const double& time, const double& step, const RejectionReason& reason) {
    ++visits;
    EXPECT_EQ(&time, &rejection.time);
    EXPECT_EQ(&step, &rejection.step);
    EXPECT_EQ(&reason, &rejection.reason);
  });
  EXPECT_EQ(visits, 1);
}

/// Another value of a number.
void change(test_support::StoredNumbers::Bytes number) {
  // 0 and 1 change places, as a bool's do.
  number[0] ^= std::byte{1};
}

std::string all_numbers(SimulationSnapshot& snapshot) {
  std::string sum;
  const test_support::StoredNumbers stored(snapshot);
  for (const auto number : stored.numbers())
    sum.append(reinterpret_cast<const char*>(number.data()), number.size());
  return sum;
}

// A snapshot that has one of everything, in which one number after the other is another one.
TEST(StructMembers, EachNumberOfASnapshotIsStored) {
  SimulationSnapshot snapshot;
  const test_support::StoredNumbers stored(snapshot);
  SimulationSnapshot before = snapshot_from_bytes(to_bytes(snapshot));
  const std::string numbers_before = all_numbers(before);
  for (std::size_t n = 0; n < stored.numbers().size(); ++n) {
    change(stored.numbers()[n]);
    SimulationSnapshot back = snapshot_from_bytes(to_bytes(snapshot));
    const std::string numbers = all_numbers(back);
    ASSERT_EQ(numbers.size(), numbers_before.size());
    std::size_t changed = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) changed += numbers[k] != numbers_before[k] ? 1 : 0;
    ASSERT_EQ(changed, 1U) << "number " << n;
    change(stored.numbers()[n]);
  }
}

/// A law of which no member has its default.
JointLaw unusual_law() {
  return {1.0,
          2.0,
          0.3,
          4.0,
          5.0,
          false,
          Transmission::springs,
          6e-9,
          true,
          0.2,
          0.7,
          ResidualStrength{0.1, 3.0, 2.5},
          {8.0, 9.0},
          0.4,
          1e6,
          1e-3,
          {11.0, 2e7, 0.5, 0.8, 3e-3}};
}

// Contacts last only as long as their law is the same.
TEST(StructMembers, TheLawOfContactsThatLastComesBackAsItWas) {
  SimulationSnapshot snapshot;
  auto cache = std::make_shared<ContactCache>();
  cache->law = unusual_law();
  snapshot.run.pairs[{0, 1}].cache = cache;
  const SimulationSnapshot back = snapshot_from_bytes(to_bytes(snapshot));
  EXPECT_TRUE(back.run.pairs.at({0, 1}).cache->law == unusual_law());
}

TEST(StructMembers, ResponsesOfContactPointsComeBackAsTheyWere) {
  const PointResponse response{ContactState::sliding,
                               Eigen::Vector3d(1, 2, 3),
                               Eigen::Matrix3d::Constant(4),
                               5.0,
                               6.0,
                               Eigen::Vector2d(0.6, 0.8),
                               {Eigen::Vector3d(7, 8, 9), Eigen::Vector3d(10, 11, 12)},
                               13.0,
                               14.0,
                               Eigen::Vector2d(15, 16)};
  SimulationSnapshot snapshot;
  snapshot.run.records = {{0, 1, {}, {response}, {17.0}, 18.0}};
  const SimulationSnapshot snapshot_back = snapshot_from_bytes(to_bytes(snapshot));
  const PointResponse& back = snapshot_back.run.records.at(0).responses.at(0);
  EXPECT_EQ(back.state, ContactState::sliding);
  EXPECT_EQ(back.force, response.force);
  EXPECT_EQ(back.tangent, response.tangent);
  EXPECT_EQ(back.energy(), 11.0);
  EXPECT_EQ(back.direction, response.direction);
  EXPECT_EQ(back.coupling.force, response.coupling.force);
  EXPECT_EQ(back.coupling.by, response.coupling.by);
  EXPECT_EQ(back.dilation, 13.0);
  EXPECT_EQ(back.damped, 14.0);
  EXPECT_EQ(back.shear_damped, response.shear_damped);
}

}  // namespace
}  // namespace ashlar::struct_members_test
