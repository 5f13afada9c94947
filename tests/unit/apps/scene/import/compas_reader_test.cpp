#include "apps/scene/import/compas_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar::compas_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A mesh of COMPAS: the cube of edge 2 on the place z = 0, corners 0 to 7 in binary order.
const std::string cube = R"({"dtype": "compas.datastructures/Mesh", "data": {"attributes": {},
  "default_vertex_attributes": {"x": 0.0, "y": 0.0, "z": 0.0},
  "vertex": {"0": {"x": 0, "y": 0, "z": 0}, "1": {"x": 2, "y": 0, "z": 0}, "2": {"x": 0, "y": 2, "z": 0},
             "3": {"x": 2, "y": 2, "z": 0}, "4": {"x": 0, "y": 0, "z": 2}, "5": {"x": 2, "y": 0, "z": 2},
             "6": {"x": 0, "y": 2, "z": 2}, "17": {"x": 2, "y": 2, "z": 2}},
  "face": {"0": [0, 2, 3, 1], "1": [4, 5, 17, 6], "2": [0, 1, 5, 4], "3": [2, 6, 17, 3], "4": [0, 4, 6, 2],
           "5": [1, 3, 17, 5]},
  "facedata": {}, "edgedata": {}, "max_vertex": 17, "max_face": 5}})";

std::string assembly(const std::string& nodes) {
  return R"({"dtype": "compas_assembly.datastructures/Assembly", "data": {"attributes": {}, "graph":
    {"dtype": "compas.datastructures/Graph", "data": {"node": {)" +
         nodes + R"(}, "edge": {}}}}})";
}

/// Two blocks, 5 over 12, of one material.
std::string model(const std::string& more_of_5 = "") {
  const std::string raised = R"({"dtype": "compas.geometry/Transformation",
    "data": {"matrix": [[0, -1, 0, 2], [1, 0, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]}})";
  return R"({"dtype": "compas_dem.models/BlockModel", "data": {"transformation": null, "elements": {
    "guid-a": {"dtype": "compas_dem.elements/Block", "data": {"transformation": )" +
         raised + R"(, "features": [], "name": "Block", "material": "guid-m", "geometry": )" + cube +
         more_of_5 +
         R"(, "is_support": false}},
    "guid-b": {"dtype": "compas_dem.elements/Block", "data": {"transformation": null, "features": [],
      "material": "guid-m", "geometry": )" +
         cube + R"(, "is_support": true}}},
    "materials": {"guid-m": {"dtype": "compas_dem.material/Stone", "data": {"name": "lime stone", "density": 1800.0}}},
    "tree": {"root": {"children": [{"element": "guid-a"}, {"element": "guid-b"}]}},
    "graph": {"node": {"5": {"element": "guid-a"}, "12": {"element": "guid-b"}}, "edge": {"5": {"12": {}}}}}})";
}

std::string problem(const std::string& conditions, const std::string& contact = "null") {
  return R"({"dtype": "compas_dem.problem/Problem", "data": {"model": )" + model() +
         R"(, "boundary_conditions": {"dtype": "compas_dem.problem/BoundaryConditions", "data": {)" +
         conditions +
         R"(}}, "contact_properties": {"dtype": "compas_dem.interactions/ContactProperties", "data":
           {"contact_model": )" +
         contact + R"(, "joint_model": null}}}})";
}

TEST(CompasReader, AnAssemblyHasItsBlocksByNumber) {
  const ImportedModel read = read_compas(
      assembly(R"("10": {"block": )" + cube + R"(}, "9": {"block": )" + cube + R"(, "is_support": true})"));
  ASSERT_EQ(read.blocks.size(), 2U);
  EXPECT_EQ(read.blocks[0].name, "9");
  EXPECT_TRUE(read.blocks[0].fixed);
  EXPECT_FALSE(read.blocks[1].fixed);
  EXPECT_EQ(read.blocks[1].points[7], Vector3(2, 2, 2));
  EXPECT_EQ(centroid_of(read.blocks[1]), Vector3(1, 1, 1));
  EXPECT_EQ(*read.gravity, Vector3(0, 0, -9.81));
  EXPECT_NEAR(std::tan(*read.contact.friction_angle * std::numbers::pi / 180), 0.6, 1e-15);
  EXPECT_THAT(read.notes, Contains(HasSubstr("friction is not in the file")));
}

TEST(CompasReader, AModelPlacesItsElements) {
  const ImportedModel read = read_compas(model());
  ASSERT_EQ(read.blocks.size(), 2U);
  EXPECT_EQ(read.blocks[0].name, "5");
  // (x, y, z) -> (2 - y, x, z + 2): a quarter of a turn about z, on top of the other block.
  EXPECT_EQ(read.blocks[0].points[1], Vector3(2, 2, 2));
  EXPECT_EQ(read.blocks[0].points[6], Vector3(0, 0, 4));
  EXPECT_EQ(read.blocks[1].points[1], Vector3(2, 0, 0));
  EXPECT_TRUE(read.blocks[1].fixed);
  ASSERT_EQ(read.materials.size(), 1U);
  EXPECT_EQ(read.materials[0].name, "lime_stone");
  EXPECT_EQ(read.materials[0].density, 1800.0);
  EXPECT_THAT(read.left_out, ElementsAre(HasSubstr("contacts of 1 pairs")));
}

TEST(CompasReader, AProblemHasLoadsSupportsAndFriction) {
  const ImportedModel read = read_compas(problem(
      R"("gravity": true, "g": 10.0, "body_forces": [[1, 0, 0.5]],
         "point_loads": [{"block_index": 5, "force": [0, 0, -3], "moment": null, "point": [1, 2, 4], "loading_type": "ramp"},
                         {"block_index": 5, "force": [7, 0, 0], "moment": [0, 0, 6], "point": null, "loading_type": "ramp"}],
         "surface_loads": [{"block_index": 5, "magnitude": 100, "direction": null, "polygon":
           {"dtype": "compas.geometry/Polygon", "data": {"points": [[0, 0, 4], [0, 2, 4], [2, 2, 4], [2, 0, 4]]}}}],
         "displacements": [{"block_index": 12, "translation": [0, 0, 0], "rotation": [0, 0, 0]}])",
      R"({"dtype": "compas_dem.interactions/MohrCoulomb", "data": {"phi": 25.0, "c": 2e3, "t_c": null, "k_n": null,
          "k_t": null, "mu": 0.4663}})"));
  EXPECT_EQ(*read.gravity, Vector3(1, 0, -9.5));
  EXPECT_EQ(read.contact.friction_angle, 25.0);
  EXPECT_EQ(read.contact.cohesion, 2e3);
  EXPECT_FALSE(read.contact.tensile_strength);
  const ImportedBlock& loaded = read.blocks[0];
  EXPECT_TRUE(read.blocks[1].fixed);
  ASSERT_EQ(loaded.loads.size(), 5U);  // two forces, a couple of two, and the pressure
  EXPECT_EQ(loaded.loads[0].point, Vector3(1, 2, 4));
  EXPECT_EQ(loaded.loads[1].point, Vector3(1, 1, 3));
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (const ImportedLoad& load : loaded.loads) {
    force += load.force;
    moment += (load.point - Vector3(1, 1, 3)).cross(load.force);
  }
  // The polygon runs clockwise seen from above, so that its normal is downwards: 4 m^2 times 100 Pa at its centre.
  EXPECT_EQ(loaded.loads[4].point, Vector3(1, 1, 4));
  EXPECT_LT((force - Vector3(7, 0, -403)).norm(), 1e-12);
  // (0, 1, 1) x (0, 0, -3) = (-3, 0, 0), and the moment of 6 N m.
  EXPECT_LT((moment - Vector3(-3, 0, 6)).norm(), 1e-12);
}

TEST(CompasReader, SupportsThatMoveAndPartsThatAreLeftOut) {
  const ImportedModel read = read_compas(problem(
      R"("gravity": false, "g": 9.81, "body_forces": [], "point_loads": [], "surface_loads": [], "displacements":
         [{"block_index": 12, "translation": [0.1, 0, 0], "rotation": null},
          {"block_index": 5, "translation": [null, 0.1, null], "rotation": [0, 0.2, 0]}])"));
  EXPECT_FALSE(read.blocks[1].fixed);
  EXPECT_EQ(*read.blocks[1].displacement, Vector3(0.1, 0, 0));
  EXPECT_FALSE(read.blocks[0].displacement);
  EXPECT_THAT(read.left_out, Contains(HasSubstr("prescribed rotation of block 5")));
  EXPECT_THAT(read.left_out, Contains(HasSubstr("displacement of block 5 in some directions only")));
  EXPECT_THAT(read.notes, Contains(HasSubstr("has no gravity")));
  EXPECT_EQ(*read.gravity, Vector3(0, 0, -9.81));
}

TEST(CompasReader, OlderFormsAndMeshes) {
  const std::string older =
      R"({"assembly": {"vertex": {"0": {"is_support": true}, "1": {"is_support": false}}}, "blocks": {"0": )" +
      cube + R"(, "1": )" + cube + "}}";
  EXPECT_TRUE(read_compas(older).blocks[0].fixed);
  EXPECT_FALSE(read_compas(older).blocks[1].fixed);
  EXPECT_EQ(read_compas("[[" + cube + "], " + cube + "]").blocks.size(), 2U);
  // { dtype, value: { data } }
  EXPECT_EQ(read_compas(R"([{"dtype": "compas.datastructures/Mesh", "value": )" + cube + "}]").blocks.size(),
            1U);
  const std::string polyhedron =
      R"({"dtype": "compas.geometry/Polyhedron", "data": {"vertices": [[0, 0, 0], [3, 0, 0], [0, 3, 0],
    [0, 0, 3]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}})";
  EXPECT_EQ(centroid_of(read_compas(polyhedron).blocks[0]), Vector3(0.75, 0.75, 0.75));
}

std::string refusal(const std::string& text) {
  try {
    (void)read_compas(text);
  } catch (const MeshFileError& error) {
    return fmt::format("{}:{}: {}", error.line(), error.column(), error.what());
  }
  return "none";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(CompasReader, NamesTheMissingPart) {
  EXPECT_EQ(refusal("{\"dtype\":\n ]"), "2:2: text is no JSON from here on, a model of COMPAS is JSON");
  EXPECT_THAT(refusal(R"({"dtype": "compas.geometry/Frame", "data": {"point": [0, 0, 0]}})"),
              HasSubstr("file is a compas.geometry/Frame, allowed a Problem or BlockModel of compas_dem"));
  EXPECT_THAT(refusal("[1, 2]"), HasSubstr("is no model of COMPAS"));
  EXPECT_THAT(refusal("[]"), HasSubstr("file has no blocks"));
  EXPECT_THAT(
      refusal(replaced(model(),
                       "compas.datastructures/Mesh\", \"data\": {\"attributes\": {},\n  "
                       "\"default_vertex_attributes\": {\"x\": 0.0, \"y\": 0.0, \"z\": 0.0},\n  \"vertex\"",
                       "compas_occ.brep/OCCBrep\", \"data\": {\"faces\"")),
      HasSubstr(
          "data.elements.guid-a.data.geometry is a compas_occ.brep/OCCBrep, allowed a mesh or a polyhedron"));
  EXPECT_THAT(refusal(replaced(model(), "[0, 2, 3, 1]", "[0, 2, 3, 99]")),
              HasSubstr("face.0[3] is unknown (99), allowed a vertex of the mesh"));
  EXPECT_THAT(refusal(replaced(model(), "[0, 2, 3, 1]", "[0, 2]")),
              HasSubstr("has 2 corners, allowed at least 3"));
  EXPECT_THAT(refusal(replaced(model(), "\"material\": \"guid-m\"", "\"material\": \"other\"")),
              HasSubstr("guid-a.data.material is unknown (other), allowed one of the materials"));
  EXPECT_THAT(refusal(replaced(model(), "1800.0", "-1")), HasSubstr("density is -1, allowed a number > 0"));
  EXPECT_THAT(refusal(replaced(model(), "[0, 0, 0, 1]", "[0, 0, 1, 1]")), HasSubstr("is a projection"));
  EXPECT_THAT(refusal(model(R"(, "frame": {"point": [0, 0, 0]})")), HasSubstr("frame is given"));
  EXPECT_THAT(refusal(problem(R"("point_loads": [{"block_index": 7, "force": [0, 0, 1]}])")),
              HasSubstr("block_index is unknown (7), allowed the node of a block"));
  EXPECT_THAT(refusal(assembly(R"("1": {"block": null})")), HasSubstr("node.1 has no block"));
  EXPECT_THAT(refusal(assembly(R"("1": {"block": )" + replaced(cube, "\"x\": 2", "\"x\": 1e200") + "}")),
              HasSubstr("too far away"));
}

TEST(CompasReader, ThatEndsAnywhereIsRefused) {
  const std::string text = problem(R"("gravity": true, "g": 9.81)");
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THROW((void)read_compas(std::string_view(text).substr(0, size)), MeshFileError) << size;
}

}  // namespace
}  // namespace ashlar::compas_reader_test
