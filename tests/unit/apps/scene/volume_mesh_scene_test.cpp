// Meshes of tetrahedra as scenes: a bar of tied tetrahedra under tension is a bar.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <string>

#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::volume_mesh_scene_test {
namespace {

using ::testing::HasSubstr;

/// The bar [0, count] x [0, 1] x [0, 1] as cubes of six tetrahedra each, the first half of them in group "left".
std::string bar_mesh(int count) {
  std::string nodes, elements;
  const auto node = [&](int i, int j, int k) { return 1 + i + (count + 1) * (j + 2 * k); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i <= count; ++i) nodes += fmt::format("{} {} {} {}\n", node(i, j, k), i, j, k);
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  int element = 0;
  for (int cube = 0; cube < count; ++cube) {
    for (const auto& order : orders) {
      std::array<int, 3> corner = {cube, 0, 0};
      elements += fmt::format("{} 4 2 {} 1", ++element, cube < count / 2 ? 1 : 2);
      elements += fmt::format(" {}", node(corner[0], corner[1], corner[2]));
      for (const int axis : order) {
        ++corner[static_cast<std::size_t>(axis)];
        elements += fmt::format(" {}", node(corner[0], corner[1], corner[2]));
      }
      elements += '\n';
    }
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"left\"\n3 2 "
      "\"right\"\n$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      4 * (count + 1), nodes, element, elements);
}

class VolumeMeshScene : public ::testing::Test {
 protected:
  /// @param mesh keys of mesh beside the file. @param more keys of the block
  std::optional<LoadedScene> load(int cubes, const std::string& mesh, const std::string& more) {
    write_text(folder_ / "bar.msh", bar_mesh(cubes));
    const std::string text = R"(
analysis = { type = "static", gravity = [0, 0, 0] }
material = [{ name = "steel", density = 8000, young_modulus = 1e9, poisson_ratio = 0 }]
joint = [{ blocks = ["bar.*", "bar.*"], tied = true }]
measure = [{ name = "end", block = "bar", point = [4, 0.25, 0.75] }]
[[block]]
name = "bar"
material = "steel"
mesh = { file = "bar.msh", )" +
                             mesh + " }\n" + more + "\n";
    return load_scene_text(text, folder_ / "s.toml", {}, faults_);
  }

  /// "LINE: MESSAGE" of each fault.
  [[nodiscard]] std::string faults() const {
    std::string text;
    for (const Diagnostic& fault : faults_.sorted())
      text += fmt::format("{}: {}\n", fault.place.line, fault.message);
    return text;
  }

  TemporaryFolder folder_;
  Diagnostics faults_;
};

const std::string clamp = "fix = [{ plane = { point = [0, 0, 0], normal = [1, 0, 0] } }]\n";
const std::string pull =
    clamp + "load = [{ plane = { point = [4, 0, 0], normal = [1, 0, 0] }, traction = [1e6, 0, 0] }]";

TEST_F(VolumeMeshScene, ABarOfTetrahedraUnderTensionStretchesByStressOverModulus) {
  for (const int order : {1, 2}) {
    auto scene = load(4, "split = \"tetrahedra\"", pull + fmt::format("\norder = {}", order));
    ASSERT_TRUE(scene) << faults();
    EXPECT_EQ(scene->scene.block.size(), 24U);
    ashlar::Run run(std::move(*scene), 2);
    while (run.step()) {
    }
    ASSERT_EQ(run.status(), RunStatus::equilibrium) << run.message();
    // u = sigma x / E. The compliance of ties adds sigma / k each, k = 1000 E / size or so.
    const std::vector<BlockModel>& blocks = run.simulation().blocks();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Vector3 point = blocks[b].solid().mesh().points.front();
      const PointMotion motion = run.motion(blocks[b].name(), point);
      EXPECT_NEAR(motion.displacement.x(), 1e-3 * point.x(), 2e-5) << blocks[b].name();
      EXPECT_NEAR(motion.displacement.y(), 0.0, 2e-5);
      EXPECT_NEAR(motion.stress(0, 0), 1e6, 1e4);
    }
    // The measured point is one of a piece.
    const std::vector<std::string> columns = run.columns();
    const auto column = std::find(columns.begin(), columns.end(), "end.ux") - columns.begin();
    EXPECT_NEAR(run.rows().back()[static_cast<std::size_t>(column)], 4e-3, 2e-5);
  }
}

TEST_F(VolumeMeshScene, AForceIsSharedByArea) {
  const auto scene =
      load(4, "split = \"tetrahedra\"",
           clamp + "load = [{ plane = { point = [4, 0, 0], normal = [1, 0, 0] }, force = [6, 0, 0] }]");
  ASSERT_TRUE(scene) << faults();
  double sum = 0.0;
  int loaded = 0, held = 0;
  for (const SceneBlock& block : scene->scene.block) {
    for (const SceneLoad& load : block.load) sum += load.vector.x();
    loaded += block.load.empty() ? 0 : 1;
    held += block.fix.empty() ? 0 : 1;
  }
  EXPECT_DOUBLE_EQ(sum, 6.0);
  // Two of the six tetrahedra of a cube have a facet in each of its sides.
  EXPECT_EQ(loaded, 2);
  EXPECT_EQ(held, 2);
}

TEST_F(VolumeMeshScene, GroupsAndSurfacesAreBlocks) {
  auto scene = load(4, "split = \"groups\"", pull);
  ASSERT_TRUE(scene) << faults();
  ASSERT_EQ(scene->scene.block.size(), 2U);
  EXPECT_EQ(scene->scene.block[0].name, "bar.left");
  EXPECT_EQ(scene->solids[1].volume(), 2.0);
  EXPECT_EQ(scene->solids[1].faces().size(), 6U);
  ashlar::Run run(std::move(*scene));
  while (run.step()) {
  }
  EXPECT_NEAR(run.motion("bar.right", {4, 0.5, 0.5}).displacement.x(), 4e-3, 2e-5);

  const auto one = load(4, "split = \"tetrahedra\", group = \"right\"", "");
  ASSERT_TRUE(one) << faults();
  EXPECT_EQ(one->scene.block.size(), 12U);
}

TEST_F(VolumeMeshScene, FaultsAreAtTheFile) {
  EXPECT_FALSE(load(2, "group = \"middle\"", ""));
  EXPECT_THAT(faults(), HasSubstr("9: mesh file cannot be used ("));
  EXPECT_THAT(faults(), HasSubstr("no physical group of the volume (middle), there are left, right)"));
  EXPECT_FALSE(
      load(2, "split = \"tetrahedra\"", "fix = [{ plane = { point = [9, 0, 0], normal = [1, 0, 0] } }]"));
  EXPECT_THAT(faults(), HasSubstr("no piece of block \"bar\" has a face in the plane"));
}

}  // namespace
}  // namespace ashlar::volume_mesh_scene_test
