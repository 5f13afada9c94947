#include "apps/scene/meshes/dxf_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar::test::dxf_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Triangle = std::array<int, 3>;

/// "0 3DFACE 8 L ..." as lines.
std::string lines(std::string words) {
  std::replace(words.begin(), words.end(), ' ', '\n');
  return words + "\n";
}

std::string drawing(const std::string& entities, const std::string& blocks = "") {
  std::string text;
  if (!blocks.empty()) text = lines("0 SECTION 2 BLOCKS") + blocks + lines("0 ENDSEC");
  return text + lines("0 SECTION 2 ENTITIES") + entities + lines("0 ENDSEC 0 EOF");
}

const std::string triangle =
    lines("0 3DFACE 8 L 10 0 20 0 30 0 11 1 21 0 31 0 12 0 22 1 32 0 13 0 23 1 33 0");

std::string block(const std::string& name, const std::string& entities,
                  const std::string& base = "10 0 20 0 30 0") {
  return lines("0 BLOCK 2 " + name + " " + base) + entities + lines("0 ENDBLK");
}

std::string refusal(const std::string& text) {
  try {
    (void)read_dxf(text).whole();
  } catch (const MeshFileError& error) {
    return fmt::format("{}: {}", error.line(), error.what());
  }
  return "taken";
}

/// An L of 3 m^2 (a square of 2 m without a quarter), clockwise, as a LWPOLYLINE; more pairs may follow.
std::string outline(const std::string& head, const std::string& more = "") {
  return lines("0 LWPOLYLINE 8 W 90 6 " + head +
               " 10 0 20 0 10 0 20 2 10 1 20 2 10 1 20 1 10 2 20 1 10 2 20 0" + more);
}

TEST(DxfReader, ClosedOutlinesWithAThicknessArePrisms) {
  for (const char* head : {"70 1 38 5 39 0.5", "70 129 38 5.5 39 -0.5"}) {
    const TriangleMesh mesh = read_dxf(drawing(outline(head))).whole();
    const Polyhedron body(mesh);
    EXPECT_EQ(body.volume(), 1.5) << head;
    EXPECT_EQ(body.faces().size(), 8U);
    double low = 9.0, high = 0.0;
    for (const Vector3& point : mesh.points) {
      low = std::min(low, point.z());
      high = std::max(high, point.z());
    }
    EXPECT_EQ(low, 5.0);
    EXPECT_EQ(high, 5.5);
  }
  // Its last point is its first one.
  EXPECT_EQ(Polyhedron(read_dxf(drawing(outline("70 0 39 2", " 10 0 20 0"))).whole()).volume(), 6.0);
  const std::string polyline = lines(
      "0 POLYLINE 8 W 66 1 70 1 10 0 20 0 30 3 39 2 0 VERTEX 10 0 20 0 30 3 0 VERTEX 10 1 20 0 30 3 0 VERTEX "
      "10 "
      "0 20 1 30 3 0 SEQEND");
  EXPECT_EQ(Polyhedron(read_dxf(drawing(polyline)).whole()).volume(), 1.0);
}

TEST(DxfReader, OtherOutlinesAreLines) {
  for (const char* head : {"70 1", "70 1 39 0", "70 0 39 2"})
    EXPECT_EQ(read_dxf(drawing(triangle + outline(head))).whole().triangles.size(), 1U) << head;
}

TEST(DxfReader, RefusesOutlinesThatAreNoPrisms) {
  EXPECT_EQ(refusal(drawing(outline("70 1 39 2", " 42 0.5"))),
            "6: arc in an outline with a thickness (bulge, 42), straight edges are needed");
  EXPECT_EQ(refusal(drawing(outline("70 1 39 2 210 1 220 0 230 0"))),
            "6: outline with a thickness in another plane than xy, allowed is the direction (0, 0, 1) (210, "
            "220, 230)");
  EXPECT_EQ(refusal(drawing(lines("0 LWPOLYLINE 8 W 70 1 39 2 10 0 20 0 10 1 20 0 10 1 20 0"))),
            "6: outline with a thickness has fewer than 3 corners, a polygon is needed");
}

TEST(DxfReader, OneLayerHasItsName) {
  const std::vector<MeshGroup> groups = read_dxf(drawing(triangle)).groups();
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].name, "L");
  EXPECT_THAT(groups[0].mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(groups[0].mesh.points[2], Vector3(0, 1, 0));
}

TEST(DxfReader, FourthCornersMayBeLeftOut) {
  EXPECT_EQ(read_dxf(drawing(lines("0 3DFACE 8 L 10 0 20 0 11 1 21 0 12 0 22 1"))).whole().triangles.size(),
            1U);
  EXPECT_EQ(read_dxf(drawing(lines("0 3DFACE 8 L 10 0 20 0 11 1 21 0 12 1 22 1 13 0 23 1")))
                .whole()
                .triangles.size(),
            2U);
}

TEST(DxfReader, InsertsAreScaledTurnedAndMovedAboutTheirBase) {
  const std::string blocks = block("B", triangle, "10 1 20 2 30 3");
  const TriangleMesh mesh =
      read_dxf(drawing(lines("0 INSERT 8 X 2 B 10 10 20 20 30 30 41 2 42 3 43 4 50 90"), blocks)).whole();
  // (x, y, z) - (1, 2, 3), times (2, 3, 4), a quarter turn, plus (10, 20, 30)
  EXPECT_THAT(mesh.points, ElementsAre(Vector3(16, 18, 18), Vector3(16, 20, 18), Vector3(13, 18, 18)));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(DxfReader, BlocksInBlocksAreLaidOut) {
  const std::string blocks =
      block("B", triangle) + block("C", lines("0 INSERT 2 B 10 1 0 INSERT 2 B 10 3 41 -1"));
  const std::vector<MeshGroup> groups = read_dxf(drawing(lines("0 INSERT 2 C 20 5"), blocks)).groups();
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_THAT(groups[0].mesh.points, ElementsAre(Vector3(1, 5, 0), Vector3(2, 5, 0), Vector3(1, 6, 0),
                                                 Vector3(3, 5, 0), Vector3(3, 6, 0)));
  // The mirrored one is turned, so that it still looks up.
  EXPECT_THAT(groups[0].mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 1}));
}

TEST(DxfReader, LayersStandInTheOrderOfTheirFirstFaces) {
  std::string other = triangle;
  other.replace(other.find("L"), 1, "M");
  const std::string blocks = block("B", other + triangle);
  std::vector<std::string> names;
  for (const MeshGroup& group : read_dxf(drawing(lines("0 INSERT 2 B 10 9") + triangle, blocks)).groups()) {
    names.push_back(group.name);
    EXPECT_EQ(group.mesh.triangles.size(), group.name == "L" ? 2U : 1U);
  }
  EXPECT_THAT(names, ElementsAre("L", "M"));  // those of blocks come last
}

TEST(DxfReader, LayersOfOlderDrawingsAreLatin1) {
  // Valid UTF-8 is kept; then: a byte of Latin-1, a cut character, one longer than needed, a surrogate, one too large.
  const std::vector<std::array<std::string, 2>> names = {
      {"L\xc3\xa9", "L\xc3\xa9"},
      {"\xf0\x9f\xa7\xb1", "\xf0\x9f\xa7\xb1"},
      {"St\xfctze", "St\xc3\xbctze"},
      {"\xe2\x82", "\xc3\xa2\xc2\x82"},
      {"\xc0\xaf", "\xc3\x80\xc2\xaf"},
      {"\xed\xa0\x80", "\xc3\xad\xc2\xa0\xc2\x80"},
      {"\xf4\x90\x80\x80", "\xc3\xb4\xc2\x90\xc2\x80\xc2\x80"}};
  for (const auto& [written, expected] : names) {
    std::string text = triangle;
    text.replace(text.find("L"), 1, written);
    EXPECT_EQ(read_dxf(drawing(text)).groups().front().name, expected);
  }
}

std::string vertex(const std::string& flags, const std::string& rest) {
  return lines("0 VERTEX 8 L " + rest + " 70 " + flags);
}

TEST(DxfReader, PolyfacesHaveIndicesWithSigns) {
  const std::string tetrahedron = lines("0 POLYLINE 8 P 66 1 70 64 71 4000000000 72 99999999999") +
                                  vertex("192", "10 0 20 0 30 0") + vertex("192", "10 1 20 0 30 0") +
                                  vertex("192", "10 0 20 1 30 0") + vertex("192", "10 0 20 0 30 1") +
                                  vertex("128", "71 1 72 3 73 -2") + vertex("128", "71 -1 72 -2 73 -4") +
                                  vertex("128", "71 2 72 3 73 4 74 0") + vertex("128", "71 3 72 1 73 4") +
                                  vertex("128", "71 1 72 2") + lines("0 SEQEND");
  const std::vector<MeshGroup> groups = read_dxf(drawing(tetrahedron)).groups();
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].name, "P");
  EXPECT_EQ(groups[0].mesh.triangles.size(), 4U);  // two corners are a line
  EXPECT_DOUBLE_EQ(Polyhedron(groups[0].mesh).volume(), 1.0 / 6.0);
}

/// A square ring about z with a square cross-section: 4 x 4 vertices, closed both ways.
std::string ring(const std::string& flags, const std::string& m, int vertices) {
  std::string text = lines("0 POLYLINE 8 R 70 " + flags + " 71 " + m + " 72 4");
  for (int k = 0; k < vertices; ++k) {
    const int side = k / 4;
    const double radius = k % 4 == 0 || k % 4 == 3 ? 2.0 : 1.0;
    text += vertex("64", fmt::format("10 {} 20 {} 30 {}", side == 0 || side == 3 ? radius : -radius,
                                     side < 2 ? radius : -radius, k % 4 < 2 ? 0 : 1));
  }
  return text + lines("0 SEQEND");
}

TEST(DxfReader, PolygonMeshesMayBeClosedBothWays) {
  EXPECT_EQ(read_dxf(drawing(ring("16", "4", 16))).whole().triangles.size(), 18U);
  EXPECT_EQ(read_dxf(drawing(ring("17", "4", 16))).whole().triangles.size(), 24U);
  const TriangleMesh mesh = read_dxf(drawing(ring("49", "4", 16))).whole();
  EXPECT_EQ(mesh.triangles.size(), 32U);
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.points[static_cast<std::size_t>(a)].dot(
                  mesh.points[static_cast<std::size_t>(b)].cross(mesh.points[static_cast<std::size_t>(c)])) /
              6.0;
  EXPECT_DOUBLE_EQ(std::abs(volume), 16.0 - 4.0);
  EXPECT_THAT(refusal(drawing(ring("49", "4", 15))), HasSubstr("polygon mesh of 4 x 4 vertices, it has 15"));
  EXPECT_THAT(refusal(drawing(ring("49", "4000000000", 16))),
              HasSubstr("polygon mesh of 4000000000 x 4 vertices"));
  EXPECT_THAT(refusal(drawing(ring("49 75 6", "4", 16))), HasSubstr("smoothed polygon mesh"));
}

TEST(DxfReader, DoublingAndCirclesAreBounded) {
  const auto twice = [](const std::string& name) {
    return lines("0 INSERT 2 " + name + " 0 INSERT 2 " + name);
  };
  std::string blocks = block("B0", triangle);
  std::string empty = block("B0", "");
  for (int k = 1; k <= 40; ++k) {
    blocks += block(fmt::format("B{}", k), twice(fmt::format("B{}", k - 1)));
    empty += block(fmt::format("B{}", k), twice(fmt::format("B{}", k - 1)));
  }
  for (const std::string& text : {blocks, empty})
    EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B40"), text)),
                HasSubstr("times, which is what is allowed"));
  EXPECT_EQ(read_dxf(drawing(lines("0 INSERT 2 B10"), blocks)).whole().triangles.size(), 1024U);
  EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B"), block("B", twice("B")))),
              HasSubstr("a block is in itself"));
}

TEST(DxfReader, FaultsAreNamedWithTheirLine) {
  EXPECT_EQ(refusal(drawing(triangle)), "taken");
  EXPECT_EQ(refusal("999\r\nby hand\r\n" + drawing(triangle)), "taken");
  EXPECT_THAT(refusal("AutoCAD Binary DXF\r\n"), HasSubstr("binary DXF, allowed are texts"));
  EXPECT_THAT(refusal("solid a\n"), HasSubstr("1: \"solid a\" is no group code"));
  EXPECT_THAT(refusal(lines("0 SECTION 2 ENTITIES") + triangle), HasSubstr("file ends before EOF"));
  EXPECT_THAT(refusal(lines("0 LINE")), HasSubstr("2: \"LINE\" must be SECTION or EOF"));
  EXPECT_THAT(refusal(drawing(lines("0 3DFACE 8 L 10 one"))), HasSubstr("10: \"one\" is no number"));
  EXPECT_THAT(refusal(drawing(lines("0 3DFACE 8 L 10 inf"))), HasSubstr("10: \"inf\" is no number"));
  EXPECT_THAT(refusal(drawing(lines("0 3DFACE 8 L 10 1e151"))), HasSubstr("10: \"1e151\" is too far"));
  EXPECT_THAT(refusal(drawing(lines("0 3DFACE 8 L 10 1 20 1"))), HasSubstr("6: 3DFACE without corner 2"));
  EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B"))),
              HasSubstr("6: INSERT of block \"B\", which the drawing does not"));
  EXPECT_THAT(refusal(drawing(triangle, block("B", triangle) + block("B", triangle))),
              HasSubstr("\"B\" is there twice"));
  const std::string blocks = block("B", triangle);
  EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B 70 2"), blocks)),
              HasSubstr("columns or rows of an INSERT"));
  EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B 230 -1"), blocks)), HasSubstr("another plane than xy"));
  EXPECT_THAT(refusal(drawing(lines("0 INSERT 2 B 43 0"), blocks)), HasSubstr("singular"));
  EXPECT_THAT(refusal(drawing(lines("0 POLYLINE 8 L 70 64 0 LINE"))),
              HasSubstr("\"LINE\" must be VERTEX or SEQEND"));
  EXPECT_THAT(refusal(drawing(lines("0 POLYLINE 8 L 70 64") + vertex("192", "10 0") +
                              vertex("128", "71 1 72 1 73 -2") + lines("0 SEQEND"))),
              HasSubstr("20: point index (-2) of a polyface with 1 points"));
  EXPECT_THAT(refusal(drawing(lines("0 LINE 8 L 10 0 20 0 11 1 21 1"))), HasSubstr("file has no faces"));
}

}  // namespace
}  // namespace ashlar::test::dxf_reader_test
