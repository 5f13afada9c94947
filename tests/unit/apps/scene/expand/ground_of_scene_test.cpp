#include "apps/scene/expand/ground_of_scene.hpp"

#include <gmock/gmock.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::test::ground_of_scene_test {
namespace {

using ::testing::ElementsAre;

TEST(GroundOfScene, BlocksAreFixedOrAbsentAsInTheScene) {
  Scene scene;
  scene.block.resize(2);
  scene.block[0].fixed = true;
  const std::vector<Polyhedron> solids(2, Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  const std::vector<GroundBlock> all = ground_blocks_of(scene, solids);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].solid, &solids[1]);
  EXPECT_TRUE(all[0].fixed);
  EXPECT_FALSE(all[1].fixed);
  EXPECT_TRUE(all[0].present && all[1].present);
  scene.absent = {false, true};
  const std::vector<GroundBlock> some =
      ground_blocks_of(scene, std::vector<const Polyhedron*>{nullptr, &solids[1]});
  EXPECT_EQ(some[0].solid, nullptr);
  EXPECT_TRUE(some[0].present);
  EXPECT_FALSE(some[1].present);
}

TEST(GroundOfScene, BoundariesKeepTheirNumbersPlanesAndWaves) {
  Scene scene;
  scene.boundary.resize(2);
  scene.boundary[0].plane = {{0, 0, 1}, {0, 0, -2}};
  scene.boundary[0].wave = {{0.0, {1, 2, 3}}, {0.5, {4, 5, 6}}};
  scene.boundary[1].kind = SceneBoundary::Kind::free_field;
  const std::vector<GroundBoundary> boundaries = ground_boundaries_of(scene);
  ASSERT_EQ(boundaries.size(), 2U);
  EXPECT_EQ(boundaries[0].kind, GroundBoundary::Kind::quiet);
  EXPECT_EQ(boundaries[0].plane.point, Vector3(0, 0, 1));
  EXPECT_EQ(boundaries[0].plane.normal, Vector3(0, 0, -2));
  EXPECT_THAT(boundaries[0].wave.times, ElementsAre(0.0, 0.5));
  EXPECT_THAT(boundaries[0].wave.velocity, ElementsAre(Vector3(1, 2, 3), Vector3(4, 5, 6)));
  EXPECT_EQ(boundaries[1].kind, GroundBoundary::Kind::free_field);
  EXPECT_TRUE(boundaries[1].wave.empty());
}

TEST(GroundOfScene, FaultsOfLayersAreSaidInWords) {
  using Kind = SideLayersFault::Kind;
  EXPECT_EQ(words_of({Kind::no_face}), "no block is beside it");
  EXPECT_EQ(words_of({Kind::above_base, 1.25}), "its faces begin 1.25 m above the base");
  EXPECT_EQ(words_of({Kind::too_low, 2e-5}),
            "its faces are lower than 2e-05 m, to which the largest block beside it is known");
  EXPECT_EQ(words_of({Kind::gap, 1.0, 1.5}), "no face is between 1 m and 1.5 m above the base");
}

}  // namespace
}  // namespace ashlar::test::ground_of_scene_test
