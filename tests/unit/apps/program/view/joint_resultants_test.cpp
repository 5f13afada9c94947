#include "apps/program/view/joint_resultants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace ashlar::joint_resultants_test {
namespace {

/// Contact points with the normal z.
struct Contacts {
  UnstructuredGrid grid;
  std::vector<double> force, normal;
  std::vector<std::int32_t> state, a, b;

  void add(const Vector3& place, const Vector3& force_on_a, int state_of_point, std::array<int, 2> blocks) {
    grid.points.push_back(place);
    for (int k = 0; k < 3; ++k) {
      force.push_back(force_on_a[k]);
      normal.push_back(k == 2 ? 1.0 : 0.0);
    }
    state.push_back(state_of_point);
    a.push_back(blocks[0]);
    b.push_back(blocks[1]);
  }
  [[nodiscard]] std::vector<FrameResultant> resultants() {
    grid.point_data = {{"force", 3, {}, force},
                       {"normal", 3, {}, normal},
                       {"state", 1, {}, state},
                       {"block_a", 1, {}, a},
                       {"block_b", 1, {}, b}};
    return joint_resultants(grid);
  }
};

TEST(JointResultants, TheCentreOfCompressionIsWhereOneForceWouldAct) {
  Contacts contacts;
  // 3 N at x = 0 and 1 N at x = 4: the same moment as 4 N at x = 1. The pull at x = 8 does not move the place.
  contacts.add({0, 0, 0}, {1, 0, 3}, 2, {0, 1});
  contacts.add({4, 0, 0}, {0, 0, 1}, 1, {0, 1});
  contacts.add({8, 0, 0}, {0, 0, -0.5}, 1, {0, 1});
  const auto joints = contacts.resultants();
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].force, Vector3(1, 0, 3.5));
  EXPECT_EQ(joints[0].place, Vector3(1, 0, 0));
  EXPECT_EQ(joints[0].state, 2);  // sqrt(10) N slide, 1.5 N are locked
}

TEST(JointResultants, PairsAreInOrderAndOpenOnesLeftOut) {
  Contacts contacts;
  contacts.add({0, 0, 0}, {0, 0, 1}, 1, {2, 3});
  contacts.add({0, 0, 0}, {0, 0, 0}, 0, {0, 4});
  contacts.add({5, 0, 0}, {0, 0, 2}, 1, {0, 3});
  const auto joints = contacts.resultants();
  ASSERT_EQ(joints.size(), 2U);
  EXPECT_EQ(joints[0].a, 0);
  EXPECT_EQ(joints[0].b, 3);
  EXPECT_EQ(joints[1].a, 2);
}

TEST(JointResultants, WhatOnlyPullsActsInTheMiddleOfItsForces) {
  Contacts contacts;
  contacts.add({0, 0, 0}, {0, 0, -1}, 1, {0, 1});
  contacts.add({0, 3, 0}, {0, 0, -2}, 1, {0, 1});
  const auto joints = contacts.resultants();
  EXPECT_EQ(joints[0].place, Vector3(0, 2, 0));
  EXPECT_EQ(joints[0].force, Vector3(0, 0, -3));
}

TEST(JointResultants, NoContactsNoJoints) {
  Contacts contacts;
  EXPECT_TRUE(contacts.resultants().empty());
}

}  // namespace
}  // namespace ashlar::joint_resultants_test
