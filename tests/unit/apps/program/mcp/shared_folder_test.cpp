#include "apps/program/mcp/shared_folder.hpp"

#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"

namespace ashlar::shared_folder_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Shared : public ::testing::Test {
 protected:
  /// Makes the folder, and links in it and out of it.
  static fs::path made(const TemporaryFolder& outside) {
    const fs::path folder = outside / "models";
    fs::create_directories(folder / "walls");
    write_text(folder / "walls" / "a.toml", "x = 1\n");
    write_text(outside / "other.toml", "x = 1\n");
    fs::create_directory_symlink("..", folder / "out");
    fs::create_symlink("walls/a.toml", folder / "b.toml");
    fs::create_symlink("../other.toml", folder / "c.toml");
    fs::create_symlink("../none.toml", folder / "d.toml");
    return folder;
  }

  /// Message of a refusal; empty: the path was taken.
  template <class Call>
  static std::string refusal(Call call) {
    try {
      (void)call();
      return "";
    } catch (const ToolRefusal& refused) {
      return refused.what();
    }
  }

  TemporaryFolder outside_;
  SharedFolder folder_{made(outside_)};
};

TEST_F(Shared, PathsInsideAreRelativeToIt) {
  EXPECT_EQ(folder_.inside("walls/a.toml"), "walls/a.toml");
  EXPECT_EQ(folder_.inside("./walls//new.toml"), "walls/new.toml");
  EXPECT_EQ(folder_.inside("."), ".");
  EXPECT_EQ(folder_.file("b.toml"), "b.toml");
}

TEST_F(Shared, OthersAreRefusedWithWhatToDo) {
  for (const char* path :
       {"", "/etc/passwd", "..", "../other.toml", "walls/../../other.toml", "out/other.toml", "c.toml",
        "d.toml", "out", ".hidden", "walls/.hidden/a", "-rf", "a\nb", "a\x7f"})
    EXPECT_THAT(refusal([&] { return folder_.inside(path); }), HasSubstr("; give ")) << path;
  EXPECT_THAT(refusal([&] { return folder_.inside(std::string(1001, 'a')); }), HasSubstr("longer"));
  EXPECT_THAT(refusal([&] { return folder_.inside(std::string("a\0b", 3)); }), HasSubstr("control"));
  EXPECT_THAT(refusal([&] { return folder_.file("walls"); }), HasSubstr("no plain file"));
  EXPECT_THAT(refusal([&] { return folder_.file("none.toml"); }), HasSubstr("list_files"));
  EXPECT_THAT(refusal([&] { return folder_.results("walls"); }), HasSubstr("run_start"));
}

TEST_F(Shared, NewFilesReplaceNothingUnasked) {
  EXPECT_EQ(folder_.new_file("deep/er/new.toml", false), "deep/er/new.toml");
  EXPECT_TRUE(fs::is_directory(outside_ / "models" / "deep" / "er"));
  EXPECT_THAT(refusal([&] { return folder_.new_file("walls/a.toml", false); }), HasSubstr("replace: true"));
  EXPECT_EQ(folder_.new_file("walls/a.toml", true), "walls/a.toml");
  EXPECT_THAT(refusal([&] { return folder_.new_file("walls", true); }), HasSubstr("another name"));
  EXPECT_THAT(refusal([&] { return folder_.new_file("b.toml", true); }), HasSubstr("a link"));
  fs::create_directory(outside_ / "models" / "r.out");
  write_text(outside_ / "models" / "r.out" / ".ashlar", "");
  EXPECT_THAT(refusal([&] { return folder_.new_file("r.out/frames/a.csv", true); }),
              HasSubstr("result folder"));
}

}  // namespace
}  // namespace ashlar::shared_folder_test
