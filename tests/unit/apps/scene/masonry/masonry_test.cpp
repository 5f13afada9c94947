#include "apps/scene/masonry/masonry.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <set>

#include "apps/scene/check/initial_overlap.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::masonry_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr double degree = std::numbers::pi / 180.0;

std::string scene_text(const std::string& masonry) {
  return "analysis = { type = \"static\" }\n[[material]]\nname = \"rock\"\ndensity = 1\nyoung_modulus = 1\n"
         "poisson_ratio = 0\n[[masonry]]\nname = \"m\"\nmaterial = \"rock\"\n" +
         masonry;  // from line 10 on
}

struct Built {
  Scene scene;
  std::vector<Polyhedron> solids;

  [[nodiscard]] double volume() const {
    double sum = 0.0;
    for (const Polyhedron& solid : solids) sum += solid.volume();
    return sum;
  }
  [[nodiscard]] const SceneBox& box(std::size_t number) const {
    return std::get<SceneBox>(scene.block.at(number - 1).shape);
  }
};

// Pieces that neither overlap nor have a fault.
Built built(const std::string& masonry) {
  Diagnostics diagnostics;
  Built result{parse_scene(scene_text(masonry), "s.toml", {}, diagnostics), {}};
  const auto solids = build_solids(result.scene, diagnostics);
  check_initial_overlap(ExpandedScene(result.scene), solids, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  for (const auto& solid : solids)
    if (solid) result.solids.push_back(*solid);
  return result;
}

std::vector<std::string> faults_of(const std::string& masonry) {
  return reading_faults(scene_text(masonry));
}

const std::string wall = "kind = \"wall\"\nlength = 5\nheight = 2.5\nbrick = [0.5, 0.25, 0.25]\n";

TEST(MasonryWall, RunsInBondWithHalfBricksAtItsEnds) {
  const Built result = built(wall);
  ASSERT_THAT(result.scene.block, SizeIs(5 * 10 + 5 * 11));
  EXPECT_EQ(result.volume(), 5 * 2.5 * 0.25);
  // The first, the half one that begins the second course, and the sixth of the seventh course.
  EXPECT_EQ(result.box(1).max, Vector3(0.5, 0.25, 0.25));
  EXPECT_EQ(result.box(11).max, Vector3(0.25, 0.25, 0.5));
  EXPECT_EQ(result.box(69).min, Vector3(2.5, 0, 1.5));
  EXPECT_EQ(result.box(69).max, Vector3(3, 0.25, 1.75));
  EXPECT_EQ(result.scene.block[68].name, "m.69");
  EXPECT_EQ(result.scene.block[68].material, "rock");
}

TEST(MasonryWall, HasOtherBonds) {
  EXPECT_THAT(built(wall + "bond = \"stack\"\n").scene.block, SizeIs(100));
  // Headers: 0.25 along, 0.5 across; courses of 20 and of 19 with two halves.
  const Built headers = built(wall + "bond = \"header\"\n");
  EXPECT_THAT(headers.scene.block, SizeIs(5 * 20 + 5 * 21));
  EXPECT_EQ(headers.volume(), 5 * 2.5 * 0.5);
  // Two leaves.
  const Built leaves = built(wall + "thickness = 0.5\nbond = \"stack\"\n");
  EXPECT_THAT(leaves.scene.block, SizeIs(200));
  EXPECT_EQ(leaves.box(11).min, Vector3(0, 0.25, 0));
}

TEST(MasonryWall, EndsWhereItIsSaidTo) {
  // 2.2 = 4.4 bricks; 0.6 = 2.4 courses.
  const Built result = built("kind = \"wall\"\nlength = 2.2\nheight = 0.6\nbrick = [0.5, 0.25, 0.25]\n");
  ASSERT_THAT(result.scene.block, SizeIs(3 * 5));
  EXPECT_EQ(result.box(5).min.x(), 2.0);
  EXPECT_EQ(result.box(5).max.x(), 2.2);
  EXPECT_EQ(result.box(15).max.z(), 0.6);
  EXPECT_NEAR(result.volume(), 2.2 * 0.6 * 0.25, 1e-15);
}

TEST(MasonryWall, SumsOfDecimalsMakeNoSlivers) {
  // In binary 3 x 0.1 is not 0.3 and 0.7 no multiple of 0.1.
  const Built result = built(
      "kind = \"wall\"\nlength = 0.3\nheight = 0.7\nbrick = [0.1, 0.1, 0.1]\nbond = \"stack\"\n"
      "openings = [{ box = { min = [0.1, 0, 0.3], max = [0.2, 0.1, 0.6] } }]\n");
  EXPECT_THAT(result.scene.block, SizeIs(21 - 3));
}

TEST(MasonryWall, LeavesOpeningsFree) {
  const Built result = built(wall +
                             "openings = [{ box = { min = [1.1, 0, 0.6], max = [2.3, 0.25, 1.6] } },\n"
                             "            { box = { min = [4.5, -1, -1], max = [9, 1, 0.5] } }]\n");
  EXPECT_NEAR(result.volume(), (5 * 2.5 - 1.2 * 1.0 - 0.5 * 0.5) * 0.25, 1e-14);
  for (const SceneBlock& block : result.scene.block) {
    const SceneBox& box = std::get<SceneBox>(block.shape);
    const bool inside = box.max.x() > 1.1 && box.min.x() < 2.3 && box.max.z() > 0.6 && box.min.z() < 1.6;
    EXPECT_FALSE(inside) << block.name;
  }
}

TEST(MasonryWall, HasLintels) {
  const Built result =
      built(wall +
            "openings = [{ box = { min = [1, 0, 0.5], max = [2, 0.25, 1.5] }, lintel = { height "
            "= 0.25, bearing = 0.25 } }]\n");
  const SceneBlock& lintel = result.scene.block.back();
  EXPECT_EQ(lintel.name, "m.lintel.1");
  EXPECT_EQ(std::get<SceneBox>(lintel.shape).min, Vector3(0.75, 0, 1.5));
  EXPECT_EQ(std::get<SceneBox>(lintel.shape).max, Vector3(2.25, 0.25, 1.75));
  EXPECT_EQ(result.volume(), (5 * 2.5 - 1.0) * 0.25);
}

// Slits in both directions leave (n + 1)^2 pieces of one brick: of 600 of each 361,201.
TEST(MasonryWall, PiecesBetweenCrossingOpeningsAreCounted) {
  const auto crossing = [](int slits, int side) {
    std::string openings;
    for (int k = 0; k < slits; ++k) {
      const double low = k + 0.5, high = k + 0.75;
      openings += fmt::format(
          "{{ box = {{ min = [{0}, 0, -1], max = [{1}, 1, {2}] }} }}, {{ box = {{ min = [-1, 0, {0}], max = "
          "[{2}, "
          "1, {1}] }} }}, ",
          low, high, side + 1);
    }
    return fmt::format(
        "kind = \"wall\"\nlength = {0}\nheight = {0}\nbrick = [{0}, 1, {0}]\nopenings = [{1}]\n", side,
        openings);
  };
  EXPECT_THAT(built(crossing(3, 4)).scene.block, SizeIs(16));
  EXPECT_THAT(
      faults_of(crossing(600, 1000)),
      ElementsAre(StartsWith("s.toml:7:1: error: masonry is too large (about 2e+04 pieces up to this one), "
                             "at most 20000 are allowed")));
}

TEST(MasonryWall, StandsInAnyDirection) {
  // Along y: across goes to -x, and a quarter turn is exact.
  const Built result = built(wall + "origin = [1, 2, 3]\ndirection = [0, 2, 0]\n");
  Vector3 low = Vector3::Constant(1e9), high = -low;
  for (const Polyhedron& solid : result.solids)
    for (const Vector3& point : solid.mesh().points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  EXPECT_EQ(low, Vector3(0.75, 2, 3));
  EXPECT_EQ(high, Vector3(1, 7, 5.5));
  // In any direction, corners of neighbours are the same to the bit: 11 x 2 x 2 of the first course, of which
  // the second shares half.
  const Built turned = built(
      "kind = \"wall\"\nlength = 5\nheight = 0.25\nbrick = [0.5, 0.25, 0.25]\n"
      "direction = [1, 0.3, 0]\norigin = [0.1, 0.2, 0.3]\n");
  std::set<std::array<double, 3>> corners;
  for (const Polyhedron& solid : turned.solids)
    for (const Vector3& point : solid.mesh().points) corners.insert({point.x(), point.y(), point.z()});
  EXPECT_THAT(corners, SizeIs(44));
}

class BadMasonry : public ::testing::TestWithParam<FaultCase> {};

TEST_P(BadMasonry, IsRefused) {
  const auto& [line, masonry, expected] = GetParam();
  EXPECT_THAT(faults_of(masonry), ElementsAre(StartsWith(expected)));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMasonry,
    ::testing::Values(
        FaultCase{
            0, "kind = \"walls\"\n",
            "s.toml:10:8: error: unknown kind (\"walls\"), did you mean \"wall\"? one of \"wall\", \"arch\", "
            "\"column\", \"dome\" is needed"},
        FaultCase{0, wall + "voussoirs = 3\n", "s.toml:14:1: error: unknown key in masonry (voussoirs)"},
        FaultCase{0, wall + "direction = [0, 0, 1]\n",
                  "s.toml:14:13: error: direction is not level ([0, 0, 1])"},
        FaultCase{0, "kind = \"wall\"\nlength = 1\nheight = 1\nbrick = [1, 0, 1]\n",
                  "s.toml:13:9: error: brick has a side that is not positive ([1, 0, 1])"},
        FaultCase{
            0, "kind = \"wall\"\nlength = 1e3\nheight = 1e3\nbrick = [1e-3, 1, 1e-3]\n",
            "s.toml:7:1: error: masonry is too large (about 2e+12 pieces up to this one), at most 20000"},
        FaultCase{0, wall + "openings = [{ box = { min = [6, 0, 0], max = [7, 1, 1] } }]\n",
                  "s.toml:14:13: error: opening is not in the wall (along 6 to 7, up 0 to 1 m)"},
        FaultCase{0, wall + "openings = [{ box = { min = [-1, -1, -1], max = [60, 2, 50] } }]\n",
                  "s.toml:14:1: error: openings leave nothing of the wall (0 bricks), at least one brick"},
        FaultCase{0, wall + "openings = [{ box = { min = [1, 0.1, 0], max = [2, 1, 1] } }]\n",
                  "s.toml:14:13: error: opening does not go through the wall (across from 0.1 to 1 m), from "
                  "0 to 0.25"},
        FaultCase{
            0,
            wall +
                "openings = [{ box = { min = [0, 0, 0], max = [2, 1, 1] }, lintel = { height = 1, bearing = "
                "1 } }]\n",
            "s.toml:14:59: error: lintel is not in the wall (along -1 to 3, up to 2 m)"},
        FaultCase{0, wall + "openings = [{ box = { min = [0, 0, 1], max = [2, 1, 1] } }]\n",
                  "s.toml:14:29: error: min is not below max in z (1 and 1)"},
        FaultCase{
            0, "kind = \"arch\"\nradius = 1\nthickness = 2\nwidth = 1\nvoussoirs = 3\n",
            "s.toml:12:13: error: thickness leaves no inside (2 m), less than twice the mean radius (2 m)"},
        FaultCase{0, "kind = \"arch\"\nradius = 1\nthickness = 0.1\nwidth = 1\nvoussoirs = 1\n",
                  "s.toml:7:1: error: arch spans 180 degrees in 1 voussoirs, 0 to 360 in all"},
        FaultCase{
            0, "kind = \"arch\"\nradius = 1\nthickness = 0.1\nwidth = 1\nvoussoirs = 3\nfrom = 20\nto = 20\n",
            "s.toml:7:1: error: arch spans 0 degrees in 3 voussoirs"},
        FaultCase{0,
                  "kind = \"arch\"\nradius = 1\nthickness = 0.1\nwidth = 1\nvoussoirs = 9\nfill = { top = 1, "
                  "weight "
                  "= 1 }\n",
                  "s.toml:15:1: error: fill is lower than the crown (top = 1 m), at least 1.05 m"},
        FaultCase{0, "kind = \"column\"\nradius = 1\nheight = 1\ndrums = 0\n",
                  "s.toml:13:9: error: drums is out of range"},
        FaultCase{0, "kind = \"dome\"\nradius = 1\nthickness = 0.1\ncourses = 3\nvoussoirs = 8\nto = 90\n",
                  "s.toml:7:1: error: dome goes from 0 to 90 degrees of elevation, 0 <= from < to < 90"},
        FaultCase{0, "kind = \"dome\"\nradius = 1\nthickness = 0.1\ncourses = 300\nvoussoirs = 80\n",
                  "s.toml:7:1: error: masonry is too large (about 2.4e+04 pieces up to this one)"}));

TEST(MasonryWall, WarnsOfThinPieces) {
  EXPECT_THAT(faults_of(wall + "openings = [{ box = { min = [1.001, 0, 0], max = [2, 0.25, 0.25] } }]\n"),
              ElementsAre(StartsWith("s.toml:7:1: warning: 1 of 104 pieces of the wall are thinner")));
}

// Corners of both sides of every joint.
std::size_t shared_corners(const Polyhedron& a, const Polyhedron& b) {
  std::size_t shared = 0;
  for (const Vector3& point : a.mesh().points)
    for (const Vector3& other : b.mesh().points)
      if (point == other) ++shared;
  return shared;
}

TEST(MasonryArch, HasVoussoirsOfOneSize) {
  const Built result = built(
      "kind = \"arch\"\nradius = 2\nthickness = 0.4\nwidth = 0.5\nvoussoirs = 9\n"
      "center = [1, 2, 3]\n");
  ASSERT_THAT(result.solids, SizeIs(9));
  const double each = 0.5 * (2.2 * 2.2 - 1.8 * 1.8) * std::sin(20.0 * degree) * 0.5;
  for (const Polyhedron& solid : result.solids) {
    EXPECT_NEAR(solid.volume(), each, 1e-15);
    EXPECT_THAT(solid.faces(), SizeIs(6));
  }
  for (std::size_t k = 0; k + 1 < 9; ++k)
    EXPECT_EQ(shared_corners(result.solids[k], result.solids[k + 1]), 4U);
  // The springings are level to the bit; the first voussoir is on the side of the direction.
  for (const std::size_t end : {0U, 8U}) {
    int level = 0;
    for (const Vector3& point : result.solids[end].mesh().points) level += point.z() == 3.0 ? 1 : 0;
    EXPECT_EQ(level, 4);
  }
  EXPECT_GT(result.solids[0].mesh().points[0].x(), 1.0);
  EXPECT_EQ(result.solids[0].mesh().points[0].y(), 2.0 - 0.25);
}

TEST(MasonryArch, ClosesToARing) {
  const Built result = built(
      "kind = \"arch\"\nradius = 1\nthickness = 0.3\nwidth = 1\nvoussoirs = 7\nfrom = 90\n"
      "to = -270\ndirection = [1, 1, 0]\n");
  ASSERT_THAT(result.solids, SizeIs(7));
  EXPECT_EQ(shared_corners(result.solids.front(), result.solids.back()), 4U);
  EXPECT_NEAR(result.volume(), 3.5 * (1.15 * 1.15 - 0.85 * 0.85) * std::sin(2.0 * std::numbers::pi / 7),
              1e-14);
}

TEST(MasonryArch, BearsItsFill) {
  // The fill's volume is that between its level and the polygon of the outer face.
  const std::string arch =
      "kind = \"arch\"\nradius = 2\nthickness = 0.4\nwidth = 0.5\nvoussoirs = 9\n"
      "center = [1, 2, 3]\nfill = { top = 6, weight = 2e4 }\n";
  for (const std::string direction : {"", "direction = [0.6, 0.8, 0]\n"}) {
    const Built result = built(arch + direction);
    const double polygon = 9 * 0.5 * 2.2 * 2.2 * std::sin(20.0 * degree);
    double weight = 0.0;
    for (std::size_t k = 0; k < 9; ++k) {
      const SceneLoad& load = result.scene.block[k].load.at(0);
      weight -= load.vector.z();
      // A face of the voussoir lies in the plane of the load.
      const ScenePlane& plane = std::get<ScenePlane>(load.where);
      int near = 0;
      for (const Vector3& point : result.solids[k].mesh().points)
        near += std::abs(plane.normal.normalized().dot(point - plane.point)) < 1e-14 ? 1 : 0;
      EXPECT_EQ(near, 4) << k << direction;
    }
    EXPECT_NEAR(weight, 2e4 * 0.5 * (2 * 2.2 * 3.0 - polygon), 1e-8);
  }
  EXPECT_THAT(faults_of(arch + "from = -10\n"),
              ElementsAre(StartsWith("s.toml:16:1: error: fill on faces that do")));
  EXPECT_THAT(faults_of(arch + "[[assign]]\nblocks = [\"m.1\"]\nfixed = true\n"), IsEmpty());
  EXPECT_THAT(faults_of(arch + "[[assign]]\nblocks = [\"m.1\"]\nfixed = true\nvelocity = [1, 0, 0]\n"),
              ElementsAre(StartsWith("s.toml:17:1: error: motion of a fixed block (m.1)")));
}

TEST(MasonryColumn, StacksDrums) {
  const Built result =
      built("kind = \"column\"\nradius = 0.5\nheight = 3\nsides = 6\ndrums = 4\ncenter = [1, 0, 0]\n");
  ASSERT_THAT(result.solids, SizeIs(4));
  EXPECT_NEAR(result.volume(), 6.0 / 2.0 * 0.25 * std::sin(60.0 * degree) * 3.0, 1e-14);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(shared_corners(result.solids[k], result.solids[k + 1]), 6U);
  EXPECT_THAT(result.solids[0].faces(), SizeIs(8));
  // Frusta: h/3 (A + B + sqrt(A B)) of the whole column.
  const Built tapered =
      built("kind = \"column\"\nradius = 0.5\ntop_radius = 0.4\nheight = 3\nsides = 6\ndrums = 4\n");
  const double unit = 3.0 * std::sin(60.0 * degree);
  EXPECT_NEAR(tapered.volume(), unit * (0.25 + 0.16 + 0.2), 1e-14);
}

TEST(MasonryDome, ClosesWithAKeystone) {
  const Built result =
      built("kind = \"dome\"\nradius = 3\nthickness = 0.5\ncourses = 4\nvoussoirs = 12\nto = 72\n");
  ASSERT_THAT(result.solids, SizeIs(49));
  // Each voussoir is the difference of two similar pyramids with their apex in the centre; the keystone is a frustum.
  const double inner = 2.75, outer = 3.25, cubes = outer * outer * outer - inner * inner * inner;
  const auto unit = [](double up, double around) {
    return Vector3(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up));
  };
  double expected = 0.0;
  for (int course = 0; course < 4; ++course) {
    const double low = 18.0 * course * degree, high = 18.0 * (course + 1) * degree, step = 30.0 * degree;
    const Vector3 a = unit(low, 0), b = unit(low, step), c = unit(high, step), d = unit(high, 0);
    expected += 12.0 * cubes * (a.dot(b.cross(c)) + a.dot(c.cross(d))) / 6.0;
  }
  const double up = 72.0 * degree, area = 6.0 * std::sin(30.0 * degree) * std::cos(up) * std::cos(up);
  expected += cubes * area * std::sin(up) / 3.0;
  EXPECT_NEAR(result.volume(), expected, 1e-12);
  EXPECT_EQ(shared_corners(result.solids[0], result.solids[11]), 4U) << "around";
  EXPECT_EQ(shared_corners(result.solids[0], result.solids[12]), 4U) << "upwards";
  EXPECT_EQ(shared_corners(result.solids[36], result.solids[48]), 4U) << "keystone";
  EXPECT_THAT(result.solids[48].faces(), SizeIs(14));
  EXPECT_THAT(
      built("kind = \"dome\"\nradius = 3\nthickness = 0.5\ncourses = 2\nvoussoirs = 12\nto = 30\nkeystone = "
            "false\n")
          .solids,
      SizeIs(24));
}

}  // namespace
}  // namespace ashlar::test::masonry_test
