#include "solver/system/address_space.hpp"

#include <gtest/gtest.h>

namespace ashlar::address_space_test {
namespace {

TEST(AddressSpace, HasRoomForLittleAndNotForAllThereIs) {
  EXPECT_TRUE(has_room_for(std::size_t{1} << 20U));
  EXPECT_FALSE(has_room_for(std::size_t{1} << 60U));
}

}  // namespace
}  // namespace ashlar::address_space_test
