#include "geometry/subfaces/sub_face_refinement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "geometry/solid/shapes.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::sub_face_refinement_test {
namespace {

const double infinite = std::numeric_limits<double>::infinity();
const std::vector<Box> everywhere = {{Vector3::Constant(-100), Vector3::Constant(100)}};

/// A plate 4 x 2 x 0.5 bent upwards: z + bend x^2, or left flat.
Eigen::Matrix3Xd bent(const AdaptiveSurface& surface, double bend) {
  Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(surface.domain_points().size()));
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const Vector3& x = surface.domain_points()[static_cast<std::size_t>(k)];
    values.col(k) = Vector3(x.x(), x.y(), x.z() + bend * x.x() * x.x());
  }
  return values;
}

/// Every side of every cell has exactly one neighbour with the opposite direction: no cracks.
void expect_conforming(const SubFaceSurface& surface) {
  std::map<std::array<int, 2>, int> sides;
  for (const SurfaceCell& cell : surface.cells) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[{cell.corners[k], cell.corners[(k + 1) % 3]}];
  }
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({side[1], side[0]}), 1U);
  }
}

double area(const SubFaceSurface& surface) {
  double sum = 0.0;
  for (const SurfaceCell& cell : surface.cells) {
    const Vector3& a = surface.points[static_cast<std::size_t>(cell.corners[0])];
    sum += 0.5 * (surface.points[static_cast<std::size_t>(cell.corners[1])] - a)
                     .cross(surface.points[static_cast<std::size_t>(cell.corners[2])] - a)
                     .norm();
  }
  return sum;
}

double rim_length(const SubFaceSurface& surface) {
  double sum = 0.0;
  for (const SurfaceEdge& edge : surface.edges)
    sum += (surface.points[static_cast<std::size_t>(edge.ends[1])] -
            surface.points[static_cast<std::size_t>(edge.ends[0])])
               .norm();
  return sum;
}

TEST(AdaptiveSurface, FlatFacesAreNotDivided) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 3, 0);
  surface.move(bent(surface, 0.0));
  EXPECT_FALSE(surface.divide({1e-12, everywhere}));
  EXPECT_EQ(surface.surface().cells.size(), 12U);
  EXPECT_LT(surface.chord_bound(), 1e-12);
}

TEST(AdaptiveSurface, ABentPlateIsDividedToTheToleranceAndJoinedAgain) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 2, 0);
  std::size_t last = 12;
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    surface.move(bent(surface, 0.1));
    EXPECT_TRUE(surface.divide({tolerance, everywhere}));
    EXPECT_LE(surface.chord_bound(), tolerance);
    EXPECT_GT(surface.surface().cells.size(), last);
    last = surface.surface().cells.size();
    expect_conforming(surface.surface());
    EXPECT_NEAR(area(surface.surface()), 2 * (8.0 + 2.0 + 1.0), 1e-12);
    EXPECT_NEAR(rim_length(surface.surface()), 4 * (4 + 2 + 0.5), 1e-12);
    EXPECT_FALSE(surface.divide({tolerance, everywhere}));
    for (std::size_t c = 0; c < last; ++c) {
      const auto& rim = surface.surface().cells[c].rim;
      const double error =
          sampled_chord_error(surface.patch(static_cast<int>(c)), {rim[0] >= 0, rim[1] >= 0, rim[2] >= 0}, 8);
      EXPECT_LE(error, surface.cell_shapes()[c].chord_bound);
    }
  }
  // The chord error of z = bend x^2 over a length h is bend h^2 / 4: the plate is curved in x only, and the
  // number of divisions along x follows from the tolerance within the factors of bisection.
  surface.move(bent(surface, 0.0));
  EXPECT_TRUE(surface.divide({1e-3, everywhere}));
  EXPECT_EQ(surface.surface().cells.size(), 12U);
}

TEST(AdaptiveSurface, TellsTheBoundOfItsCellsInAnotherShape) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 2, 0);
  surface.move(bent(surface, 0.0));
  surface.divide({infinite, everywhere});
  const double whole = surface.chord_bound_in(bent(surface, 0.1));
  EXPECT_GE(whole, 0.371);  // faces 4 m long: bend h^2 / 4 = 0.4 upwards from a chord with a slope of 0.4
  surface.move(bent(surface, 0.1));
  surface.divide({infinite, everywhere});
  EXPECT_EQ(surface.chord_bound(), whole);
  surface.divide({1e-2, everywhere});
  EXPECT_EQ(surface.chord_bound_in(bent(surface, 0.1)), surface.chord_bound());
  EXPECT_GT(surface.chord_bound_in(bent(surface, 0.3)), 2.0 * surface.chord_bound());
}

TEST(AdaptiveSurface, StaysAsItIsUntilTheBoundHasFallenToHalf) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 2, 0);
  surface.move(bent(surface, 0.1));
  EXPECT_TRUE(surface.divide({1e-2, everywhere}));
  surface.move(bent(surface, 0.09));
  EXPECT_FALSE(surface.divide({1e-2, everywhere}));
  surface.move(bent(surface, 0.01));
  EXPECT_TRUE(surface.divide({1e-2, everywhere}));
}

TEST(AdaptiveSurface, DividesOnlyWhatIsInReach) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 2, 0);
  surface.move(bent(surface, 0.1));
  EXPECT_FALSE(surface.divide({1e-3, {}}));
  EXPECT_EQ(surface.surface().cells.size(), 12U);
  EXPECT_TRUE(surface.divide({1e-3, everywhere}));
  const std::size_t all = surface.surface().cells.size();
  const std::vector<Box> corner = {{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}};
  EXPECT_TRUE(surface.divide({1e-3, corner}));
  EXPECT_LT(surface.surface().cells.size(), all / 2);
  EXPECT_GT(surface.surface().cells.size(), 12U);
  expect_conforming(surface.surface());
  for (std::size_t c = 0; c < surface.surface().cells.size(); ++c) {
    const CellShape& shape = surface.cell_shapes()[c];
    if (shape.box.meets(corner[0])) {
      EXPECT_LE(shape.chord_bound, 1e-3);
    }
  }
}

TEST(AdaptiveSurface, ATurnedSceneIsDividedAsBeforeAlongItsOwnAxes) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  AdaptiveSurface straight(solid, 2, 0);
  AdaptiveSurface turned(solid, 2, 0, turn);
  AdaptiveSurface along_space(solid, 2, 0);
  const Eigen::Matrix3Xd values = bent(straight, 0.1);
  straight.move(values);
  turned.move(turn * values);
  along_space.move(turn * values);
  EXPECT_NEAR((turned.box().low - straight.box().low).norm(), 0.0, 1e-12);
  EXPECT_NEAR((turned.box().high - straight.box().high).norm(), 0.0, 1e-12);
  // The same numbers are another neighbour along the axes of space.
  const std::vector<Box> neighbour = {{{2.5, 0.5, -0.1}, {3.0, 1.0, 1.5}}};
  EXPECT_TRUE(straight.divide({1e-3, neighbour}));
  EXPECT_TRUE(turned.divide({1e-3, neighbour}));
  EXPECT_TRUE(along_space.divide({1e-3, neighbour}));
  EXPECT_EQ(turned.wanted(), straight.wanted());
  EXPECT_NE(along_space.wanted(), straight.wanted());
}

TEST(AdaptiveSurface, RoundingOfCornersDoesNotSayWhichSideIsLongest) {
  // Half the diagonals of a rectangle: the two long sides of a triangle are equal but for rounding.
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2.2, 1.4}));
  AdaptiveSurface straight(solid, 2, 0);
  straight.move(bent(straight, 0.1));
  EXPECT_TRUE(straight.divide({1e-3, everywhere}));
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.3 * k, Vector3(1, 2 - k, 3).normalized()).toRotationMatrix();
    std::vector<Vector3> corners;
    for (const Vector3& point : solid.mesh().points) corners.emplace_back(turn * point);
    const Polyhedron lies_elsewhere(TriangleMesh{corners, solid.mesh().triangles}, 0x1p-46);
    ASSERT_EQ(lies_elsewhere.faces().size(), 6U);
    AdaptiveSurface turned(lies_elsewhere, 2, 0, turn);
    Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(turned.domain_points().size()));
    for (Eigen::Index n = 0; n < values.cols(); ++n) {
      const Vector3 x = turn.transpose() * turned.domain_points()[static_cast<std::size_t>(n)];
      values.col(n) = turn * Vector3(x.x(), x.y(), x.z() + 0.1 * x.x() * x.x());
    }
    turned.move(values);
    EXPECT_TRUE(turned.divide({1e-3, everywhere}));
    EXPECT_EQ(turned.wanted(), straight.wanted()) << k;
    EXPECT_EQ(turned.surface().cells.size(), straight.surface().cells.size());
  }
}

TEST(AdaptiveSurface, NonConvexFacesAndUniformLevelsAreConforming) {
  const Polyhedron solid(test_support::l_shaped_prism());
  for (const int levels : {0, 1}) {
    AdaptiveSurface surface(solid, 3, levels);
    surface.move(bent(surface, 0.2));
    EXPECT_TRUE(surface.divide({1e-3, everywhere}));
    expect_conforming(surface.surface());
    EXPECT_LE(surface.chord_bound(), 1e-3);
    EXPECT_NEAR(area(surface.surface()), 2 * 3.0 + 8.0, 1e-12);
    EXPECT_NEAR(rim_length(surface.surface()), 2 * 8.0 + 6.0, 1e-12);
    surface.move(bent(surface, 0.0));
    EXPECT_TRUE(surface.divide({infinite, everywhere}));
    EXPECT_EQ(surface.surface().cells.size(), divide_surface(solid, levels).cells.size());
  }
}

void expect_same_cells(const SubFaceSurface& a, const SubFaceSurface& b) {
  EXPECT_EQ(a.points, b.points);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) EXPECT_EQ(a.cells[k].corners, b.cells[k].corners) << k;
}

// Bent less and less: the cuts that a division keeps depend on its past.
TEST(AdaptiveSurface, ADivisionThatIsTakenOverGoesOnAsItWould) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface first(solid, 2, 0);
  for (const double bow : {0.3, 0.1, 0.08}) {
    first.move(bent(first, bow));
    (void)first.divide({1e-2, everywhere});
  }
  ASSERT_GT(first.surface().cells.size(), divide_surface(solid, 0).cells.size());
  AdaptiveSurface second(solid, 2, 0);
  second.restore(AdaptiveSurface(solid, 2, 0).division());
  expect_same_cells(AdaptiveSurface(solid, 2, 0).surface(), second.surface());
  second.restore(first.division());
  expect_same_cells(first.surface(), second.surface());
  EXPECT_EQ(second.division().cuts, first.division().cuts);
  EXPECT_EQ(second.wanted(), first.wanted());
  for (const double bow : {0.08, 0.05, 0.2, 0.0}) {
    first.move(bent(first, bow));
    second.move(bent(second, bow));
    EXPECT_EQ(first.divide({1e-2, everywhere}), second.divide({1e-2, everywhere})) << bow;
    expect_same_cells(first.surface(), second.surface());
  }
}

TEST(AdaptiveSurface, ADivisionOfAnotherSurfaceIsRefused) {
  const Polyhedron solid(make_box({0, 0, 0}, {4, 2, 0.5}));
  AdaptiveSurface surface(solid, 2, 0);
  EXPECT_THROW(surface.restore({{12345}, {}}), std::invalid_argument) << "no triangle of this name";
  surface.move(bent(surface, 0.1));
  (void)surface.divide({1e-2, everywhere});
  SurfaceDivision division = surface.division();
  division.cuts.push_back(division.cuts.front());
  AdaptiveSurface other(solid, 2, 0);
  EXPECT_THROW(other.restore(division), std::invalid_argument) << "cut twice";
}

TEST(AdaptiveSurface, AToleranceBelowRoundingEndsAtTheLargestDivision) {
  const Polyhedron solid(make_box({0, 0, 0}, {1, 1, 1}));
  AdaptiveSurface surface(solid, 2, 0);
  surface.move(bent(surface, 0.1));
  EXPECT_TRUE(surface.divide({1e-18, everywhere}));
  EXPECT_LE(surface.surface().cells.size(), static_cast<std::size_t>(AdaptiveSurface::max_cells) + 64U);
  EXPECT_GT(surface.chord_bound(), 1e-18);
}

}  // namespace
}  // namespace ashlar::sub_face_refinement_test
