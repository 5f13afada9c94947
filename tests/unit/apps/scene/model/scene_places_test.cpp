#include "apps/scene/model/scene_places.hpp"

#include <gtest/gtest.h>

namespace ashlar::test::scene_places_test {
namespace {

TEST(ScenePlaces, FallsBackToTheInnermostTableGiven) {
  const Place start{"s.toml", 1, 1}, header{"s.toml", 5, 1}, key{"s.toml", 6, 1}, value{"s.toml", 6, 9};
  ScenePlaces places;
  places.record("", {start, start});
  places.record("block.0", {header, header});
  places.record("block.0.order", {key, value});
  EXPECT_EQ(places.key("block.0.order"), key);
  EXPECT_EQ(places.value("block.0.order"), value);
  EXPECT_EQ(places.value("block.0.fix.3.plane"), header);
  EXPECT_EQ(places.value("block.00"), start);
  EXPECT_EQ(places.key("analysis"), start);
  EXPECT_TRUE(places.contains("block.0.order"));
  EXPECT_FALSE(places.contains("block.0.fix"));
}

}  // namespace
}  // namespace ashlar::test::scene_places_test
