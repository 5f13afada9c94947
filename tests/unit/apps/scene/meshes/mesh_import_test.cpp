#include "apps/scene/meshes/mesh_import.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstring>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/meshes/base64.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::mesh_import_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array<std::array<int, 3>, 12> triangles = {{{0, 2, 3},
                                                           {0, 3, 1},
                                                           {4, 5, 7},
                                                           {4, 7, 6},
                                                           {0, 1, 5},
                                                           {0, 5, 4},
                                                           {2, 6, 7},
                                                           {2, 7, 3},
                                                           {0, 4, 6},
                                                           {0, 6, 2},
                                                           {1, 3, 7},
                                                           {1, 7, 5}}};

Vector3 cube_corner(int k, double x) {
  return Vector3(x + k % 2, k / 2 % 2, k / 4);
}

/// Unit cubes side by side, each on a separate layer.
std::string dxf(int count) {
  std::string text = "0\nSECTION\n2\nENTITIES\n";
  for (int cube = 0; cube < count; ++cube) {
    for (const auto& [a, b, c] : triangles) {
      text += fmt::format("0\n3DFACE\n8\nlayer {}\n", cube + 1);
      const std::array<int, 4> corners = {a, b, c, c};
      for (int k = 0; k < 4; ++k) {
        const Vector3 place = cube_corner(corners[static_cast<std::size_t>(k)], cube);
        for (int axis = 0; axis < 3; ++axis)
          text += fmt::format("{}\n{}\n", 10 * (axis + 1) + k, place[axis]);
      }
    }
  }
  return text + "0\nENDSEC\n0\nEOF\n";
}

/// One unit cube that two nodes show: where it is, and `shift` above.
std::string gltf(double shift) {
  std::string buffer;
  const auto add = [&](const auto& value) {
    buffer.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int k = 0; k < 8; ++k)
    for (const double x : cube_corner(k, 0.0)) add(static_cast<float>(x));
  for (const auto& triangle : triangles)
    for (const int corner : triangle) add(static_cast<std::uint16_t>(corner));
  return fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"name": "lower", "mesh": 0}}, {{"name": "upper", "mesh": 0, "translation": [0, 0, {}]}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}},
{{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}}],
"bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 96}}, {{"buffer": 0, "byteOffset": 96, "byteLength": 72}}],
"buffers": [{{"byteLength": 168, "uri": "data:application/octet-stream;base64,{}"}}]}})",
                     shift, to_base64(buffer));
}

class MeshImport : public ::testing::Test {
 protected:
  std::vector<MeshGroup> groups_of(const std::string& name, const std::string& content) {
    write_text(folder_ / name, content);
    return read_mesh_file_groups(folder_ / name);
  }

  TemporaryFolder folder_;
};

/// A cube of 1 m from a corner, as a solid with 8 corners.
void expect_cube(const TriangleMesh& mesh, const Vector3& corner) {
  const Polyhedron solid(mesh);
  EXPECT_EQ(solid.volume(), 1.0);
  EXPECT_EQ(solid.mesh().points.size(), 8U);
  Vector3 low = solid.mesh().points.front();
  for (const Vector3& point : solid.mesh().points) low = low.cwiseMin(point);
  EXPECT_EQ(low, corner);
}

TEST_F(MeshImport, LayersOfDrawingsAreGroupsWhereTheFileHasThem) {
  const std::vector<MeshGroup> groups = groups_of("wall.dxf", dxf(3));
  ASSERT_EQ(groups.size(), 3U);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    EXPECT_EQ(groups[k].name, fmt::format("layer {}", k + 1));
    expect_cube(groups[k].mesh, {static_cast<double>(k), 0, 0});
  }
}

TEST_F(MeshImport, ObjectsOfScenesAreGroupsWhereTheirNodesPutThem) {
  const std::vector<MeshGroup> groups = groups_of("pier.gltf", gltf(1.5));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "lower");
  EXPECT_EQ(groups[1].name, "upper");
  expect_cube(groups[0].mesh, {0, 0, 0});
  expect_cube(groups[1].mesh, {0, 0, 1.5});
  EXPECT_EQ(read_mesh_file(folder_ / "pier.gltf").triangles.size(), 24U);
}

TEST_F(MeshImport, ObjectsOfPrintsAreGroups) {
  const std::vector<MeshGroup> groups = read_mesh_file_groups(ASHLAR_DATA_DIR "/meshes/two_cubes.3mf");
  ASSERT_EQ(groups.size(), 2U);
  expect_cube(groups[0].mesh, {0, 0, 0});
  expect_cube(groups[1].mesh, {0, 0, 1});
}

TEST_F(MeshImport, CoordinatesAreReadInDoublePrecision) {
  std::string text = dxf(1);
  const std::size_t one = text.rfind("\n1\n");
  text.replace(one, 3, "\n1.0000000000000002\n");
  write_text(folder_ / "wall.dxf", text);
  const TriangleMesh mesh = read_mesh_file(folder_ / "wall.dxf");
  ASSERT_EQ(mesh.points.size(), 9U);
  EXPECT_EQ(mesh.points.back().maxCoeff(), 1.0000000000000002);
}

TEST_F(MeshImport, ContentIsOfTheFormatThatTheEndingNames) {
  write_text(folder_ / "cube.dxf", dxf(1));
  write_text(folder_ / "cube.gltf", gltf(0));
  const std::string print = read_text(ASHLAR_DATA_DIR "/meshes/two_cubes.3mf");
  for (const char* ending : {"dxf", "gltf", "glb", "3mf"})
    for (const std::string& content :
         {dxf(1), gltf(0), print, std::string("v 0 0 0\n"), std::string("solid a\n")}) {
      const bool own = (ending == std::string("dxf") && content == dxf(1)) ||
                       (ending == std::string("gltf") && content == gltf(0)) ||
                       (ending == std::string("3mf") && content == print);
      const std::string name = fmt::format("file.{}", ending);
      if (own)
        EXPECT_FALSE(groups_of(name, content).empty());
      else
        EXPECT_THROW((void)groups_of(name, content), MeshFileError) << ending << content.substr(0, 9);
    }
}

TEST_F(MeshImport, SolidsOfTooManyStonesAreNotBuilt) {
  std::string text = gltf(0);
  const std::string nodes =
      text.substr(text.find("\"nodes\": [{"), text.find("\"meshes\"") - text.find("\"nodes\": [{"));
  std::string many = "\"nodes\": [";
  std::string roots = "0";
  for (int k = 0; k < 20'000; ++k) {
    many += R"({"mesh": 0}, )";
    roots += fmt::format(", {}", k + 1);
  }
  text.replace(text.find(nodes), nodes.size(), many + R"({"mesh": 0}], )");
  text.replace(text.find("[0, 1]"), 6, "[" + roots + "]");
  write_text(folder_ / "many.gltf", text);
  Diagnostics diagnostics;
  const Scene scene = parse_scene(
      "analysis = { type = \"static\" }\n[[block]]\nname = \"b\"\nfixed = true\nmesh = { file = "
      "\"many.gltf\", "
      "split = \"groups\" }\n",
      folder_ / "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), Contains(HasSubstr("too many blocks (20001 or more")));
  ASSERT_EQ(scene.block.size(), 20'001U);
  for (const SceneBlock& block : scene.block)
    EXPECT_TRUE(std::holds_alternative<std::monostate>(block.shape));
}

TEST_F(MeshImport, WhatIsNoMeshIsRefused) {
  EXPECT_THROW((void)read_mesh_file(folder_ / "none.dxf"), MeshFileError);
  EXPECT_THROW((void)groups_of("text.gltf", "no scene"), MeshFileError);
  EXPECT_THROW((void)groups_of("empty.3mf", ""), MeshFileError);
  EXPECT_THROW((void)groups_of("line.dxf", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n"), MeshFileError);
}

TEST_F(MeshImport, ScenesAreToldOfUnits) {
  write_text(folder_ / "wall.dxf", dxf(2));
  write_text(folder_ / "s.toml",
             "analysis = { type = \"static\" }\n[[block]]\nname = \"stones\"\nfixed = true\nmesh = { file = "
             "\"wall.dxf\", split = \"groups\" }\n");
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder_ / "s.toml", {}, diagnostics);
  ASSERT_TRUE(loaded);
  EXPECT_THAT(printed(diagnostics), ElementsAre(HasSubstr("do not say their unit")));
  ASSERT_EQ(loaded->scene.block.size(), 2U);
  EXPECT_EQ(loaded->scene.block[1].name, "stones.layer 2");
}

}  // namespace
}  // namespace ashlar::test::mesh_import_test
