#include "apps/scene/import/imported_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/scene/import/model_scene.hpp"

namespace ashlar::imported_model_test {
namespace {

using ::testing::HasSubstr;

/// The tetrahedron with the corners 0 and 4 along the axes: of 32 / 3 m^3 and the centroid (1, 1, 1).
ImportedBlock tetrahedron() {
  ImportedBlock block;
  block.name = "t";
  block.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  block.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return block;
}

TEST(ImportedModel, CentroidIsThatOfTheVolume) {
  EXPECT_EQ(centroid_of(tetrahedron()), Vector3(1, 1, 1));
  ImportedBlock flat = tetrahedron();
  for (Vector3& point : flat.points) point.z() = 0.0;
  EXPECT_EQ(centroid_of(flat), Vector3(1, 1, 0));
}

/// Resultant and moment about the centroid (1, 1, 1).
std::pair<Vector3, Vector3> resultant(const ImportedBlock& block) {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (const ImportedLoad& load : block.loads) {
    force += load.force;
    moment += (load.point - Vector3(1, 1, 1)).cross(load.force);
  }
  return {force, moment};
}

TEST(ImportedModel, AForceBesideTheBlockActsWithItsMoment) {
  ImportedBlock block = tetrahedron();
  add_load(block, {1, 1, 9}, {5, 0, 0}, {0, 0, 2});
  const auto [force, moment] = resultant(block);
  EXPECT_LT((force - Vector3(5, 0, 0)).norm(), 1e-14);
  // (0, 0, 8) x (5, 0, 0) = (0, 40, 0).
  EXPECT_LT((moment - Vector3(0, 40, 2)).norm(), 1e-13);
  const ImportedBox box = box_of(block);
  for (const ImportedLoad& load : block.loads) {
    EXPECT_TRUE((load.point.array() >= box.low.array()).all());
    EXPECT_TRUE((load.point.array() <= box.high.array()).all());
  }
}

TEST(ImportedModel, FacesAreTurned) {
  const ImportedBlock right = tetrahedron();
  ImportedBlock block = right;
  std::swap(block.faces[1][0], block.faces[1][1]);
  std::swap(block.faces[3][0], block.faces[3][2]);
  ImportedBlock outward = block;
  turn_outward(outward);
  turn_alike(block);
  const auto same = [](std::vector<int> a, const std::vector<int>& b) {
    std::rotate(a.begin(), std::find(a.begin(), a.end(), b.front()), a.end());
    return a == b;
  };
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_TRUE(same(block.faces[f], right.faces[f])) << f;
    EXPECT_TRUE(same(outward.faces[f], right.faces[f])) << f;
  }
}

TEST(ImportedModel, RoundingIsHalfTheLastDigit) {
  EXPECT_DOUBLE_EQ(rounding_of("1.5"), 0.05);
  EXPECT_DOUBLE_EQ(rounding_of("-0.4800000D+01"), 0.5e-6);
  EXPECT_DOUBLE_EQ(rounding_of("0.4800000E-01"), 0.5e-8);
  EXPECT_DOUBLE_EQ(rounding_of("15.52415"), 0.5e-5);
  EXPECT_DOUBLE_EQ(rounding_of("12"), 0.5);
  EXPECT_EQ(rounding_of("0.123456789012345"), 0.0);
}

TEST(ImportedModel, NamesAreThoseThatAnObjFileKeeps) {
  EXPECT_EQ(plain_name("lime stone/a*"), "lime_stone_a_");
  EXPECT_EQ(plain_name(""), "_");
}

TEST(ImportedModel, IsWrittenAsAScene) {
  ImportedModel model;
  model.title = "a \"wall\"\n";
  model.blocks = {tetrahedron(), tetrahedron()};
  model.blocks[1].name = "u";
  model.blocks[1].displacement = Vector3(0, 0, -0.1);
  model.materials = {{"m", 2000.0}};
  model.contact.friction_angle = 30.0;
  model.rounding = 0.5e-5;
  model.joints = {{"t", "u", {20.0, {}, {}, {}, {}}, true}};
  const std::string scene = scene_of(model, "wall.json", "wall.obj", "groups");
  EXPECT_THAT(scene, HasSubstr("title = \"a \\\"wall\\\" \"\n"));
  EXPECT_THAT(scene, HasSubstr("allowed_overlap = 2e-05"));
  EXPECT_THAT(scene, HasSubstr("end_time = 1\n"));
  EXPECT_THAT(
      scene, HasSubstr("[[joint]]\nblocks = [\"block.t\", \"block.u\"]\nfriction_angle = 20\ntied = true\n"));
  EXPECT_THAT(scene, HasSubstr("displacement_history = [[0, 0, 0, 0], [1, 0, 0, -0.1]]\n"));
  EXPECT_THAT(obj_of(model), HasSubstr("o u\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 5 7 6\n"));
}

}  // namespace
}  // namespace ashlar::imported_model_test
