#include "apps/results/system/named_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <system_error>

#include "support/temporary_folder.hpp"

namespace ashlar::named_file_test {
namespace {

TEST(NamedFile, TellsKindsAndSizes) {
  const TemporaryFolder folder;
  write_text(folder / "a", "12345");
  std::filesystem::create_symlink(folder.path(), folder / "link");
  EXPECT_TRUE(named_file(folder / "a").is_plain);
  EXPECT_EQ(named_file(folder / "a").bytes, 5U);
  EXPECT_TRUE(named_file(folder.path()).is_folder);
  EXPECT_FALSE(named_file(folder / "link").is_folder);
  EXPECT_FALSE(named_file(folder / "link").is_plain);
}

TEST(NamedFile, IsTheSameUnderOtherNames) {
  const TemporaryFolder folder;
  write_text(folder / "a", "1");
  write_text(folder / "b", "1");
  std::filesystem::create_hard_link(folder / "a", folder / "c");
  EXPECT_FALSE(named_file(folder / "a").is_same_as(named_file(folder / "b")));
  EXPECT_TRUE(named_file(folder / "a").is_same_as(named_file(folder / "c")));
}

TEST(NamedFile, MustExist) {
  const TemporaryFolder folder;
  const std::string path = (folder / "none").string();
  EXPECT_THAT([&] { (void)named_file(path); }, testing::ThrowsMessage<std::system_error>(testing::StartsWith(
                                                   "cannot find " + path + ": No such file")));
}

TEST(NamedFile, AFolderHasTheNamesOfAllInIt) {
  const TemporaryFolder folder;
  EXPECT_TRUE(names_in(folder.path()).empty());
  write_text(folder / "a", "1");
  std::filesystem::create_directory(folder / "b");
  std::filesystem::create_symlink("nowhere", folder / ".c");
  EXPECT_THAT(names_in(folder.path()), testing::UnorderedElementsAre("a", "b", ".c"));
  const std::string path = (folder / "none").string();
  EXPECT_THAT([&] { (void)names_in(path); }, testing::ThrowsMessage<std::system_error>(testing::StartsWith(
                                                 "cannot read folder " + path + ": No such file")));
}

}  // namespace
}  // namespace ashlar::named_file_test
