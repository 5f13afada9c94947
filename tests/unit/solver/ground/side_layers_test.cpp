#include "solver/ground/side_layers.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::side_layers_test {
namespace {

const Plane side{{6, 0, 0}, Vector3::UnitX()};
const Plane base{{0, 0, 0}, -Vector3::UnitZ()};

/// A box that ends at the side.
Polyhedron box_between(double bottom, double top, double front = 0.0, double back = 2.0) {
  return Polyhedron(make_box({0, front, bottom}, {6, back, top}));
}

TEST(SideLayers, TheyAreThoseOfTheBlocksBesideThem) {
  const Polyhedron rock = box_between(0, 4), soil = box_between(4, 10);
  const SideLayers found = layers_beside(side, base, {{&soil}, {&rock}});
  EXPECT_FALSE(found.fault);
  ASSERT_EQ(found.layers.size(), 2U);
  EXPECT_EQ(found.layers[0].block, 1U);
  EXPECT_NEAR(found.layers[0].bottom, 0.0, 1e-12);
  EXPECT_NEAR(found.layers[0].top, 4.0, 1e-12);
  EXPECT_EQ(found.layers[1].block, 0U);
  EXPECT_NEAR(found.layers[1].top, 10.0, 1e-12);
}

// From 0 to 2 m the block behind is wider, from 2 to 3 m there is the one in front alone.
TEST(SideLayers, TheLargestFaceAtAHeightCounts) {
  const Polyhedron front = box_between(0, 3, 0, 1), back = box_between(0, 2, 1, 9);
  const SideLayers found = layers_beside(side, base, {{&front}, {&back}});
  ASSERT_EQ(found.layers.size(), 2U);
  EXPECT_EQ(found.layers[0].block, 1U);
  EXPECT_NEAR(found.layers[0].top, 2.0, 1e-12);
  EXPECT_EQ(found.layers[1].block, 0U);
}

TEST(SideLayers, FixedAbsentAndUnknownBlocksHaveNone) {
  const Polyhedron rock = box_between(0, 4);
  const SideLayers found = layers_beside(side, base, {{&rock, true, true}, {&rock, false, false}, {nullptr}});
  ASSERT_TRUE(found.fault);
  EXPECT_EQ(found.fault->kind, SideLayersFault::Kind::no_face);
  EXPECT_TRUE(found.layers.empty());
}

TEST(SideLayers, FacesElsewhereAreNotBeside) {
  const Polyhedron rock = box_between(0, 4);
  for (const Plane& elsewhere : {Plane{{7, 0, 0}, Vector3::UnitX()}, Plane{{6, 0, 0}, -Vector3::UnitX()}}) {
    const SideLayers found = layers_beside(elsewhere, base, {{&rock}});
    ASSERT_TRUE(found.fault);
    EXPECT_EQ(found.fault->kind, SideLayersFault::Kind::no_face);
  }
}

TEST(SideLayers, TheyBeginAtTheBase) {
  const Polyhedron rock = box_between(1, 4);
  const SideLayers found = layers_beside(side, base, {{&rock}});
  ASSERT_TRUE(found.fault);
  EXPECT_EQ(found.fault->kind, SideLayersFault::Kind::above_base);
  EXPECT_NEAR(found.fault->bottom, 1.0, 1e-12);
}

TEST(SideLayers, TheyHaveNoGaps) {
  const Polyhedron rock = box_between(0, 1), soil = box_between(1.5, 4);
  const SideLayers found = layers_beside(side, base, {{&rock}, {&soil}});
  ASSERT_TRUE(found.fault);
  EXPECT_EQ(found.fault->kind, SideLayersFault::Kind::gap);
  EXPECT_NEAR(found.fault->bottom, 1.0, 1e-12);
  EXPECT_NEAR(found.fault->top, 1.5, 1e-12);
  EXPECT_TRUE(found.layers.empty());
}

}  // namespace
}  // namespace ashlar::side_layers_test
