#include "geometry/mesh/volume_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/solid/polyhedron.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::volume_mesh_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The cube [0, 1]^3 in six tetrahedra about its diagonal; the last one is inside out.
const std::string nodes = R"(8
1 0 0 0
2 1 0 0
3 0 1 0
4 1 1 0
5 0 0 1
6 1 0 1
7 0 1 1
8 1 1 1
)";
const std::string version_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 9 "skin"
3 1 "lower half"
3 2 "upper"
$EndPhysicalNames
$Nodes
)" + nodes + R"($EndNodes
$Elements
7
1 2 2 9 1 1 2 3
2 4 2 1 1 1 2 4 8
3 4 2 1 1 1 4 3 8
4 4 2 1 1 1 3 7 8
5 4 2 2 1 1 7 5 8
6 4 2 2 1 1 5 6 8
7 4 2 3 1 6 1 2 8
$EndElements
)";
const std::string version_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Comments
anything
$EndComments
$PhysicalNames
1
3 7 "rock"
$EndPhysicalNames
$Entities
1 0 0 2
1 0 0 0 0
1 0 0 0 1 1 1 1 7 0
2 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 5 1 9
0 1 0 1
1
0 0 0
3 1 0 4
2
3
5
9
2 0 0
0 2 0
0 0 2
2 2 2
$EndNodes
$Elements
3 3 1 3
0 1 15 1
1 1
3 1 4 1
2 1 2 3 5
3 2 4 1
3 2 3 5 9
$EndElements
)";

double volume_of(const TriangleMesh& mesh) {
  return Polyhedron(mesh).volume();
}

TEST(VolumeMesh, TheSurfaceOfACubeOfTetrahedraIsTheCube) {
  const VolumeMesh mesh = read_msh(version_2);
  ASSERT_EQ(mesh.tetrahedra.size(), 6U);
  EXPECT_THAT(mesh.groups, ElementsAre("lower half", "upper", "3"));
  const TriangleMesh surface = surface_of(mesh);
  EXPECT_EQ(surface.triangles.size(), 12U);
  const Polyhedron cube(surface);
  EXPECT_EQ(cube.volume(), 1.0);
  EXPECT_EQ(cube.faces().size(), 6U);
  for (const MeshGroup& tetrahedron : surfaces_of_tetrahedra(mesh)) {
    EXPECT_EQ(volume_of(tetrahedron.mesh), 1.0 / 6.0) << tetrahedron.name;
    EXPECT_EQ(tetrahedron.mesh.points.size(), 4U);
  }
}

TEST(VolumeMesh, GroupsAreBodies) {
  const VolumeMesh mesh = read_msh(version_2);
  const std::vector<MeshGroup> bodies = surfaces_of_groups(mesh);
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_EQ(bodies[0].name, "lower half");
  EXPECT_EQ(volume_of(bodies[0].mesh), 0.5);
  EXPECT_NEAR(volume_of(bodies[1].mesh), 1.0 / 3.0, 1e-15);
  const VolumeMesh upper = only_group(mesh, "upper");
  EXPECT_EQ(upper.tetrahedra.size(), 2U);
  EXPECT_NEAR(volume_of(surface_of(upper)), 1.0 / 3.0, 1e-15);
  try {
    (void)only_group(mesh, "middle");
    FAIL();
  } catch (const MeshFileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("(middle), there are lower half, upper, 3"));
  }
}

TEST(VolumeMesh, EarlierVersionsHaveTheSameElements) {
  std::string text = version_2;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  const VolumeMesh newest = read_msh(text);
  replace("2.2 0 8", "2.1 0 8");
  EXPECT_EQ(read_msh(text).groups, newest.groups);
  EXPECT_EQ(read_msh(text).tetrahedra, newest.tetrahedra);
  // Names without dimensions.
  replace("2.1 0 8", "2 0 8");
  replace("2 9 \"skin\"\n3 1 \"lower half\"\n3 2 \"upper\"", "9 \"skin\"\n1 \"lower half\"\n2 \"upper\"");
  EXPECT_EQ(read_msh(text).groups, newest.groups);
  EXPECT_EQ(read_msh(text).tetrahedra, newest.tetrahedra);
  replace("2 0 8", "2.0 0 8");
  EXPECT_EQ(read_msh(text).groups, newest.groups);
}

TEST(VolumeMesh, Version4HasGroupsByVolume) {
  const VolumeMesh mesh = read_msh(version_4);
  EXPECT_THAT(mesh.groups, ElementsAre("rock", "default"));
  ASSERT_EQ(mesh.tetrahedra.size(), 2U);
  EXPECT_EQ(mesh.points[1], Vector3(2, 0, 0));
  // 2^3 / 6, and the regular tetrahedron of edge 2 sqrt(2): 8 / 3.
  EXPECT_EQ(volume_of(surfaces_of_tetrahedra(mesh)[0].mesh), 8.0 / 6.0);
  EXPECT_EQ(volume_of(surfaces_of_tetrahedra(mesh)[1].mesh), 8.0 / 3.0);
  EXPECT_EQ(volume_of(surface_of(mesh)), 4.0);
}

struct Fault {
  std::string from, to, says;
};

/// A file that is wrong in one place.
void expect_refused(std::string text, const Fault& fault) {
  const std::size_t place = text.find(fault.from);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, fault.from.size(), fault.to);
  try {
    (void)read_msh(text);
    FAIL() << "read";
  } catch (const MeshFileError& error) {
    EXPECT_THAT(std::to_string(error.line()) + ": " + error.what(), HasSubstr(fault.says));
  }
}

class BadMsh : public ::testing::TestWithParam<Fault> {};

TEST_P(BadMsh, IsRefusedAtItsPlace) {
  expect_refused(version_2, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    VolumeMesh, BadMsh,
    ::testing::Values(Fault{"2.2 0", "4.0 0", "2: version of the format (4.0), must be 2.0, 2.1, 2.2 or 4.1"},
                      Fault{"2.2 0", "2.2 2", "2: kind of file (2), must be 0, text, or 1, binary"},
                      Fault{"$MeshFormat", "$Mesh", "1: "}, Fault{"\"upper\"", "\"upper", "8: "},
                      Fault{"8 1 1 1", "7 1 1 1", "19: number of a node (7), is given twice"},
                      Fault{"8 1 1 1", "8 1 1 x", "19: z coordinate (x)"},
                      Fault{"6 4 2 2 1 1 5 6 8", "6 4 2 2 1 1 5 6 9", "number of a node (9), no node"},
                      Fault{"6 4 2 2 1 1 5 6 8", "6 4 2 2 1 1 5 5 8", "it has no volume"},
                      Fault{"6 4 2 2 1 1 5 6 8", "6 29 2 2 1 1 5 6 8",
                            "(29), must be 4 or 11: tetrahedra with 4 or 10 nodes"},
                      Fault{"6 4 2 2 1 1 5 6 8", "6 11 2 2 1 1 5 6 8 1 2 3 4 5",
                            "28: line ends before number of a node"},
                      Fault{"7 4 2 3 1 6 1 2 8\n", "", "number of an element ($EndElements)"},
                      Fault{"$EndElements", "", "file ends before $EndElements"},
                      Fault{"$Elements\n7", "$Elements\n1", "$EndElements"},
                      Fault{"$Nodes\n8", "$Nodes\n7", "19: "}, Fault{"$Nodes\n8", "$Nodes\n9", "20: "},
                      Fault{"6 4 2 2 1 1 5 6 8", "6 4 2 2 1 8 1 2 4",
                            "28: tetrahedron that ends here (4), the one of line 24 has the same nodes"},
                      Fault{"$EndElements\n", "$EndElements\n$PhysicalNames\n0\n$EndPhysicalNames\n",
                            "31: section ($PhysicalNames), must come before $Elements"}));

class BadMsh4 : public ::testing::TestWithParam<Fault> {};

TEST_P(BadMsh4, IsRefusedAtItsPlace) {
  expect_refused(version_4, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    VolumeMesh, BadMsh4,
    ::testing::Values(
        Fault{"3 2 4 1\n", "3 4 4 1\n", "38: number of a volume (4), $Entities does not list it"},
        Fault{"2 0 0 0 1 1 1 0 0", "1 0 0 0 1 1 1 0 0", "15: volume (0), $Entities lists it twice"},
        Fault{"2 5 1 9", "2 6 1 9", "18: $Nodes says that it has 6, its blocks have 5"},
        Fault{"3 3 1 3", "3 2 1 3", "33: $Elements says that it has 2, its blocks have 3"},
        Fault{"3 2 4 1\n3 2 3 5 9", "3 2 4 1\n3 5 3 2 1",
              "39: tetrahedron that ends here (1), the one of line 37 has the same nodes"},
        Fault{"3 2 4 1\n", "2 2 4 1\n", "38: "}));

/// Two tetrahedra as surfaces, each a group, and a group that is not needed.
const std::string surfaces = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "rock.1"
2 2 "rock.2"
$EndPhysicalNames
$Nodes
)" + nodes + R"($EndNodes
$Elements
8
1 2 2 1 1 1 3 2
2 2 2 1 1 1 2 5
3 2 2 1 1 2 3 5
4 2 2 1 1 1 5 3
5 2 2 2 2 8 7 6
6 2 2 2 2 8 6 4
7 2 2 2 2 8 4 7
8 2 2 2 2 6 7 4
$EndElements
)";

// As `ashlar blocks` writes them.
TEST(VolumeMesh, SurfacesOfAFileWithoutTetrahedraAreBodies) {
  const VolumeMesh mesh = read_msh(surfaces);
  EXPECT_TRUE(mesh.tetrahedra.empty());
  EXPECT_THAT(mesh.groups, ElementsAre("rock.1", "rock.2"));
  const std::vector<MeshGroup> bodies = surfaces_of_groups(mesh);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].name, "rock.1");
  EXPECT_EQ(volume_of(bodies[0].mesh), 1.0 / 6.0);
  EXPECT_EQ(volume_of(bodies[1].mesh), 1.0 / 6.0);
  EXPECT_EQ(surface_of(mesh).triangles.size(), 8U);
  EXPECT_EQ(volume_of(surface_of(only_group(mesh, "rock.2"))), 1.0 / 6.0);
  EXPECT_THROW((void)surfaces_of_tetrahedra(mesh), MeshFileError);
  std::string quads = surfaces;
  quads.replace(quads.find("8 2 2 2 2 6 7 4"), 15, "8 3 2 2 2 6 4 7 8");
  try {
    (void)read_msh(quads);
    FAIL();
  } catch (const MeshFileError& error) {
    EXPECT_EQ(error.line(), 29);
    EXPECT_THAT(error.what(), HasSubstr("no triangles with 3 or 6 nodes"));
  }
}

TEST(VolumeMesh, AFileWithoutTetrahedraIsRefused) {
  EXPECT_THROW((void)read_msh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), MeshFileError);
  EXPECT_THROW((void)read_msh(""), MeshFileError);
}

TEST(VolumeMesh, AFacetOfThreeTetrahedraIsRefused) {
  std::string text = version_2;
  const std::string last = "7 4 2 3 1 6 1 2 8\n";
  text.replace(text.find(last), last.size(), "7 4 2 3 1 1 4 8 6\n");
  EXPECT_THROW((void)surface_of(read_msh(text)), MeshFileError);
}

TEST(VolumeMesh, FilesAreReadByTheirEnding) {
  const TemporaryFolder folder;
  write_text(folder / "cube.msh", version_2);
  EXPECT_EQ(volume_of(read_mesh(folder / "cube.msh")), 1.0);
  EXPECT_EQ(read_mesh_groups(folder / "cube.msh").size(), 3U);
  EXPECT_EQ(read_volume_mesh(folder / "cube.msh").points.size(), 8U);
  EXPECT_THROW((void)read_volume_mesh(folder / "cube.obj"), MeshFileError);
}

}  // namespace
}  // namespace ashlar::volume_mesh_test
