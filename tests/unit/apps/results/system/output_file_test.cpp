#include "apps/results/system/output_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "support/temporary_folder.hpp"

namespace ashlar::output_file_test {
namespace {

using Start = OutputFile::Start;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FaultOfDevice, IsAFullDiskAndNoNameOrPermission) {
  EXPECT_TRUE(is_fault_of_device(std::make_error_code(std::errc::no_space_on_device)));
  EXPECT_TRUE(is_fault_of_device({EDQUOT, std::generic_category()}));
  EXPECT_TRUE(is_fault_of_device({ENOSPC, std::system_category()}));
  EXPECT_FALSE(is_fault_of_device(std::make_error_code(std::errc::permission_denied)));
  EXPECT_FALSE(is_fault_of_device(std::make_error_code(std::errc::no_such_file_or_directory)));
  EXPECT_FALSE(is_fault_of_device({}));
}

TEST(OutputFile, WritesCanBeReadBeforeItIsClosed) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a", Start::empty);
  file.write("one\n");
  file.write("two\n");
  EXPECT_EQ(read_text(folder / "a"), "one\ntwo\n");
  EXPECT_EQ(file.size(), 8U);
}

TEST(OutputFile, StartsEmptyOrAtTheEnd) {
  const TemporaryFolder folder;
  write_text(folder / "a", "old");
  OutputFile(folder / "a", Start::at_end).write("+new");
  EXPECT_EQ(read_text(folder / "a"), "old+new");
  OutputFile(folder / "a", Start::empty).write("new");
  EXPECT_EQ(read_text(folder / "a"), "new");
}

TEST(OutputFile, GoesOnWhereItWasTruncated) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a", Start::empty);
  file.write("abcdef");
  file.truncate(2);
  file.write("X");
  EXPECT_EQ(read_text(folder / "a"), "abX");
  EXPECT_EQ(file.size(), 3U);
}

TEST(OutputFile, MovesKeepTheFileOpen) {
  const TemporaryFolder folder;
  OutputFile first(folder / "a", Start::empty);
  first.write("1");
  OutputFile second(std::move(first));
  second.write("2");
  OutputFile third(folder / "b", Start::empty);
  third = std::move(second);
  third.write("3");
  EXPECT_EQ(read_text(folder / "a"), "123");
}

TEST(OutputFile, LinksAreNotFollowedAndPipesDoNotWait) {
  const TemporaryFolder folder;
  write_text(folder / "mine", "mine");
  std::filesystem::create_symlink(folder / "mine", folder / "link");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const Start start : {Start::empty, Start::at_end}) {
    EXPECT_THAT([&] { OutputFile(folder / "link", start); },
                ThrowsMessage<std::runtime_error>(HasSubstr("link: ")));
    EXPECT_THAT([&] { OutputFile(folder / "pipe", start); },
                ThrowsMessage<std::runtime_error>(HasSubstr("pipe: ")));
  }
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_THROW(OutputFile(folder / "pipe", Start::empty), std::runtime_error) << "with a reader";
  ::close(reader);
  EXPECT_EQ(read_text(folder / "mine"), "mine");
}

TEST(OutputFile, WhatOthersCutOrAddIsNoticed) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a", Start::empty);
  file.write("abcdef");
  EXPECT_NO_THROW(file.check_in_place());
  for (const std::uintmax_t bytes : {0U, 5U, 7U}) {
    std::filesystem::resize_file(folder / "a", bytes);
    EXPECT_THAT([&] { file.check_in_place(); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("it has " + std::to_string(bytes) + " bytes, 6 were written")));
  }
}

TEST(OutputFile, CreatedOnlyWhereNothingIs) {
  const TemporaryFolder folder;
  OutputFile(folder / "a", Start::created).write("a");
  EXPECT_THROW(OutputFile(folder / "a", Start::created), std::runtime_error);
  std::filesystem::create_symlink(folder / "nowhere", folder / "link");
  EXPECT_THROW(OutputFile(folder / "link", Start::created), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
  EXPECT_EQ(read_text(folder / "a"), "a");
}

TEST(OutputFile, MissesItsFile) {
  const TemporaryFolder folder;
  const OutputFile file(folder / "a", Start::empty);
  EXPECT_NO_THROW(file.check_in_place());
  std::filesystem::rename(folder / "a", folder / "b");
  EXPECT_THAT([&] { file.check_in_place(); }, ThrowsMessage<std::runtime_error>(HasSubstr("No such file")));
  write_text(folder / "a", "another");
  EXPECT_THAT([&] { file.check_in_place(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a was replaced while it was being written")));
}

TEST(OutputFile, NamesThePathAndTheReason) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { OutputFile(folder / "none/a", Start::empty); },
              ThrowsMessage<std::runtime_error>(HasSubstr((folder / "none/a").string() + ": No such file")));
  EXPECT_THAT([&] { OutputFile(folder / "missing", Start::at_end); },
              ThrowsMessage<std::runtime_error>(HasSubstr("missing: No such file")));
  EXPECT_THAT([&] { OutputFile(folder.path(), Start::empty); },
              ThrowsMessage<std::runtime_error>(HasSubstr(": Is a directory")));
}

TEST(OutputFile, ReportsAFullDisk) {
  OutputFile file("/dev/full", Start::at_end);
  EXPECT_THAT([&] { file.write("x"); },
              ThrowsMessage<std::runtime_error>("cannot write /dev/full: No space left on device"));
}

// A limit on the file size makes the system accept a part of a write and refuse the rest, as a full disk
// does.
TEST(OutputFile, TakesBackAWriteThatWasCutShort) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a", Start::empty);
  file.write("whole\n");
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit limited = old;
  limited.rlim_cur = 10;
  const auto old_handler = signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  EXPECT_THROW(file.write("too long\n"), std::runtime_error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  signal(SIGXFSZ, old_handler);
  EXPECT_EQ(read_text(folder / "a"), "whole\n");
  file.write("next\n");
  EXPECT_EQ(read_text(folder / "a"), "whole\nnext\n");
}

}  // namespace
}  // namespace ashlar::output_file_test
