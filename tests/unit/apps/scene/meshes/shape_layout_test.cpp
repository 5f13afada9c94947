#include "apps/scene/meshes/shape_layout.hpp"

#include <gmock/gmock.h>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::test::shape_layout_test {
namespace {

using ::testing::HasSubstr;
using SameName = ShapeLayout::SameName;

PolygonSoup cube(const Vector3& low = Vector3::Zero()) {
  const TriangleMesh mesh = make_box(low, low + Vector3::Ones());
  PolygonSoup soup;
  soup.points = mesh.points;
  for (const auto& triangle : mesh.triangles) {
    soup.corners.insert(soup.corners.end(), triangle.begin(), triangle.end());
    soup.face_ends.push_back(static_cast<int>(soup.corners.size()));
  }
  return soup;
}

Eigen::Affine3d moved(double x, double y, double z) {
  return Eigen::Affine3d(Eigen::Translation3d(x, y, z));
}

template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const MeshFileError& error) {
    return error.what();
  }
  return "taken";
}

TEST(ShapeLayout, NamesAreNumberedOrJoined) {
  for (const SameName same : {SameName::numbered, SameName::joined}) {
    ShapeLayout layout(same, {});
    const std::size_t shape = layout.add(cube());
    layout.place("a", shape, moved(0, 0, 0));
    layout.place("", shape, moved(2, 0, 0));
    layout.place("a", shape, moved(4, 0, 0));
    layout.place("a", shape, moved(6, 0, 0));
    const std::vector<MeshGroup> groups = layout.groups();
    ASSERT_EQ(groups.size(), same == SameName::numbered ? 4U : 2U);
    EXPECT_EQ(groups[0].name, "a");
    EXPECT_EQ(groups[1].name, "object");
    EXPECT_EQ(groups[0].mesh.triangles.size(), same == SameName::numbered ? 12U : 36U);
    if (same == SameName::joined) continue;
    EXPECT_EQ(groups[2].name, "a_2");
    EXPECT_EQ(groups[3].name, "a_3");
    EXPECT_EQ(groups[3].mesh.points.front(), Vector3(6, 0, 0));
  }
}

TEST(ShapeLayout, EqualPointsAreOneInTheOrderOfTheFile) {
  ShapeLayout layout(SameName::numbered, {});
  PolygonSoup soup = cube(Vector3(-1, 0, 0));
  soup.points.emplace_back(9, 9, 9);  // no face uses it
  const std::size_t shape = layout.add(std::move(soup));
  layout.place("a", shape, moved(0, 0, 0));
  layout.place("b", layout.add(cube()), moved(0, 0, 0));
  layout.place("c", shape, Eigen::Affine3d(Eigen::Scaling(-1.0, 1.0, 1.0)));  // its zeros are -0
  const TriangleMesh mesh = layout.whole();
  EXPECT_EQ(mesh.triangles.size(), 36U);
  ASSERT_EQ(mesh.points.size(), 12U);  // of a 8, of b 4 more, of c none
  const TriangleMesh first = make_box(Vector3(-1, 0, 0), Vector3(0, 1, 1));
  EXPECT_TRUE(std::equal(first.points.begin(), first.points.end(), mesh.points.begin()));
  EXPECT_EQ(layout.groups()[2].mesh.points.size(), 8U);
}

TEST(ShapeLayout, MirroredShapesKeepTheirOutside) {
  ShapeLayout layout(SameName::numbered, {});
  const std::size_t shape = layout.add(cube());
  layout.place("mirrored", shape, Eigen::Affine3d(Eigen::Scaling(1.0, -2.0, 1.0)));
  layout.place("turned", shape, Eigen::Affine3d(Eigen::Scaling(-1.0, -2.0, 1.0)));
  layout.place("tiny", shape, Eigen::Affine3d(Eigen::Scaling(-0x1p-400)));
  const std::vector<MeshGroup> groups = layout.groups();
  EXPECT_EQ(Polyhedron(groups[0].mesh).volume(), 2.0);
  EXPECT_EQ(Polyhedron(groups[1].mesh).volume(), 2.0);
  // The triangle of the cube that begins at its first corner has the opposite orientation.
  const TriangleMesh plain = make_box(Vector3::Zero(), Vector3::Ones());
  const std::array<int, 3> first = plain.triangles.front();
  EXPECT_EQ(groups[2].mesh.triangles.front(), (std::array{first[0], first[2], first[1]}));
}

TEST(ShapeLayout, PlacementsAndFacesAreCountedBeforeTheyAreMade) {
  ShapeLayout layout(SameName::numbered, {.faces = 24, .placements = 3});
  const std::size_t shape = layout.add(cube());
  const std::size_t empty = layout.add({});
  EXPECT_EQ(refusal([&] { (void)layout.whole(); }), "file has no faces");
  layout.place("none", empty, moved(0, 0, 0));
  layout.place("a", shape, moved(0, 0, 0));
  layout.place("b", shape, moved(2, 0, 0));
  EXPECT_EQ(layout.whole().triangles.size(), 24U);
  EXPECT_THAT(refusal([&] { layout.place("none", empty, moved(0, 0, 0)); }),
              HasSubstr("placed more than 3 times"));
  ShapeLayout faces(SameName::numbered, {.faces = 23, .placements = 9});
  faces.place("a", faces.add(cube()), moved(0, 0, 0));
  EXPECT_THAT(refusal([&] { faces.place("b", 0, moved(2, 0, 0)); }), HasSubstr("more than 23 faces"));
  EXPECT_NO_THROW(faces.require_room({9.0, 23.0}));
  EXPECT_THAT(refusal([&] { faces.require_room({10.0, 0.0}); }), HasSubstr("placed more than 9 times"));
  EXPECT_THAT(refusal([&] { faces.require_room({1.0, 1e300 * 1e300}); }), HasSubstr("more than 23 faces"));
}

TEST(ShapeLayout, LimitsGoWithTheBytesOfTheFile) {
  EXPECT_EQ(layout_limits(0).faces, 100'000U);
  EXPECT_EQ(layout_limits(0).placements, 25'000U);
  EXPECT_EQ(layout_limits(2'001).faces, 100'050U);
  EXPECT_EQ(layout_limits(20'000).faces, 1'000'000U);
  EXPECT_EQ(layout_limits(1'000'000).faces, 1'000'000U);
  EXPECT_EQ(layout_limits(4'000'000).faces, 4'000'000U);
  EXPECT_EQ(layout_limits(std::size_t{1} << 40U).faces, 500'000'000U);
}

TEST(ShapeLayout, NamesAndTransformationsAreChecked) {
  ShapeLayout layout(SameName::numbered, {});
  const std::size_t shape = layout.add(cube());
  const auto place = [&](const std::string& name, const Eigen::Affine3d& where) {
    return refusal([&] { layout.place(name, shape, where); });
  };
  EXPECT_EQ(place(std::string(longest_object_name, 'n'), moved(0, 0, 0)), "taken");
  EXPECT_THAT(place(std::string(longest_object_name + 1, 'n'), moved(0, 0, 0)),
              HasSubstr("name of 1001 bytes"));
  EXPECT_THAT(place("a\nb", moved(0, 0, 0)), HasSubstr("control character"));
  EXPECT_EQ(place("\xc3\xa9", moved(0, 0, 0)), "taken");
  EXPECT_THAT(place("flat", Eigen::Affine3d(Eigen::Scaling(1.0, 0.0, 1.0))), HasSubstr("singular"));
  EXPECT_THAT(place("far", moved(0, 2e150, 0)), HasSubstr("too large"));
  EXPECT_THAT(place("none", moved(0, std::nan(""), 0)), HasSubstr("too large"));
  EXPECT_EQ(place("large", Eigen::Affine3d(Eigen::Translation3d(0, 0, 1e150) * Eigen::Scaling(1e150))),
            "taken");
  EXPECT_THAT(refusal([&] { (void)layout.whole(); }), HasSubstr("coordinate of a placed object"));
}

}  // namespace
}  // namespace ashlar::test::shape_layout_test
