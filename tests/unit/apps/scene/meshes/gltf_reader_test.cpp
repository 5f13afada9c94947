#include "apps/scene/meshes/gltf_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>

#include "apps/scene/meshes/base64.hpp"
#include "apps/scene/meshes/mesh_import.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::test::gltf_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

/// Points and indices of a unit cube: 96 and 72 bytes.
std::string cube_bytes() {
  const TriangleMesh cube = make_box(Vector3::Zero(), Vector3::Ones());
  std::string bytes;
  for (const Vector3& point : cube.points)
    for (const double x : point) bytes += bytes_of(static_cast<float>(x));
  for (const auto& triangle : cube.triangles)
    for (const int corner : triangle) bytes += bytes_of(static_cast<std::uint16_t>(corner));
  return bytes;
}

std::string data_uri() {
  return "data:application/octet-stream;base64," + to_base64(cube_bytes());
}

/// @param nodes JSON of the array. @param roots of the scene. @param buffer keys of the buffer besides its length
std::string cube_file(const std::string& nodes, const std::string& roots, const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": )" + roots + R"(}], "nodes": )" +
         nodes +
         R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
"buffers": [{"byteLength": 168)" +
         buffer + "}]}";
}

std::string with_uri(const std::string& uri) {
  return R"(, "uri": ")" + uri + "\"";
}

std::shared_ptr<const std::string> no_file(const std::string&) {
  throw MeshFileError("not asked for", 0, 0);
}

std::vector<MeshGroup> groups_of(const std::string& nodes, const std::string& roots) {
  return read_gltf(cube_file(nodes, roots, with_uri(data_uri())), no_file).groups();
}

std::string refusal(const std::string& text) {
  try {
    (void)read_gltf(text, no_file).whole();
  } catch (const MeshFileError& error) {
    return fmt::format("{}:{}: {}", error.line(), error.column(), error.what());
  }
  return "taken";
}

/// A good file with one part replaced.
std::string changed(const std::string& part, const std::string& by) {
  std::string text = cube_file(R"([{"mesh": 0}])", "[0]", with_uri(data_uri()));
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part;
  return text.replace(place, part.size(), by);
}

TEST(GltfReader, NodesWithoutNamesHaveTheirIndex) {
  const std::vector<MeshGroup> groups = groups_of(
      R"([{"mesh": 0}, {"mesh": 0, "name": "a"}, {"name": "p", "children": [3, 4]}, {"mesh": 0, "name": "a"}, {"mesh": 0}])",
      "[2, 0, 1]");
  std::vector<std::string> names;
  for (const MeshGroup& group : groups) names.push_back(group.name);
  // In the order of the scene, children first; the second "a" of the file is the first in the scene.
  EXPECT_THAT(names, ElementsAre("a", "nodes[4]", "nodes[0]", "a_2"));
}

TEST(GltfReader, TransformationsOfParentsComeAfterThoseOfChildren) {
  // Child: times (1, 2, 3), a quarter turn about z, plus (1, 2, 3); parent: times 2, a quarter turn, plus (5, 6, 7).
  const std::vector<MeshGroup> groups = groups_of(
      R"([{"mesh": 0, "matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1], "children": [1]},
          {"mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 1, 1], "scale": [1, 2, 3]}])",
      "[0]");
  const TriangleMesh cube = make_box(Vector3::Zero(), Vector3::Ones());
  ASSERT_EQ(groups.size(), 2U);
  ASSERT_EQ(groups[1].mesh.points.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3 p = cube.points[k];
    EXPECT_EQ(groups[0].mesh.points[k], Vector3(5 - 2 * p.y(), 6 + 2 * p.x(), 7 + 2 * p.z()));
    const Vector3 child(1 - 2 * p.y(), 2 + p.x(), 3 + 3 * p.z());
    const Vector3 expected(5 - 2 * child.y(), 6 + 2 * child.x(), 7 + 2 * child.z());
    EXPECT_LT((groups[1].mesh.points[k] - expected).norm(), 1e-14);  // of sqrt(1/2) in the quaternion
  }
}

TEST(GltfReader, MirroredNodesKeepTheirOutside) {
  const std::vector<MeshGroup> groups = groups_of(
      R"([{"scale": [-1, 1, 1], "children": [1]}, {"mesh": 0, "children": [2]}, {"mesh": 0, "scale": [1, 1, -3]}])",
      "[0]");
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(Polyhedron(groups[0].mesh).volume(), 1.0);
  EXPECT_EQ(Polyhedron(groups[1].mesh).volume(), 3.0);
}

TEST(GltfReader, StripsFansAndListsAreTriangles) {
  const auto triangles = [&](int mode) {
    std::string text = changed(R"("indices": 1)", fmt::format(R"("mode": {})", mode));
    text.replace(text.find(R"("count": 8)"), 10, R"("count": 6)");
    return read_gltf(text, no_file).whole().triangles;
  };
  using Triangle = std::array<int, 3>;
  EXPECT_THAT(triangles(4), ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 5}));
  // Every second one is reversed, so that all face the same side.
  EXPECT_THAT(triangles(5),
              ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{2, 3, 4}, Triangle{4, 3, 5}));
  EXPECT_THAT(triangles(6),
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}, Triangle{0, 4, 5}));
  for (const int mode : {0, 1, 2, 3})
    EXPECT_THAT(refusal(changed(R"("indices": 1)", fmt::format(R"("mode": {})", mode))),
                HasSubstr("no faces"));
  EXPECT_THAT(refusal(changed(R"("indices": 1)", R"("mode": 7)")), HasSubstr("mode is 7, allowed 0 to 6"));
}

TEST(GltfReader, OnlyTheSceneIsRead) {
  std::string text = cube_file(R"([{"mesh": 0, "name": "x"}, {"mesh": 0, "name": "y"}])",
                               R"([0]}, {"nodes": [1])", with_uri(data_uri()));
  EXPECT_EQ(read_gltf(text, no_file).groups().front().name, "x");
  text.replace(text.find(R"("scene": 0)"), 10, R"("scene": 1)");
  EXPECT_EQ(read_gltf(text, no_file).groups().front().name, "y");
  text.replace(text.find(R"("scene": 1)"), 10, R"("extras": 7)");
  EXPECT_EQ(read_gltf(text, no_file).groups().front().name, "x");
}

TEST(GltfReader, NodesFormTrees) {
  const auto tree = [](const std::string& nodes, const std::string& roots) {
    return refusal(cube_file(nodes, roots, with_uri(data_uri())));
  };
  EXPECT_THAT(tree(R"([{"children": [1, 1]}, {"mesh": 0}])", "[0]"),
              HasSubstr("nodes[0].children[1] is a node that node 0 has already"));
  EXPECT_THAT(tree(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])", "[0, 1]"),
              HasSubstr("nodes[1].children[0] is a node that node 0 has already"));
  EXPECT_THAT(tree(R"([{"children": [1]}, {"mesh": 0, "children": [0]}])", "[0]"),
              HasSubstr("below another one"));
  EXPECT_THAT(tree(R"([{"mesh": 0, "children": [0]}])", "[0]"), HasSubstr("below another one"));
  EXPECT_THAT(tree(R"([{"mesh": 0}])", "[0, 0]"), HasSubstr("listed twice"));
  EXPECT_THAT(tree(R"([{"mesh": 0, "children": [1]}])", "[0]"),
              HasSubstr("children[0] is 1, allowed 0 to 0"));
  // A circle that no root leads to is not read.
  EXPECT_EQ(tree(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])", "[0]"), "taken");
}

TEST(GltfReader, LongChainsNeedNoStack) {
  std::string nodes = "[";
  const int length = 50'000;
  for (int k = 0; k + 1 < length; ++k) nodes += fmt::format(R"({{"children": [{}]}}, )", k + 1);
  EXPECT_EQ(groups_of(nodes + R"({"mesh": 0}])", "[0]").size(), 1U);
}

TEST(GltfReader, FaultsAreNamed) {
  const std::array<std::array<const char*, 3>, 21> faults = {{
      {R"("2.0")", R"("1.0")", "asset.version is 1.0, allowed 2.0"},
      {R"("asset": {"version": "2.0"}, )", "", "file has no \"asset\""},
      {R"("scene": 0)", R"("scene": 1)", "scene is 1, allowed 0 to 0"},
      {R"("scene": 0)", R"("extensionsRequired": ["KHR_draco_mesh_compression"])",
       "KHR_draco_mesh_compression"},
      {R"("mesh": 0)", R"("mesh": 1)", "nodes[0].mesh is 1, allowed 0 to 0"},
      {R"("mesh": 0)", R"("mesh": -1)", "nodes[0].mesh is no count (-1)"},
      {R"("mesh": 0)", R"("mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}})",
       "EXT_mesh_gpu_instancing"},
      {R"("mesh": 0)", R"("mesh": 0, "scale": [1, 1])", "nodes[0].scale has 2 numbers, allowed 3"},
      {R"("mesh": 0)", R"("mesh": 0, "scale": [1, 0, 1])", "singular"},
      {R"("mesh": 0)", R"("mesh": 0, "rotation": [0, 0, 0, 0])", "nodes[0].rotation is zero"},
      {R"("mesh": 0)", R"("mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,1, 0,0,0,1])", "last row"},
      {R"("mesh": 0)", R"("mesh": 0, "scale": [1,1,1], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])",
       "beside"},
      {R"("count": 36)", R"("count": 37)", "accessors[1] has 37 elements, allowed up to 36"},
      {R"("count": 36)", R"("count": 35)", "primitives[0] has 35 corners of triangles"},
      {R"("count": 36)", R"("count": 4294967295)", "accessors[1] has 4294967295 elements"},
      {R"("count": 36)", R"("count": 36, "sparse": {})", "accessors[1] is sparse"},
      {R"("count": 36)", R"("count": 36, "byteOffset": 4294967295)", "allowed up to 0"},
      {R"("count": 8)", R"("count": 7)", "point index (7), allowed 0 to 6"},
      {R"("componentType": 5126)", R"("componentType": 5125)", "of points is 5125, allowed 5126"},
      {R"("byteLength": 96)", R"("byteLength": 96, "byteStride": 11)",
       "byteStride is 11, allowed at least 12"},
      {R"("byteLength": 168)", R"("byteLength": 169)", "buffers[0] claims 169 bytes, allowed 168"},
  }};
  EXPECT_EQ(refusal(changed("2.0", "2.1")), "taken");
  for (const auto& [part, by, reason] : faults) EXPECT_THAT(refusal(changed(part, by)), HasSubstr(reason));
}

TEST(GltfReader, TextsAreJudgedBeforeTheyAreKept) {
  EXPECT_THAT(refusal("{\n  \"asset\": *}"), HasSubstr("2:12: text is no JSON from here on"));
  EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("nested more than 100 deep"));
  EXPECT_THAT(refusal("[]"), HasSubstr("file is no object"));
  EXPECT_THAT(refusal(std::string("\xff\xfe", 2)), HasSubstr("1:1: text is no JSON"));
  EXPECT_THAT(refusal(R"({"asset": {"version": "2.0", "extras": 1e999}})"),
              HasSubstr("1:40: number is out of the range of double precision (1e999)"));
  EXPECT_THAT(refusal("{\"a\": 21e-4000,\n \"b\": 1e-400}"),
              HasSubstr("1:7: number is out of the range of double precision (21e-4000)"));
  EXPECT_THAT(refusal("{\"a\": \"1e-400,\", \"b\": 0e-400,\n \"c\": -1e-400}"),
              HasSubstr("2:7: number is out of the range of double precision (-1e-400)"));
}

TEST(GltfReader, CoordinatesAreNumbers) {
  std::string bytes = cube_bytes();
  const float none = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 12 * 5, &none, sizeof none);
  EXPECT_THAT(refusal(cube_file(R"([{"mesh": 0}])", "[0]",
                                with_uri("data:application/octet-stream;base64," + to_base64(bytes)))),
              HasSubstr("accessors[0] has a coordinate that is no number, in element 5"));
}

TEST(GltfReader, RepeatedPrimitivesAreBounded) {
  // 1000 triangles that all have corner 0, in each primitive.
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  const auto file = [&](int count) {
    std::string text = changed(R"({"attributes": {"POSITION": 0}, "indices": 1})", primitive);
    for (int k = 1; k < count; ++k) text.insert(text.find(primitive), primitive + ",");
    text.replace(text.find(R"("byteLength": 72)"), 16, R"("byteLength": 6000)");
    text.replace(text.find(R"("byteLength": 168)"), 17, R"("byteLength": 6096)");
    text.replace(text.find(R"("count": 36)"), 11, R"("count": 3000)");
    const std::string buffer = cube_bytes().substr(0, 96) + std::string(6000, '\0');
    return text.replace(text.find(data_uri()), data_uri().size(), "data:;base64," + to_base64(buffer));
  };
  // The file has 8 kB of base64 and 50 kB of primitives, hence a million triangles.
  EXPECT_EQ(refusal(file(1000)), "taken");
  EXPECT_THAT(refusal(file(1001)),
              HasSubstr("primitives[1000] and those before it have more than 1000000 triangles"));
}

std::string glb(const std::string& json, const std::string& binary) {
  std::string text = json;
  text.append((4 - text.size() % 4) % 4, ' ');
  return "glTF" +
         bytes_of(2U, static_cast<std::uint32_t>(28 + text.size() + binary.size()),
                  static_cast<std::uint32_t>(text.size()), 0x4e4f534aU) +
         text + bytes_of(static_cast<std::uint32_t>(binary.size()), 0x004e4942U) + binary;
}

TEST(GltfReader, BinaryFilesHaveTheirBufferInAChunk) {
  const std::string file = glb(cube_file(R"([{"mesh": 0}])", "[0]", ""), cube_bytes());
  EXPECT_EQ(Polyhedron(read_glb(file, no_file).whole()).volume(), 1.0);
  const auto fault = [&](std::size_t place, const std::string& by) {
    std::string bytes = file;
    try {
      (void)read_glb(bytes.replace(place, by.size(), by), no_file);
    } catch (const MeshFileError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_THAT(fault(0, "OBJ "), HasSubstr("does not begin with \"glTF\""));
  EXPECT_THAT(fault(4, bytes_of(1U)), HasSubstr("version 1, allowed 2"));
  EXPECT_THAT(fault(8, bytes_of(0xffffffffU)), HasSubstr("its header says 4294967295"));
  EXPECT_THAT(fault(12, bytes_of(0xffffffffU)), HasSubstr("JSON chunk claims 4294967295 bytes"));
  EXPECT_THAT(fault(16, "BIN "), HasSubstr("no JSON chunk"));
  EXPECT_THAT(fault(file.size() - 168 - 8, bytes_of(0x80000000U)),
              HasSubstr("binary chunk claims 2147483648"));
  for (std::size_t size = 0; size < file.size(); size += 7)
    EXPECT_THROW((void)read_glb(file.substr(0, size), no_file), MeshFileError);
}

class GltfFiles : public ::testing::Test {
 protected:
  std::string refusal_of(const std::string& uri) {
    write_text(folder_ / "in/pier.gltf", cube_file(R"([{"mesh": 0}])", "[0]", with_uri(uri)));
    try {
      (void)read_mesh_file(folder_ / "in/pier.gltf");
    } catch (const MeshFileError& error) {
      return error.what();
    }
    return "taken";
  }
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "in/below");
    write_text(folder_ / "outside.bin", cube_bytes());
    write_text(folder_ / "in/below/a b.bin", cube_bytes());
  }

  TemporaryFolder folder_;
};

TEST_F(GltfFiles, BuffersAreBesideTheFileOrBelowIt) {
  EXPECT_EQ(refusal_of("below/a%20b.bin"), "taken");
  EXPECT_EQ(refusal_of("./below/a b.bin"), "taken");
  EXPECT_THAT(refusal_of("below/c.bin"), HasSubstr("does not exist"));
  const std::string absolute = (folder_ / "outside.bin").string();
  for (const std::string& uri :
       {std::string("../outside.bin"), std::string("below/../below/a b.bin"), absolute, "file://" + absolute,
        std::string("%2e%2e/outside.bin"), std::string("below"), std::string("."), std::string(),
        std::string("/dev/zero")})
    EXPECT_THAT(refusal_of(uri), HasSubstr("allowed are regular files in the folder")) << uri;
}

TEST_F(GltfFiles, PipesAndLinksThatLeadOutAreRefused) {
  ASSERT_EQ(::mkfifo((folder_ / "in/pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder_ / "outside.bin", folder_ / "in/out.bin");
  std::filesystem::create_symlink("/dev/zero", folder_ / "in/zero.bin");
  std::filesystem::create_symlink("below/a b.bin", folder_ / "in/link.bin");
  for (const char* uri : {"pipe", "out.bin", "zero.bin"})
    EXPECT_THAT(refusal_of(uri), HasSubstr("allowed are regular files in the folder")) << uri;
  EXPECT_EQ(refusal_of("link.bin"), "taken");
}

TEST_F(GltfFiles, OneFileUnderManyNamesIsReadOnce) {
  const BufferFile file = buffer_files_in(folder_ / "in");
  EXPECT_EQ(file("below/a b.bin"), file("./below/./a%20b.bin"));
}

}  // namespace
}  // namespace ashlar::test::gltf_reader_test
