#include "geometry/mesh/mesh_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::mesh_io_test {
namespace {

using testing::ElementsAre;
using testing::SizeIs;
using Triangle = std::array<int, 3>;

class MeshIo : public testing::Test {
 protected:
  TriangleMesh read(const std::string& name, const std::string& content) {
    write_text(folder_ / name, content);
    return read_mesh(folder_ / name);
  }

  // "line:column: what" of the refusal.
  std::string refusal(const std::string& name, const std::string& content) {
    try {
      (void)read(name, content);
    } catch (const MeshFileError& error) {
      return std::to_string(error.line()) + ":" + std::to_string(error.column()) + ": " + error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

const std::string tetrahedron_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string tetrahedron_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

void expect_tetrahedron(const TriangleMesh& mesh) {
  EXPECT_THAT(mesh.points,
              ElementsAre(Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)));
  EXPECT_THAT(mesh.triangles,
              ElementsAre(Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}));
}

template <class T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  std::string bytes(sizeof(T), '\0');
  std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T), bytes.begin());
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string bytes = "solid is how a text file begins, this one is binary all the same";
  bytes.resize(80, ' ');
  bytes += bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (const int v : t) {
      for (int d = 0; d < 3; ++d) bytes += bytes_of(static_cast<float>(mesh.points[v][d]));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string text_stl(const TriangleMesh& mesh) {
  std::string text = "solid sample\n";
  for (const Triangle& t : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const int v : t) {
      const Vector3& p = mesh.points[v];
      text += "      vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
              std::to_string(p.z()) + "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid sample\n";
}

std::string binary_ply(const TriangleMesh& mesh, std::endian order) {
  std::string bytes = "ply\nformat binary_";
  bytes += order == std::endian::little ? "little" : "big";
  bytes +=
      "_endian 1.0\ncomment two points of a path come first\nelement path 1\nproperty list uint8 int16 "
      "stations\n"
      "element vertex " +
      std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty uchar red\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.triangles.size()) +
      "\nproperty float quality\nproperty list uint8 uint32 vertex_indices\nend_header\n";
  bytes +=
      bytes_of(std::uint8_t{2}, order) + bytes_of(std::int16_t{-5}, order) + bytes_of(std::int16_t{7}, order);
  for (const Vector3& p : mesh.points) {
    bytes += bytes_of(p.x(), order) + bytes_of(std::uint8_t{255}, order) + bytes_of(p.y(), order) +
             bytes_of(p.z(), order);
  }
  for (const Triangle& t : mesh.triangles) {
    bytes += bytes_of(0.5F, order) + bytes_of(std::uint8_t{3}, order);
    for (const int v : t) bytes += bytes_of(static_cast<std::uint32_t>(v), order);
  }
  return bytes;
}

TEST_F(MeshIo, off) {
  expect_tetrahedron(read("a.off", "OFF\n4 4 6\n" + tetrahedron_points + tetrahedron_faces));
  expect_tetrahedron(
      read("a.OFF", "OFF 4 4\r\n\r\n0 0 0\r\n+1 0 0\r\n0 1e0 0\r\n0 0 1.\r\n" + tetrahedron_faces));
}

TEST_F(MeshIo, off_with_comments_and_colours) {
  expect_tetrahedron(
      read("a.off", "# made by hand\n\nOFF # header\n4 4 0 # counts\n" + tetrahedron_points +
                        "\n# faces\n3 0 2 1 255 0 0\n3 0 1 3 # plain\n3 1 2 3 0.5 0.5 0.5 1\n3 2 0 3 7\n\n"));
  expect_tetrahedron(
      read("a.off", "COFF\n4 4 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 0\n0 0 1 1 1 1 1\n" +
                        tetrahedron_faces));
}

TEST_F(MeshIo, obj) {
  expect_tetrahedron(read(
      "a.obj",
      "# comment\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.1 0.2 0.3\nv 0 0 1\nvn 0 0 1\n"
      "vt 0 0\ng side\nusemtl red\ns off\nf 1 3 2\nf 1/1 2/1 4/1\nf 2//1 3//1 4//1\nf 3/1/1 1/1/1 4/1/1\n"));
}

TEST_F(MeshIo, obj_with_negative_indices) {
  expect_tetrahedron(read(
      "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf 2 3 4\nf -2/-1 -4//-1 -1\n"));
}

TEST_F(MeshIo, obj_face_before_its_points) {
  expect_tetrahedron(
      read("a.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"));
}

TEST_F(MeshIo, obj_groups_are_bodies_with_the_points_they_use) {
  // A face before any group, one body in two parts, another that shares its points, and a group without faces.
  write_text(folder_ / "m.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no second one\nf 4 3 2\ng third\nf 2 3 1\n"
             "g empty\no second  one\nf 1 3 4\n");
  const std::vector<MeshGroup> groups = read_mesh_groups(folder_ / "m.obj");
  ASSERT_THAT(groups, SizeIs(3));
  EXPECT_EQ(groups[0].name, "default");
  EXPECT_EQ(groups[1].name, "second one");
  EXPECT_EQ(groups[2].name, "third");
  EXPECT_THAT(groups[0].mesh.points, ElementsAre(Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)));
  EXPECT_THAT(groups[1].mesh.triangles, ElementsAre(Triangle{3, 2, 1}, Triangle{0, 2, 3}));
  EXPECT_THAT(groups[2].mesh.triangles, ElementsAre(Triangle{1, 2, 0}));
  write_text(folder_ / "m.stl", "solid\nendsolid\n");
  EXPECT_THROW((void)read_mesh_groups(folder_ / "m.stl"), MeshFileError);
}

TEST_F(MeshIo, stl_welds_equal_points) {
  const TriangleMesh frame = test_support::make_frame();
  for (const std::string& content : {binary_stl(frame), text_stl(frame)}) {
    const TriangleMesh mesh = read("a.stl", content);
    EXPECT_THAT(mesh.points, SizeIs(16));
    EXPECT_THAT(mesh.triangles, SizeIs(frame.triangles.size()));
    EXPECT_EQ(Polyhedron(mesh).volume(), 8.0);
  }
}

TEST_F(MeshIo, stl_keeps_points_with_other_bits_apart) {
  TriangleMesh mesh = test_support::make_pyramid();
  mesh.points.emplace_back(-0.0, 0.0, 0.0);
  mesh.triangles[2][0] = 5;
  EXPECT_THAT(read("a.stl", binary_stl(mesh)).points, SizeIs(6));
}

TEST_F(MeshIo, ply_text) {
  expect_tetrahedron(read(
      "a.ply",
      "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nelement face 4\n"
      "property list uchar int vertex_index\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
      "end_header\n0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n" +
          tetrahedron_faces + "0 1\n"));
}

TEST_F(MeshIo, ply_binary_of_both_byte_orders) {
  const TriangleMesh frame = test_support::make_frame();
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const TriangleMesh mesh = read("a.ply", binary_ply(frame, order));
    EXPECT_EQ(mesh.points, frame.points);
    EXPECT_EQ(mesh.triangles, frame.triangles);
  }
}

TEST_F(MeshIo, decimals_of_17_digits_give_the_same_double_back) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 200; ++round) {
    std::string content = "OFF\n3 1 0\n";
    std::vector<double> values;
    while (values.size() < 9) {
      const double value = std::bit_cast<double>(random());
      if (!std::isfinite(value) || is_too_far(value)) continue;
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), "%.16e ", value);
      content += text.data();
      values.push_back(value);
      if (values.size() % 3 == 0) content += "\n";
    }
    const TriangleMesh mesh = read("a.off", content + "3 0 1 2\n");
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(mesh.points[i / 3][i % 3], values[i]);
  }
}

TEST_F(MeshIo, non_finite_coordinates_are_left_for_the_check_of_the_mesh) {
  const TriangleMesh mesh =
      read("a.off", "OFF\n4 4 0\n0 0 nan\n1 0 -inf\n0 1 0\n0 0 1\n" + tetrahedron_faces);
  const auto defects = Polyhedron::find_defects(mesh);
  ASSERT_THAT(defects, SizeIs(2));
  EXPECT_EQ(defects[0].kind, MeshDefectKind::non_finite_point);
  EXPECT_EQ(defects[1].element, "point 1 (1, 0, -inf)");
}

TEST_F(MeshIo, convex_polygons_become_fans) {
  const TriangleMesh mesh = read("a.off", "OFF\n5 1 0\n0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

// The caps have a reflex corner and a corner inside a straight side; all must come out flat, in one piece.
TEST_F(MeshIo, polygons_with_reflex_and_straight_corners) {
  const TriangleMesh mesh = read("a.off",
                                 "OFF\n14 9 0\n0 0 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n1 0 "
                                 "1\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n0 2 1\n"
                                 "7 6 5 4 3 2 1 0\n7 7 8 9 10 11 12 13\n4 0 1 8 7\n4 1 2 9 8\n4 2 3 10 9\n4 "
                                 "3 4 11 10\n4 4 5 12 11\n4 5 6 13 12\n"
                                 "4 6 0 7 13\n");
  const Polyhedron p(mesh);
  EXPECT_EQ(p.volume(), 3.0);
  EXPECT_THAT(p.faces(), SizeIs(8));
  EXPECT_THAT(p.corners(), SizeIs(12));
}

// A square ring given as one polygon with a bridge between its outer and inner loop.
TEST_F(MeshIo, polygon_with_a_bridge) {
  const TriangleMesh mesh = read("a.obj",
                                 "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\n"
                                 "f 1 2 3 4 1 5 8 7 6 5\n");
  ASSERT_THAT(mesh.triangles, SizeIs(8));
  double area = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 ab = mesh.points[j] - mesh.points[i];
    const Vector3 ac = mesh.points[k] - mesh.points[i];
    const double doubled = ab.x() * ac.y() - ab.y() * ac.x();
    EXPECT_GT(doubled, 0.0);
    area += doubled / 2.0;
  }
  EXPECT_EQ(area, 8.0);
}

// Volumes by hand; that of the stone by rational arithmetic from the decimals of the file.
TEST_F(MeshIo, meshes_that_ship_are_solids) {
  const std::filesystem::path meshes = std::filesystem::path(ASHLAR_DATA_DIR) / "meshes";
  EXPECT_EQ(Polyhedron(read_mesh(meshes / "cube.stl")).volume(), 1.0);
  EXPECT_EQ(Polyhedron(read_mesh(meshes / "frame.obj")).volume(), 8.0);
  EXPECT_EQ(Polyhedron(read_mesh(meshes / "l_prism.ply")).volume(), 3.0);
  EXPECT_EQ(Polyhedron(read_mesh(meshes / "pyramid.ply")).volume(), 4.0);
  const Polyhedron stone(read_mesh(meshes / "stone.off"));
  EXPECT_TRUE(stone.convex());
  EXPECT_EQ(stone.volume(), 2.4405854235);
}

TEST_F(MeshIo, refused_files_tell_place_value_and_what_is_allowed) {
  EXPECT_EQ(refusal("a.off", ""), "0:0: mesh file is empty");
  EXPECT_EQ(refusal("a.xyz", "1 2 3"),
            "0:0: ending of the mesh file (.xyz), allowed .off, .obj, .stl, .ply, .msh");
  EXPECT_EQ(refusal("a.off", "OOF\n1 1 0\n"),
            "1:1: header (OOF), must be OFF, NOFF, COFF, STOFF or their combinations");
  EXPECT_EQ(refusal("a.off", "OFF\n4 4 6\n0 0 0\n1 0 x\n"), "4:5: z coordinate (x), must be a number");
  EXPECT_EQ(refusal("a.off", "OFF\n4 4 6\n" + tetrahedron_points + "3 0 1 4\n"),
            "7:7: point index (4), allowed 0 to 3");
  EXPECT_EQ(refusal("a.off", "OFF\n4 4 6\n" + tetrahedron_points + "3 0 1 2\n"),
            "7:0: file ends before face 1");
  EXPECT_EQ(refusal("a.off", "OFF\n4 1 6\n" + tetrahedron_points + tetrahedron_faces),
            "8:1: text after the last face (3), the header announces 1 faces");
  EXPECT_EQ(refusal("a.off", "OFF\n99999999999 4 6\n"),
            "2:1: number of points (99999999999), allowed 1 to 2147483647");
  EXPECT_EQ(refusal("a.off", "OFF\n4 2000000000 6\n" + tetrahedron_points),
            "2:3: number of faces (2000000000), the file is too short for them");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"),
            "4:7: point index (-4), allowed -3 to 2147483647");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "4:7: point index (4), allowed 1 to 3");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), "3:1: face with 2 corners, needs at least 3");
  EXPECT_EQ(refusal("a.obj", "v 0 0 1e999\n"),
            "1:7: z coordinate (1e999), must be in the range of double precision");
  EXPECT_EQ(refusal("a.stl", "solid a\n facet normal 0 0\n"), "2:18: line ends before normal");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 2.0\n"), "2:14: unexpected word (2.0), 1.0 must be here");
}

TEST_F(MeshIo, coordinates_beyond_the_limit_are_refused_at_their_place) {
  const std::string allowed = "allowed -1e150 to 1e150";
  EXPECT_EQ(refusal("a.off", "OFF\n4 4 6\n0 0 0\n1 0 -1.1e150\n"),
            "4:5: z coordinate (-1.1e150), " + allowed);
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 1.8e308 0\n"),
            "2:5: y coordinate (1.8e308), must be in the range of double precision");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 1.7e308 0\n"), "2:5: y coordinate (1.7e308), " + allowed);
  EXPECT_EQ(refusal("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 2e150 0 0\n"),
            "4:8: x coordinate (2e150), " + allowed);
  TriangleMesh mesh = read("a.off", "OFF\n4 4 6\n0 0 0\n1 0 1e150\n0 1 0\n0 0 1\n" + tetrahedron_faces);
  EXPECT_EQ(mesh.points[1].z(), 1e150);
  mesh.points[2].y() = 1.25e150;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string file = binary_ply(mesh, order);
    const std::size_t place = file.find(bytes_of(1.25e150, order));
    EXPECT_EQ(refusal("a.ply", file),
              "0:0: y coordinate at byte " + std::to_string(place) + " (1.25e+150), " + allowed);
  }
  EXPECT_EQ(
      refusal(
          "a.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double "
          "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 2e150\n3 0 0 0\n"),
      "10:5: z coordinate (2e150), " + allowed);
}

TEST_F(MeshIo, names_in_messages_are_printable) {
  const std::string name("\0\x1b[2J", 5);
  EXPECT_EQ(refusal("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                    "float z\nproperty float " +
                        name +
                        "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0 no\n3 0 0 0\n"),
            "11:7: ??[2J (no), must be a number");
}

TEST_F(MeshIo, folder_and_missing_file_are_refused) {
  std::filesystem::create_directory(folder_ / "folder.off");
  EXPECT_THROW((void)read_mesh(folder_ / "folder.off"), MeshFileError);
  EXPECT_THROW((void)read_mesh(folder_ / "missing.off"), MeshFileError);
}

}  // namespace
}  // namespace ashlar::mesh_io_test
