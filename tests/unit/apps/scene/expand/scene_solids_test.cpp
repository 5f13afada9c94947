#include "apps/scene/expand/scene_solids.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/solid/shapes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_solids_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

SceneBlock block_of(SceneShape shape) {
  SceneBlock block;
  block.name = "A";
  block.shape = std::move(shape);
  return block;
}

Polyhedron only_solid(const SceneBlock& block) {
  Scene scene;
  scene.block = {block};
  Diagnostics diagnostics;
  const auto solids = build_solids(scene, diagnostics);
  EXPECT_THAT(printed(diagnostics), ::testing::IsEmpty());
  return solids.at(0).value();
}

// Smallest and largest coordinates.
std::pair<Vector3, Vector3> extent(const Polyhedron& solid) {
  Vector3 low = solid.mesh().points.front(), high = low;
  for (const Vector3& point : solid.mesh().points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return {low, high};
}

TEST(SceneSolids, BoxKeepsItsCornersExactly) {
  const Polyhedron solid = only_solid(block_of(SceneBox{{0.1, -0.2, 0.3}, {0.7, 1.1, 1.3}}));
  EXPECT_EQ(extent(solid).first, Vector3(0.1, -0.2, 0.3));
  EXPECT_EQ(extent(solid).second, Vector3(0.7, 1.1, 1.3));
  EXPECT_THAT(solid.faces(), SizeIs(6));
}

TEST(SceneSolids, QuarterTurnsAreExact) {
  // About z through (1, 0, 0): (x, y) -> (1 - y, x - 1).
  SceneBlock block = block_of(SceneBox{{0, 0, 0}, {4, 1, 2}});
  block.rotate = SceneRotation{{0, 0, 3}, 90.0, {1, 0, 0}};
  EXPECT_EQ(extent(only_solid(block)).first, Vector3(0, -1, 0));
  EXPECT_EQ(extent(only_solid(block)).second, Vector3(1, 3, 2));
  block.rotate->angle = -270.0;
  EXPECT_EQ(extent(only_solid(block)).second, Vector3(1, 3, 2));
  block.rotate->angle = 180.0;  // (x, y) -> (2 - x, -y)
  EXPECT_EQ(extent(only_solid(block)).first, Vector3(-2, -1, 0));
  EXPECT_EQ(extent(only_solid(block)).second, Vector3(2, 0, 2));
}

TEST(SceneSolids, RotatedBoxKeepsSixFacesAndItsVolume) {
  SceneBlock block = block_of(SceneBox{{0, 0, 0}, {1, 2, 3}});
  block.rotate = SceneRotation{{1, 2, 3}, 33.0, {0.5, 0.25, 7.0}};
  const Polyhedron solid = only_solid(block);
  EXPECT_THAT(solid.faces(), SizeIs(6));
  EXPECT_NEAR(solid.volume(), 6.0, 6.0 * 1e-14);
}

TEST(SceneSolids, RotatesBeforeItTranslates) {
  // A half turn about z takes the box to x in [-4, 0], y in [-1, 0]; then it moves by (10, 0, 0).
  SceneBlock block = block_of(SceneBox{{0, 0, 0}, {4, 1, 1}});
  block.rotate = SceneRotation{{0, 0, 1}, 180.0, {0, 0, 0}};
  block.translate = {10, 0, 0};
  EXPECT_EQ(extent(only_solid(block)).first, Vector3(6, -1, 0));
  EXPECT_EQ(extent(only_solid(block)).second, Vector3(10, 0, 1));
}

TEST(SceneSolids, RotationTurnsRightHandedAboutItsAxis) {
  // 30 degrees about z take the edge from the origin to (2, 0, 0) to (sqrt 3, 1, 0).
  SceneBlock block = block_of(SceneHull{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  block.rotate = SceneRotation{{0, 0, 1}, 30.0, {0, 0, 0}};
  const Polyhedron solid = only_solid(block);
  double nearest = 1.0;
  for (const Vector3& point : solid.mesh().points)
    nearest = std::min(nearest, (point - Vector3(std::sqrt(3.0), 1, 0)).norm());
  EXPECT_LT(nearest, 1e-15 * 4);
}

TEST(SceneSolids, HullAndSphere) {
  EXPECT_EQ(only_solid(block_of(SceneHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})).volume(),
            1.0 / 6.0);
  const Polyhedron sphere = only_solid(block_of(SceneSphere{{1, 2, 3}, 0.5, 1}));
  EXPECT_THAT(sphere.mesh().triangles, SizeIs(80));
}

std::vector<std::string> hull_faults(const std::string& points) {
  Diagnostics diagnostics;
  const std::string text = sample_with(16, "hull = { points = [" + points + "] }");
  (void)build_solids(parse_scene(text, "s.toml", {}, diagnostics), diagnostics);
  return printed(diagnostics);
}

TEST(SceneSolids, AShapeThatIsFlatToTheRoundingOfItsCoordinatesIsRefused) {
  // Coordinates of 1e14 m are known to 64 units in the last place, 2^-46 of that: 1.4 m.
  EXPECT_THAT(
      hull_faults("[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1e14]"),
      ElementsAre(StartsWith("s.toml:16:1: error: shape is lost in rounding (coordinates up to 1e+14 m "
                             "are known to 1.421 m), a thicker one")));
  EXPECT_THAT(hull_faults("[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1e13]"), ::testing::IsEmpty());
  EXPECT_THAT(hull_faults("[0, 0, 0], [1e14, 0, 0], [0, 1e14, 0], [0, 0, 1]"), SizeIs(1));
}

TEST(SceneSolids, ShapesThatArePlacedTooFarAreRefused) {
  const auto faults_with = [](double translation) {
    Scene scene;
    scene.block = {block_of(SceneBox{{0, 0, 0}, {9e149, 1, 1}})};
    scene.block[0].translate = {translation, 0, 0};
    Diagnostics diagnostics;
    const bool built = build_solids(scene, diagnostics).at(0).has_value();
    EXPECT_EQ(built, diagnostics.good());
    return printed(diagnostics);
  };
  EXPECT_THAT(faults_with(1e149), ::testing::IsEmpty());
  EXPECT_THAT(
      faults_with(2e149),
      ElementsAre(HasSubstr("shape has a coordinate that is too large (1.1e+150 m), at most 1e+150 m is")));
}

const std::string cube_off =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

// The sample in a folder, with block A from a mesh file beside it.
class SceneMeshes : public ::testing::Test {
 protected:
  std::vector<std::string> faults(const std::string& mesh_text,
                                  const std::vector<std::string>& overrides = {}) {
    if (!mesh_text.empty()) write_text(folder_ / "stone.off", mesh_text);
    Diagnostics diagnostics;
    const std::string text = sample_with(16, "  mesh = { file = \"stone.off\", scale = 2.0 }");
    const Scene scene = parse_scene(text, folder_ / "s.toml", overrides, diagnostics);
    solids_ = build_solids(scene, diagnostics);
    return printed(diagnostics);
  }
  // Where the name of block A's mesh file is written, after `  mesh = { file = `.
  [[nodiscard]] std::string mesh_place() const { return (folder_ / "s.toml").string() + ":16:19: error: "; }

  TemporaryFolder folder_;
  std::vector<std::optional<Polyhedron>> solids_;
};

TEST_F(SceneMeshes, AreFoundBesideTheSceneAndScaled) {
  EXPECT_THAT(faults(cube_off), ::testing::IsEmpty());
  EXPECT_EQ(solids_.at(0)->volume(), 8.0);
  EXPECT_EQ(extent(*solids_[0]).second, Vector3(2, 2, 2));
}

TEST_F(SceneMeshes, MissingFileIsReportedAtItsName) {
  EXPECT_THAT(faults(""), ElementsAre(AllOf(StartsWith(mesh_place() + "mesh file cannot be used ("),
                                            HasSubstr((folder_ / "stone.off").string()))));
}

TEST_F(SceneMeshes, MalformedFileNamesItsOwnLine) {
  // The fourth line of the file holds a word where a number is needed.
  std::string text = cube_off;
  text.replace(text.find("1 0 0"), 5, "1 x 0");
  EXPECT_THAT(faults(text), ElementsAre(AllOf(StartsWith(mesh_place() + "mesh file cannot be used ("),
                                              HasSubstr("stone.off:4:"))));
}

TEST_F(SceneMeshes, AMeshThatIsFlatToTheRoundingOfItsCoordinatesIsRefused) {
  const auto faults_at = [&](const std::string& far, const std::string& beyond) {
    return faults("OFF\n4 4 0\n" + far + " 0 0\n" + beyond + " 0 0\n" + far + " 1 0\n" + far +
                  " 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  };
  EXPECT_THAT(faults_at("100000000000000", "100000000000001"),
              ElementsAre(StartsWith(mesh_place() + "shape is lost in rounding (")));
  EXPECT_THAT(faults_at("10000000000000", "10000000000001"), ::testing::IsEmpty());
}

TEST_F(SceneMeshes, ACoordinateBeyondTheLimitNamesItsLine) {
  std::string text = cube_off;
  text.replace(text.find("1 0 0"), 5, "2e150 0 0");
  EXPECT_THAT(faults(text), ElementsAre(AllOf(StartsWith(mesh_place() + "mesh file cannot be used ("),
                                              HasSubstr("stone.off:4:1: x coordinate (2e150), allowed"))));
}

TEST_F(SceneMeshes, OpenMeshNamesItsOpenEdges) {
  std::string text = cube_off;
  text.replace(text.find("8 6 0"), 5, "8 5 0");
  text.erase(text.find("4 3 0 4 7"));
  EXPECT_THAT(faults(text),
              ElementsAre(AllOf(StartsWith(mesh_place() + "mesh bounds no solid ("), HasSubstr("stone.off"),
                                HasSubstr(to_string(MeshDefectKind::open_edge)))));
  EXPECT_FALSE(solids_.at(0).has_value());
  EXPECT_TRUE(solids_.at(1).has_value());
}

TEST_F(SceneMeshes, InsideOutMeshIsRefused) {
  const std::string text =
      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "4 1 2 3 0\n4 7 6 5 4\n4 4 5 1 0\n4 5 6 2 1\n4 6 7 3 2\n4 7 4 0 3\n";
  EXPECT_THAT(faults(text),
              ElementsAre(AllOf(StartsWith(mesh_place()), HasSubstr(to_string(MeshDefectKind::inside_out)))));
}

TEST_F(SceneMeshes, FileFromAnArgumentIsReportedThere) {
  EXPECT_THAT(faults(cube_off, {"block.A.mesh.file=no.off"}),
              ElementsAre(StartsWith("--set block.A.mesh.file=no.off: error: mesh file cannot be used (")));
}

// Corners turned by whoever wrote the scene are off the planes of their faces by some units in the last
// place.
TEST_F(SceneMeshes, AndHullsOfTurnedCornersKeepTheirFlatFaces) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3(2, -1, 3).normalized()).toRotationMatrix();
  std::vector<Vector3> corners = make_box({10, 20, 30}, {11, 22, 33}).points;
  for (Vector3& corner : corners) corner = turn * corner;
  const Polyhedron hull = only_solid(block_of(SceneHull{corners}));
  EXPECT_THAT(hull.faces(), SizeIs(6));
  EXPECT_THAT(hull.mesh().triangles, SizeIs(12));
  ASSERT_GT(Polyhedron(make_convex_hull(corners)).faces().size(), 6U);
  std::string off = "OFF\n8 6 0\n";
  for (const Vector3& corner : corners)
    off += fmt::format("{:.17g} {:.17g} {:.17g}\n", corner.x(), corner.y(), corner.z());
  const Polyhedron box(make_box({0, 0, 0}, {1, 1, 1}));
  for (const PolyhedronFace& face : box.faces()) off += fmt::format("4 {}\n", fmt::join(face.loops[0], " "));
  EXPECT_THAT(faults(off), ::testing::IsEmpty());
  EXPECT_THAT(solids_.at(0)->faces(), SizeIs(6));
}

TEST(SceneSolids, FlatHullIsReportedAtItsKey) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample_with(16, "hull = { points = [[0,0,0],[1,0,0],[0,1,0],[1,1,0]] }"),
                                  "s.toml", {}, diagnostics);
  (void)build_solids(scene, diagnostics);
  EXPECT_THAT(printed(diagnostics), ElementsAre(StartsWith("s.toml:16:1: error: shape cannot be built (")));
}

}  // namespace
}  // namespace ashlar::test::scene_solids_test
