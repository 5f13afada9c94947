#include "geometry/text/reading_folder.hpp"

#include <gmock/gmock.h>

#include "geometry/mesh/mesh_io.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::reading_folder_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Limits reading while it exists.
class Limit {
 public:
  explicit Limit(const std::vector<fs::path>& folders) { limit_reading_to(folders); }
  ~Limit() { limit_reading_to({}); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
};

TEST(IsBelow, FollowsLinksAndNeedsNoFile) {
  const TemporaryFolder outside;
  const fs::path root = fs::canonical(outside / "");
  const fs::path folder = root / "models";
  fs::create_directories(folder / "in");
  fs::create_directories(root / "models and more");
  fs::create_directory_symlink(root, folder / "out");
  fs::create_directory_symlink(folder / "in", root / "way_in");
  for (const fs::path& inside :
       {folder, folder / "in", folder / "new" / "file", folder / "in" / "..", root / "way_in" / "file"})
    EXPECT_TRUE(is_below(inside, folder)) << inside;
  for (const fs::path& other :
       {root, folder / "..", folder / "out" / "file", root / "models and more",
        folder / "in" / ".." / ".." / "file", fs::path("/etc/passwd"), fs::path("file")})
    EXPECT_FALSE(is_below(other, folder)) << other;
}

TEST(RefusalToRead, IsOfFilesOutsideOfAllFolders) {
  const TemporaryFolder one, other, outside;
  write_text(outside / "cube.off", "OFF\n");
  EXPECT_EQ(refusal_to_read(outside / "cube.off"), "");
  const Limit limit({one / "", other / ""});
  EXPECT_EQ(refusal_to_read(one / "cube.off"), "");
  EXPECT_EQ(refusal_to_read(other / "deep" / "cube.off"), "");
  EXPECT_THAT(refusal_to_read(outside / "cube.off"), HasSubstr("only files below it are read"));
  try {
    (void)read_mesh(outside / "cube.off");
    FAIL() << "a mesh outside was read";
  } catch (const MeshFileError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("outside of the folder"));
  }
  // The message does not tell if the file outside exists.
  try {
    (void)read_mesh(outside / "none.off");
    FAIL();
  } catch (const MeshFileError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("outside of the folder"));
  }
}

}  // namespace
}  // namespace ashlar::reading_folder_test
