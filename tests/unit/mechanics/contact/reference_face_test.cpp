#include "mechanics/contact/reference_face.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <utility>

#include "geometry/solid/shapes.hpp"
#include "support/simulations.hpp"

namespace ashlar::reference_face_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::tilted_box;

/// A block where it was made.
struct Body {
  BlockModel model;
  BlockState state = model.initial_state();
  SubFaceSurface surface = whole_surface(model.solid());
  PlacedSurface placed{surface, surface.points};

  explicit Body(BlockDefinition definition) : model(std::move(definition)) {}
  explicit Body(Polyhedron solid) : Body(block_of("block", std::move(solid), {2500, 1e9, 0.2}, 1)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  [[nodiscard]] ContactBody contact() const { return {&model, &state, &placed}; }
};

/// Nothing is behind rims.
bool nothing(const RimPlace&) {
  return false;
}

/// Reference faces of all overlaps of two blocks, the same with the blocks swapped.
std::vector<bool> references_on_a(const Body& a, const Body& b) {
  const ContactLimits limits{0.1, 0.1, 10.0 * std::numbers::pi / 180.0};
  const std::vector<CellOverlap> overlaps = find_contacts(a.placed, b.placed, limits).overlaps;
  EXPECT_FALSE(overlaps.empty());
  std::vector<bool> result = reference_is_on_a(a.contact(), b.contact(), overlaps, nothing);
  std::vector<bool> swapped = reference_is_on_a(b.contact(), a.contact(),
                                                find_contacts(b.placed, a.placed, limits).overlaps, nothing);
  swapped.flip();
  EXPECT_EQ(swapped, result);
  return result;
}

/// Rises by 5 degrees from its edge at x = 0, z = 0, which lies along y. 1.6 m^3.
Polyhedron rising_block(double low_y = -0.4, double high_y = 0.4) {
  return tilted_box({0, low_y, 0}, {1, high_y, 2}, 5.0);
}

TEST(ContactMaster, BelongsToTheFaceThatARimIsOn) {
  // The edge of the larger block stands on the smaller one's face.
  EXPECT_EQ(references_on_a(Body(rising_block()), Body(Polyhedron(make_box({-1, -1, -0.1}, {2, 1, 0})))),
            std::vector{false});
  // The face of the larger one lies on the edge of a smaller one, of an equal one, and of a fixed one.
  for (const double bottom : {-0.1, -0.4, -3.0}) {
    const Body support(Polyhedron(make_box({0.3, -1, bottom}, {2, 1, 0.02})));
    EXPECT_EQ(references_on_a(Body(rising_block()), support), std::vector{true}) << bottom;
  }
  EXPECT_EQ(references_on_a(Body(rising_block()), Body(fixed_box({0.3, -1, -3}, {2, 1, 0.02}))),
            std::vector{true});
}

TEST(ContactMaster, IsTheFixedOrLargerOneWhereRimsDoNotTell) {
  const double level = 0.0;
  for (const double degrees : {level, 5.0}) {
    // Parallel, and with both rims on each other; narrower in y so that only those matter.
    const double start = degrees == level ? -1.0 : 0.0;
    const Body rising(tilted_box({0, -0.4, 0}, {1, 0.4, 2}, degrees));
    EXPECT_EQ(references_on_a(rising, Body(fixed_box({start, -1, -0.1}, {2, 1, 0}))), std::vector{false});
    EXPECT_EQ(references_on_a(rising, Body(Polyhedron(make_box({start, -1, -0.1}, {2, 1, 0})))),
              std::vector{true});
    EXPECT_EQ(references_on_a(rising, Body(Polyhedron(make_box({start, -1, -3}, {2, 1, 0})))),
              std::vector{false});
  }
}

/// Turned about the x axis.
Polyhedron rolled(const Polyhedron& solid, double degrees) {
  return test_support::turned(solid, Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3::UnitX()));
}

TEST(ContactMaster, IsNotChosenBySidesBesideARimThatGoesOn) {
  // The face lies on the support's edge at x = 0.3, behind which another block goes on. Its own rims at both
  // ends of that edge, of which the roll makes one a little lower, are no ends of the two faces instead.
  const Body support(Polyhedron(make_box({0.3, -1, -0.1}, {2, 1, 0.02})));
  for (const double roll : {-0.5, 0.0, 0.5}) {
    const Body rising(rolled(rising_block(), roll));
    const ContactLimits limits{0.1, 0.1, 10.0 * std::numbers::pi / 180.0};
    const std::vector<CellOverlap> overlaps = find_contacts(rising.placed, support.placed, limits).overlaps;
    const auto behind_support = [](const RimPlace& rim) { return !rim.of_a; };
    // The larger one.
    EXPECT_EQ(reference_is_on_a(rising.contact(), support.contact(), overlaps, behind_support),
              std::vector{true})
        << roll;
  }
}

TEST(ContactMaster, IsNotChosenByTheCornerWhereTwoRimsCross) {
  // A plank across a beam, its low edge down and its far end a little lower than the near one: the deepest
  // corner is where the edge of the plank leaves the beam.
  for (const double roll : {-0.5, 0.0, 0.5}) {
    EXPECT_EQ(references_on_a(Body(rolled(rising_block(-2, 2), roll)),
                              Body(Polyhedron(make_box({-1, -0.5, -0.2}, {2, 0.5, 0})))),
              std::vector{false})
        << roll;
  }
}

TEST(ContactMaster, EndsOfFacesCountWhereTheSurfaceTurnsAway) {
  // A roof with its ridge below the rising face at x = 0.3; its left flank falls by 2 or 8 degrees. With 2
  // the flank is nearer to the face than the ridge, and the block's edge stands on it.
  const double ridge = 0.3 * std::tan(5.0 * std::numbers::pi / 180.0);
  for (const double fall : {2.0, 8.0}) {
    const double low = ridge - 1.3 * std::tan(fall * std::numbers::pi / 180.0);
    std::vector<Vector3> points;
    for (const double y : {-1.0, 1.0}) {
      for (const auto& [x, z] : {std::pair{-1.0, -1.0}, {2.0, -1.0}, {2.0, ridge}, {0.3, ridge}, {-1.0, low}})
        points.emplace_back(x, y, z);
    }
    const Body roof(Polyhedron(make_convex_hull(points)));
    const Body rising(rising_block());
    const ContactLimits limits{0.1, 0.1, 20.0 * std::numbers::pi / 180.0};
    const std::vector<CellOverlap> overlaps = find_contacts(rising.placed, roof.placed, limits).overlaps;
    ASSERT_EQ(overlaps.size(), 2U);
    const std::vector<bool> result = reference_is_on_a(rising.contact(), roof.contact(), overlaps, nothing);
    for (std::size_t k = 0; k < 2; ++k) {
      // The roof is larger.
      EXPECT_EQ(result[k], fall == 8.0) << fall << " " << overlaps[k].cell_b;
    }
  }
}

TEST(ContactMaster, OfEqualBlocksIsWhatIsSaid) {
  const Body a(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  const Body b(Polyhedron(make_box({0.25, 0, 1}, {1.25, 1, 2})));
  const Body larger(Polyhedron(make_box({0, 0, 1}, {1, 1, 3})));
  const ContactLimits limits{0.1, 0.1, 10.0 * std::numbers::pi / 180.0};
  const std::vector<CellOverlap> equal = find_contacts(a.placed, b.placed, limits).overlaps;
  const std::vector<CellOverlap> unequal = find_contacts(a.placed, larger.placed, limits).overlaps;
  for (const bool said : {false, true}) {
    EXPECT_EQ(reference_is_on_a(a.contact(), b.contact(), equal, nothing, said), std::vector{said});
    EXPECT_EQ(reference_is_on_a(a.contact(), larger.contact(), unequal, nothing, said), std::vector{false});
  }
}

}  // namespace
}  // namespace ashlar::reference_face_test
