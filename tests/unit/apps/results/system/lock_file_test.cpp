#include "apps/results/system/lock_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/temporary_folder.hpp"

namespace ashlar::lock_file_test {
namespace {

TEST(LockFile, IsCreatedOnceAndThenExists) {
  const TemporaryFolder folder;
  LockFile file;
  EXPECT_EQ(file.open(folder / "a", LockFile::Start::existing), std::errc::no_such_file_or_directory);
  EXPECT_FALSE(file.is_open());
  EXPECT_FALSE(file.open(folder / "a", LockFile::Start::created));
  EXPECT_TRUE(file.is_open());
  EXPECT_EQ(file.open(folder / "a", LockFile::Start::created), std::errc::file_exists);
  EXPECT_FALSE(file.open(folder / "a", LockFile::Start::existing));
}

TEST(LockFile, LinksAreNotFollowed) {
  const TemporaryFolder folder;
  write_text(folder / "a", "text");
  std::filesystem::create_symlink(folder / "a", folder / "b");
  LockFile file;
  EXPECT_TRUE(file.open(folder / "b", LockFile::Start::existing));
}

TEST(LockFile, OneHolderAtATime) {
  const TemporaryFolder folder;
  LockFile first, second;
  ASSERT_FALSE(first.open(folder / "a", LockFile::Start::created));
  ASSERT_FALSE(second.open(folder / "a", LockFile::Start::existing));
  EXPECT_FALSE(first.lock());
  EXPECT_EQ(second.lock(), std::errc::resource_unavailable_try_again);
  first.close();
  EXPECT_FALSE(second.lock());
}

TEST(LockFile, HoldsItsContent) {
  const TemporaryFolder folder;
  LockFile file;
  ASSERT_FALSE(file.open(folder / "a", LockFile::Start::created));
  EXPECT_FALSE(file.replace("a long text"));
  EXPECT_FALSE(file.replace("short"));
  EXPECT_EQ(read_text(folder / "a"), "short");
  EXPECT_EQ(file.start(3), "sho");
  EXPECT_EQ(file.start(100), "short");
  bool plain = false;
  std::uint64_t bytes = 0;
  EXPECT_FALSE(file.find_kind(plain, bytes));
  EXPECT_TRUE(plain);
  EXPECT_EQ(bytes, 5U);
}

TEST(LockFile, KnowsItsName) {
  const TemporaryFolder folder;
  LockFile file;
  ASSERT_FALSE(file.open(folder / "a", LockFile::Start::created));
  EXPECT_TRUE(file.is_at(folder / "a"));
  std::filesystem::rename(folder / "a", folder / "b");
  EXPECT_FALSE(file.is_at(folder / "a"));
  EXPECT_TRUE(file.is_at(folder / "b"));
  write_text(folder / "a", "another");
  EXPECT_FALSE(file.is_at(folder / "a"));
}

}  // namespace
}  // namespace ashlar::lock_file_test
