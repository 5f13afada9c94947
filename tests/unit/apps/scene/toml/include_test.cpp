#include "apps/scene/toml/include.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::include_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

// Files of a scene in a separate folder; the main one is main.toml.
class Include : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }
  Scene read(const std::vector<std::string>& overrides = {}) {
    Diagnostics diagnostics;
    Scene scene = read_scene(folder_ / "main.toml", overrides, diagnostics);
    faults_.clear();
    for (std::string fault : printed(diagnostics)) {
      const std::string prefix = folder_.path().string() + "/";
      for (std::size_t at = 0; (at = fault.find(prefix)) != std::string::npos;)
        fault.erase(at, prefix.size());
      faults_.push_back(fault);
    }
    return scene;
  }

  TemporaryFolder folder_;
  std::vector<std::string> faults_;
};

TEST_F(Include, JoinsListsAndMergesTables) {
  write("base.toml",
        "title = \"base\"\n[parameters]\nh = 1\nw = 2\n[analysis]\nend_time = 9\ntime_step = 0.5\n"
        "[[block]]\nname = \"A\"\nfixed = true\nbox = { min = [0, 0, 0], max = [\"=w\", \"=h\", 1] }\n");
  write("more.toml",
        "[parameters]\nw = 3\n[[block]]\nname = \"B\"\nfixed = true\n"
        "box = { min = [0, 0, 0], max = [1, 1, 1] }\n");
  write("main.toml",
        "include = [\"base.toml\", \"more.toml\"]\ntitle = \"main\"\n[parameters]\nh = 4\n"
        "[analysis]\nend_time = 2\n[[block]]\nname = \"C\"\nfixed = true\n"
        "box = { min = [0, 0, 0], max = [1, 1, 1] }\n");
  const Scene scene = read({"block.A.order=2"});
  EXPECT_THAT(faults_, IsEmpty());
  EXPECT_EQ(scene.title, "main");
  EXPECT_EQ(scene.analysis.end_time, 2.0);
  EXPECT_EQ(scene.analysis.time_step, 0.5);
  ASSERT_THAT(scene.block, SizeIs(3));
  EXPECT_EQ(scene.block[0].name + scene.block[1].name + scene.block[2].name, "ABC");
  EXPECT_EQ(std::get<SceneBox>(scene.block[0].shape).max, Vector3(3, 4, 1));
}

TEST_F(Include, PathsAreThoseOfTheFileThatSaysThem) {
  write("main.toml", "include = [\"parts/stone.toml\"]\n[analysis]\ntype = \"static\"\n");
  write("parts/stone.toml",
        "include = [\"../deeper/other.toml\"]\n[[block]]\nname = \"A\"\nfixed = true\n"
        "mesh = { file = \"a.off\" }\n");
  write("deeper/other.toml", "[[block]]\nname = \"B\"\nfixed = true\nmesh = { file = \"meshes/b.off\" }\n");
  const Scene scene = read();
  EXPECT_THAT(faults_, IsEmpty());
  ASSERT_THAT(scene.block, SizeIs(2));
  EXPECT_EQ(std::get<SceneMesh>(scene.block[0].shape).file, "deeper/meshes/b.off");
  EXPECT_EQ(std::get<SceneMesh>(scene.block[1].shape).file, "parts/a.off");
}

TEST_F(Include, FaultsNameTheFileThatHasThem) {
  write("main.toml", "include = [\"bad.toml\", \"worse.toml\"]\n" + sample());
  write("bad.toml", "[contact]\nfrction_angle = 3\n");
  write("worse.toml", "a = \n");
  (void)read();
  EXPECT_THAT(faults_,
              ElementsAre(StartsWith("worse.toml:1:5: error: malformed TOML"),
                          StartsWith("bad.toml:2:1: error: unknown key in contact (frction_angle)")));
}

TEST_F(Include, RefusesWhatCannotBeRead) {
  write("main.toml", "include = [\"none.toml\", 3, \"folder\"]\n" + sample());
  std::filesystem::create_directory(folder_ / "folder");
  (void)read();
  EXPECT_THAT(faults_,
              ElementsAre(StartsWith("main.toml:1:12: error: included file cannot be read (none.toml: "),
                          StartsWith("main.toml:1:25: error: include has the wrong type (3), "),
                          StartsWith("main.toml:1:28: error: included file cannot be read (folder: it is "
                                     "not a regular file)")));
  write("main.toml", "include = \"none.toml\"\n" + sample());
  (void)read();
  EXPECT_THAT(faults_,
              ElementsAre(StartsWith("main.toml:1:11: error: include has the wrong type (\"none.toml\"), "
                                     "an array")));
}

TEST_F(Include, RefusesCircles) {
  write("main.toml", "include = [\"a.toml\"]\n" + sample());
  write("a.toml", "include = [\"b.toml\"]\n");
  write("b.toml", "\ninclude = [\"../" + folder_.path().filename().string() + "/main.toml\"]\n");
  (void)read();
  EXPECT_THAT(faults_,
              ElementsAre("b.toml:2:12: error: circular include of files (main.toml -> a.toml -> b.toml -> "
                          "main.toml); remove one of them"));
}

TEST_F(Include, ReadsAFileOnce) {
  write("main.toml", "include = [\"a.toml\", \"b.toml\"]\n[analysis]\ntype = \"static\"\n");
  write("a.toml", "include = [\"c.toml\"]\n");
  write("b.toml", "include = [\"c.toml\"]\n");
  write("c.toml", "[[block]]\nname = \"C\"\nfixed = true\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n");
  const Scene scene = read();
  EXPECT_THAT(faults_, IsEmpty());
  EXPECT_THAT(scene.block, SizeIs(1));
}

TEST_F(Include, RefusesDeepNesting) {
  write("main.toml", "include = [\"0.toml\"]\n" + sample());
  for (int k = 0; k < 40; ++k)
    write(fmt::format("{}.toml", k), fmt::format("include = [\"{}.toml\"]\n", k + 1));
  write("40.toml", "");
  (void)read();
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("includes are nested too deeply")));
}

TEST_F(Include, CannotBeSet) {
  write("main.toml", sample());
  (void)read({"include=[\"a.toml\"]"});
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("include cannot be set")));
}

}  // namespace
}  // namespace ashlar::test::include_test
