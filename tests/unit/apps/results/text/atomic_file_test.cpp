#include "apps/results/text/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace ashlar::atomic_file_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class AtomicFile : public testing::TestWithParam<Durability> {};

TEST_P(AtomicFile, ReplacesTheContentAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string binary("a\0b\r\n", 5);
  write_file_atomically(folder / "a", "first, longer than the second", GetParam());
  write_file_atomically(folder / "a", binary, GetParam());
  EXPECT_EQ(read_text(folder / "a"), binary);
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST_P(AtomicFile, ReplacesTheRemainsOfAKilledRun) {
  const TemporaryFolder folder;
  write_text(folder / "a.tmp", "half of the conte");
  write_file_atomically(folder / "a", "new", GetParam());
  EXPECT_EQ(read_text(folder / "a"), "new");
  EXPECT_EQ(folder.entry_count(), 1U);
}

// Readers of the old file continue to read it: the new one is another file, not an overwritten one.
TEST_P(AtomicFile, DoesNotTouchTheOldFile) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old content", GetParam());
  std::filesystem::create_hard_link(folder / "a", folder / "reader");
  write_file_atomically(folder / "a", "new", GetParam());
  EXPECT_EQ(read_text(folder / "reader"), "old content");
}

TEST_P(AtomicFile, PipesAndDevicesAreNotReplaced) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT([&] { write_file_atomically(folder / "pipe", "x", GetParam()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("pipe, which is no regular file")));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_EQ(folder.entry_count(), 1U);
}

// In a shared folder someone else may have made a link of the temporary name.
TEST_P(AtomicFile, DoesNotFollowLinks) {
  const TemporaryFolder folder;
  write_text(folder / "mine", "mine");
  std::filesystem::create_symlink(folder / "mine", folder / "a.tmp");
  EXPECT_THAT([&] { write_file_atomically(folder / "a", "x", GetParam()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a.tmp, which is no regular file")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.tmp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  std::filesystem::create_symlink(folder / "mine", folder / "b");
  write_file_atomically(folder / "b", "x", GetParam());
  EXPECT_EQ(read_text(folder / "b"), "x");
  EXPECT_EQ(read_text(folder / "mine"), "mine");
  EXPECT_THROW(write_file_atomically("", "x", GetParam()), std::runtime_error);
}

TEST_P(AtomicFile, TakesContentInPiecesAndNothingOfWhatFails) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", GetParam(), [](OutputFile& file) {
    file.write("one, ");
    file.write("two");
  });
  EXPECT_EQ(read_text(folder / "a"), "one, two");
  const auto fails = [](OutputFile& file) {
    file.write("three");
    throw std::runtime_error("no more");
  };
  EXPECT_THAT([&] { write_file_atomically(folder / "a", GetParam(), fails); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no more")));
  EXPECT_EQ(read_text(folder / "a"), "one, two");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST_P(AtomicFile, FailsWithoutATrace) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THAT([&] { write_file_atomically(folder / "taken", "x", GetParam()); },
              ThrowsMessage<std::runtime_error>(HasSubstr((folder / "taken").string())));
  EXPECT_EQ(folder.entry_count(), 1U);
  EXPECT_THAT([&] { write_file_atomically(folder / "none/a", "x", GetParam()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("No such file or directory")));
  EXPECT_EQ(folder.entry_count(), 1U);
}

INSTANTIATE_TEST_SUITE_P(All, AtomicFile, testing::Values(Durability::process, Durability::power));

TEST(AtomicFile, OnlyFilesOfItsKindMayBeReplaced) {
  const TemporaryFolder folder;
  const auto path = folder / "picture.png";
  const auto refuse = [&] { refuse_other_file(path, {"PNG picture", {"\x89PNG", "other"}}); };
  EXPECT_NO_THROW(refuse()) << "it is not there";
  write_text(path, "");
  EXPECT_NO_THROW(refuse()) << "nothing is lost";
  write_text(path, "\x89PNG\r\n...");
  EXPECT_NO_THROW(refuse());
  write_text(path, "precious");
  EXPECT_THAT(refuse, ThrowsMessage<std::invalid_argument>(HasSubstr(
                          "picture.png is in the way: it is no PNG picture, another name is needed")));
  EXPECT_EQ(read_text(path), "precious");
}

}  // namespace
}  // namespace ashlar::atomic_file_test
