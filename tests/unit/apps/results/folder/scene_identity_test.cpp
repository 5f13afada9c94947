#include "apps/results/folder/scene_identity.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/results/folder/identity_json.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::scene_identity_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A tetrahedron of this height.
std::string tetrahedron(int height) {
  std::string mesh = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 ";
  mesh += std::to_string(height);
  mesh += "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  return mesh;
}

/// A scene of a mesh, a record and an included file.
class Identity : public ::testing::Test {
 protected:
  Identity() {
    write_text(folder_ / "stone.off", tetrahedron(1));
    write_text(folder_ / "push.csv", "t,f\n0,0\n1,1\n");
    write_text(folder_ / "more.toml", "[contact]\nfriction_angle = 30\n");
    write_text(folder_ / "scene.toml", R"(include = ["more.toml"]
title = "a"
[analysis]
end_time = 1
time_step = 0.1
[[material]]
name = "rock"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "stone"
material = "rock"
mesh = { file = "stone.off" }
[[block.load]]
point = [0, 0, 0]
force = [1, 0, 0]
history = { file = "push.csv", time = "t", values = ["f"] }
)");
  }

  [[nodiscard]] SceneIdentity identity(const std::vector<std::string>& overrides = {}) const {
    Diagnostics faults;
    const auto scene = load_scene(folder_ / "scene.toml", overrides, faults);
    if (!scene) throw std::invalid_argument(to_string(faults.sorted().front()));
    return scene_identity(*scene);
  }

  /// Reasons why results of what was read before are not those of what is there.
  [[nodiscard]] std::vector<std::string> differences(const std::vector<std::string>& overrides = {}) const {
    return identity_differences(was_, identity(overrides));
  }

  TemporaryFolder folder_;
  nlohmann::ordered_json was_;
};

TEST_F(Identity, NamesEachFileOnceWithItsHash) {
  const SceneIdentity found = identity();
  ASSERT_EQ(found.files.size(), 2U);
  EXPECT_EQ(found.files[0].kind + " " + found.files[0].file, "mesh stone.off");
  EXPECT_EQ(found.files[1].kind + " " + found.files[1].file, "record push.csv");
  for (const SceneFile& file : found.files) EXPECT_EQ(file.sha256.size(), 64U);
  EXPECT_EQ(found.version, program_version());
  EXPECT_EQ(found.checkpoint_layout, checkpoint_layout());
}

TEST_F(Identity, TheSameFilesAreTheSame) {
  was_ = to_json(identity());
  EXPECT_THAT(differences(), IsEmpty());
  // No result up to the end time depends on these keys.
  EXPECT_THAT(differences({"title=b", "analysis.end_time=2", "analysis.memory_limit=1e10"}), IsEmpty());
  EXPECT_THAT(differences({"analysis.time_step=0.2"}), ElementsAre("blocks or keys have changed"));
}

TEST_F(Identity, EachChangedFileIsTold) {
  was_ = to_json(identity());
  write_text(folder_ / "stone.off", tetrahedron(2));
  EXPECT_THAT(differences(), ElementsAre("mesh stone.off has changed"));
  write_text(folder_ / "push.csv", "t,f\n0,0\n1,2\n");
  EXPECT_THAT(differences(), ElementsAre("mesh stone.off has changed", "record push.csv has changed"));
  write_text(folder_ / "stone.off", tetrahedron(1));
  write_text(folder_ / "push.csv", "t,f\n0,0\n1,1\n");
  EXPECT_THAT(differences(), IsEmpty());
  write_text(folder_ / "more.toml", "[contact]\nfriction_angle = 31\n");
  EXPECT_THAT(differences(), ElementsAre("blocks or keys have changed"));
}

TEST_F(Identity, AnotherProgramIsAnotherIdentity) {
  was_ = to_json(identity());
  was_["version"] = "0.0.1";
  EXPECT_THAT(differences(),
              ElementsAre("the program has changed (was 0.0.1, is " + program_version() + ")"));
  was_ = to_json(identity());
  was_["checkpoint_layout"] = 1;
  EXPECT_THAT(differences(), ElementsAre("the program has changed (another layout of checkpoints)"));
  was_ = nullptr;
  EXPECT_EQ(differences().size(), 1U) << "summaries of earlier versions have none";
}

}  // namespace
}  // namespace ashlar::scene_identity_test
