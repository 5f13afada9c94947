#include "apps/results/folder/stored_layout.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ashlar::stored_layout_test {

struct One {
  int number = 0;
};
struct Two {
  int number = 0;
  double size = 0.0;
};
struct TwoTurned {
  double size = 0.0;
  int number = 0;
};
struct Nested {
  One one;
  double size = 0.0;
};
struct OfList {
  std::vector<One> list;
};
struct OfLongerList {
  std::vector<Two> list;
};
struct OfShared {
  std::shared_ptr<const One> shared;
};
struct OfOptional {
  std::optional<One> optional;
};
/// The same as One but for its names.
struct OtherNames {
  int size = 0;
};

namespace {

TEST(StoredLayout, IsAnotherOneForEachListOfMembers) {
  const std::vector<std::uint64_t> layouts = {stored_layout<One>(),
                                              stored_layout<Two>(),
                                              stored_layout<TwoTurned>(),
                                              stored_layout<Nested>(),
                                              stored_layout<OfList>(),
                                              stored_layout<OfLongerList>(),
                                              stored_layout<OfShared>(),
                                              stored_layout<OfOptional>(),
                                              stored_layout<std::array<int, 2>>(),
                                              stored_layout<std::array<int, 3>>()};
  EXPECT_EQ(std::set(layouts.begin(), layouts.end()).size(), layouts.size());
}

TEST(StoredLayout, IsTheSameForTheSameMembersAndVersion) {
  EXPECT_EQ(stored_layout<One>(), stored_layout<OtherNames>());
  EXPECT_EQ(stored_layout<Two>(3), stored_layout<Two>(3));
  EXPECT_NE(stored_layout<Two>(3), stored_layout<Two>(4));
}

// The present contents of a container are no part of it.
TEST(StoredLayout, DoesNotDependOnValues) {
  OfList filled{{{1}, {2}}};
  StoredLayout layout(0);
  layout(filled);
  EXPECT_EQ(layout.hash(), stored_layout<OfList>());
}

}  // namespace
}  // namespace ashlar::stored_layout_test
