// Binary MSH files, written here byte by byte as Gmsh's manual describes them, and elements of second order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar::binary_msh_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Lines and numbers of a binary file.
class Bytes {
 public:
  explicit Bytes(std::endian order) : order_(order) {}
  Bytes& text(const std::string& words) {
    bytes_ += words;
    return *this;
  }
  template <class Number>
  Bytes& numbers(std::initializer_list<Number> values) {
    for (const Number value : values) {
      auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
      if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
      bytes_.append(raw.begin(), raw.end());
    }
    return *this;
  }
  Bytes& ints(std::initializer_list<std::int32_t> values) { return numbers(values); }
  Bytes& sizes(std::initializer_list<std::uint64_t> values) { return numbers(values); }
  Bytes& reals(std::initializer_list<double> values) { return numbers(values); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::endian order_;
  std::string bytes_;
};

/// Two tetrahedra of edge 2 along the axes, on both sides of the plane x = 0, of 4 / 3 m^3 each; group "right" and none.
std::string version_2(std::endian order) {
  Bytes file(order);
  file.text("$MeshFormat\n2.2 1 8\n").ints({1}).text("\n$EndMeshFormat\n");
  file.text("$PhysicalNames\n1\n3 7 \"right\"\n$EndPhysicalNames\n$Nodes\n5\n");
  file.ints({1}).reals({0, 0, 0}).ints({2}).reals({2, 0, 0}).ints({3}).reals({0, 2, 0});
  file.ints({4}).reals({0, 0, 2}).ints({9}).reals({-2, 0, 0}).text("\n$EndNodes\n$Elements\n4\n");
  // A point and a triangle that are passed over; then both tetrahedra under one head, the second one inside out.
  file.ints({15, 1, 2}).ints({1, 7, 1, 1}).ints({2, 1, 2}).ints({2, 7, 1, 1, 2, 3});
  file.ints({4, 2, 2}).ints({3, 7, 1, 1, 2, 3, 4}).ints({4, 0, 2, 1, 9, 3, 4});
  return file.text("\n$EndElements\n").bytes();
}

/// The same, the first one of second order.
std::string version_4(std::endian order) {
  Bytes file(order);
  file.text("$MeshFormat\n4.1 1 8\n").ints({1}).text("\n$EndMeshFormat\n");
  file.text("$PhysicalNames\n1\n3 7 \"right\"\n$EndPhysicalNames\n$Entities\n").sizes({1, 0, 1, 2});
  file.ints({1}).reals({0, 0, 0}).sizes({0});
  file.ints({1}).reals({0, 0, 0, 0, 2, 2}).sizes({0, 3}).ints({1, 2, 3});
  file.ints({1}).reals({0, 0, 0, 2, 2, 2}).sizes({1}).ints({7}).sizes({1}).ints({1});
  file.ints({2}).reals({-2, 0, 0, 0, 2, 2}).sizes({0, 1}).ints({-1}).text("\n$EndEntities\n");
  file.text("$Nodes\n").sizes({2, 11, 1, 20}).ints({0, 1, 0}).sizes({1, 1}).reals({0, 0, 0});
  // Nodes in the middle of curved edges: not on the straight ones. On a surface with its parameters.
  file.ints({2, 1, 1}).sizes({10, 2, 3, 4, 9, 15, 16, 17, 18, 19, 20});
  for (const Vector3& p :
       {Vector3(2, 0, 0), Vector3(0, 2, 0), Vector3(0, 0, 2), Vector3(-2, 0, 0), Vector3(1, 0, -1),
        Vector3(2, 2, 0), Vector3(-1, 1, 0), Vector3(0, -1, 1), Vector3(0, 2, 2), Vector3(2, 0, 2)})
    file.reals({p.x(), p.y(), p.z(), 0.5, 0.5});
  file.text("\n$EndNodes\n$Elements\n").sizes({3, 3, 1, 3});
  file.ints({0, 1, 15}).sizes({1, 1, 1});
  file.ints({3, 1, 11}).sizes({1, 2, 1, 2, 3, 4, 15, 16, 17, 18, 19, 20});
  file.ints({3, 2, 4}).sizes({1, 3, 1, 9, 3, 4}).text("\n$EndElements\n");
  return file.bytes();
}

class BinaryMsh : public ::testing::TestWithParam<std::endian> {};

TEST_P(BinaryMsh, HasTheTetrahedraOfItsVersion) {
  for (const std::string& file : {version_2(GetParam()), version_4(GetParam())}) {
    const VolumeMesh mesh = read_msh(file);
    ASSERT_EQ(mesh.tetrahedra.size(), 2U);
    EXPECT_THAT(mesh.groups, ElementsAre("right", "default"));
    for (const MeshGroup& tetrahedron : surfaces_of_tetrahedra(mesh))
      EXPECT_EQ(Polyhedron(tetrahedron.mesh).volume(), 8.0 / 6.0) << tetrahedron.name;
    // The common facet is inside.
    EXPECT_EQ(surface_of(mesh).triangles.size(), 6U);
    EXPECT_EQ(Polyhedron(surface_of(mesh)).volume(), 8.0 / 3.0);
  }
}

TEST_P(BinaryMsh, ThatEndsAnywhereIsRefused) {
  for (const std::string& file : {version_2(GetParam()), version_4(GetParam())}) {
    for (std::size_t size = 0; size + 1 < file.size(); ++size)
      EXPECT_THROW((void)read_msh(std::string_view(file).substr(0, size)), MeshFileError) << size;
    EXPECT_NO_THROW((void)read_msh(std::string_view(file).substr(0, file.size() - 1)));
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, BinaryMsh, ::testing::Values(std::endian::little, std::endian::big));

std::string refusal(const std::string& file) {
  try {
    (void)read_msh(file);
  } catch (const MeshFileError& error) {
    EXPECT_EQ(error.column(), 0) << "a column means nothing there";
    return std::to_string(error.line()) + ": " + error.what();
  }
  return "none";
}

TEST(BinaryMshFaults, HaveTheirByte) {
  const std::string head = "$MeshFormat\n2.2 1 8\n";
  const auto file = [&] { return Bytes(std::endian::little).text(head); };
  EXPECT_THAT(refusal(file().ints({2}).bytes()),
              HasSubstr("0: first number at byte 20 (2), must be 1, in either order of bytes"));
  auto nodes = file().ints({1}).text("\n$EndMeshFormat\n$Nodes\n1\n");
  EXPECT_THAT(refusal(Bytes(nodes).ints({0}).reals({0, 0, 0}).bytes()),
              HasSubstr("0: number of a node at byte 49 (0), allowed 1 to 2147483647"));
  EXPECT_THAT(refusal(Bytes(nodes).ints({5}).reals({0, 0, 1e200}).bytes()),
              HasSubstr("0: z coordinate at byte 69 (1e+200), allowed -1e150 to 1e150"));
  nodes.ints({5}).reals({0, 0, 0}).text("\n$EndNodes\n$Elements\n1\n");
  EXPECT_THAT(refusal(Bytes(nodes).ints({29, 1, 0}).bytes()),
              HasSubstr("(29), must be 4 or 11: tetrahedra with 4 or 10 nodes"));
  EXPECT_THAT(refusal(Bytes(nodes).ints({200, 1, 0}).bytes()),
              HasSubstr("type of an element at byte 100 (200)"));
  EXPECT_THAT(refusal(Bytes(nodes).ints({4, 2, 0}).bytes()), HasSubstr("(2), allowed 1 to 1"));
  EXPECT_THAT(refusal(Bytes(nodes).ints({4, 1, 0}).ints({1, 5, 6, 7, 8}).bytes()),
              HasSubstr("number of a node at byte 120 (6), no node of $Nodes has it"));
}

// The claimed number of nodes is never allocated.
TEST(BinaryMshFaults, CountsAreNotTrusted) {
  Bytes file(std::endian::little);
  file.text("$MeshFormat\n4.1 1 8\n").ints({1}).text("\n$EndMeshFormat\n$Nodes\n");
  file.sizes({2147483647, 2147483647, 1, 1}).ints({3, 1, 0}).sizes({2147483647});
  EXPECT_THAT(refusal(file.bytes()), HasSubstr("file ends before number of a node"));
}

}  // namespace
}  // namespace ashlar::binary_msh_test
