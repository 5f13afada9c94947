#include "apps/scene/expand/mesh_blocks.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/assemble/scene_loading.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::mesh_blocks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Cubes of side 1 along x, as an OBJ file; face to face if `step` is 1. Some are inside out.
std::string cubes(int count, double step, const std::string& before, int turned = -1) {
  std::string text;
  for (int k = 0; k < count; ++k) {
    text += fmt::format("{}{}\n", before, k + 1);
    for (int corner = 0; corner < 8; ++corner)
      text += fmt::format("v {} {} {}\n", k * step + corner % 2, corner / 2 % 2, corner / 4);
    const std::vector<std::array<int, 4>> faces = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                                                   {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
    for (auto [a, b, c, d] : faces) {
      if (k == turned) std::swap(b, d);
      text += fmt::format("f {} {} {} {}\n", a + 8 * k, b + 8 * k, c + 8 * k, d + 8 * k);
    }
  }
  return text;
}

class MeshStones : public ::testing::Test {
 protected:
  std::optional<LoadedScene> load(const std::string& obj, const std::string& keys) {
    write_text(folder_ / "s.obj", obj);
    write_text(
        folder_ / "s.toml",
        "analysis = { type = \"static\" }\n[[block]]\nname = \"stones\"\nfixed = true\nmesh = { file = "
        "\"s.obj\", " +
            keys + " }\n");
    Diagnostics diagnostics;
    auto loaded = load_scene(folder_ / "s.toml", {}, diagnostics);
    faults_ = printed(diagnostics);
    return loaded;
  }

  TemporaryFolder folder_;
  std::vector<std::string> faults_;
};

TEST_F(MeshStones, ComponentsAreBlocks) {
  const auto loaded = load(cubes(5, 1.0, "# "), "split = \"components\", scale = 0.5");
  EXPECT_THAT(faults_, IsEmpty());
  ASSERT_TRUE(loaded);
  ASSERT_THAT(loaded->solids, SizeIs(5));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(loaded->scene.block[k].name, fmt::format("stones.{}", k + 1));
    EXPECT_EQ(loaded->solids[k].volume(), 0.125);
  }
  EXPECT_THAT(loaded->scene.notes, ElementsAre(HasSubstr("s.obj: 5 stones")));
}

TEST_F(MeshStones, WeldedStonesThatTouchStayApart) {
  const auto loaded = load(cubes(5, 1.0 + 1e-7, "# "), "split = \"components\", weld = 1e-6");
  EXPECT_THAT(faults_, IsEmpty());
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->solids, SizeIs(5));
  EXPECT_THAT(loaded->scene.notes, ElementsAre(HasSubstr("16 corners welded to others within 1e-06 m")));
}

TEST_F(MeshStones, GroupsAreBlocksByTheirNames) {
  const auto loaded = load(cubes(2, 3.0, "o arch stone "), "split = \"groups\"");
  EXPECT_THAT(faults_, IsEmpty());
  ASSERT_TRUE(loaded);
  ASSERT_THAT(loaded->scene.block, SizeIs(2));
  EXPECT_EQ(loaded->scene.block[1].name, "stones.arch stone 2");
}

TEST_F(MeshStones, AreTurnedWhereAsked) {
  EXPECT_FALSE(load(cubes(3, 2.0, "# ", 1), "split = \"components\""));
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("inside out")));
  const auto loaded = load(cubes(3, 2.0, "# ", 1), "split = \"components\", flip = \"auto\"");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->solids[1].volume(), 1.0);
  EXPECT_THAT(loaded->scene.notes, ElementsAre(HasSubstr("3 stones: 1 surface turned (2)")));
  EXPECT_TRUE(load(cubes(1, 2.0, "# ", 0), "flip = true"));
  EXPECT_FALSE(load(cubes(1, 2.0, "# "), "flip = true"));
}

TEST_F(MeshStones, AreRepairedWhereAsked) {
  std::string open = cubes(2, 2.0, "# ");
  open.erase(open.rfind("f "));
  EXPECT_FALSE(load(open, "split = \"components\""));
  const auto loaded = load(open, "split = \"components\", repair = true");
  EXPECT_THAT(faults_, IsEmpty());
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->solids[1].volume(), 1.0);
  EXPECT_THAT(loaded->scene.notes,
              ElementsAre(HasSubstr("2 stones: repaired: 1 holes filled with 2 triangles, 0 "
                                    "triangles left out, 0 surfaces turned")));
}

TEST_F(MeshStones, FaultsAreAtTheFile) {
  (void)load("v 0 0\n", "split = \"groups\"");
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("s.toml:5:17: error: mesh file cannot be used")));
  (void)load(cubes(2, 2.0, "# "), "weld = 1");
  EXPECT_THAT(faults_,
              ElementsAre(HasSubstr("mesh cannot be welded or repaired (weld is 1 in units of the file, ")));
  (void)load(cubes(2, 2.0, "# "), "flip = \"maybe\"");
  EXPECT_THAT(faults_,
              ElementsAre(HasSubstr("unknown flip (\"maybe\"), true or false or \"auto\" is needed")));
  (void)load(cubes(2, 2.0, "# "), "split = \"stones\"");
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("unknown split (\"stones\")")));
}

}  // namespace
}  // namespace ashlar::test::mesh_blocks_test
