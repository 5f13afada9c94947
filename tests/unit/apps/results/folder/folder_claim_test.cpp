#include "apps/results/folder/folder_claim.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>

#include "support/temporary_folder.hpp"

namespace ashlar::folder_claim_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

auto claiming(const std::filesystem::path& folder, ClaimPurpose purpose = ClaimPurpose::new_run) {
  return [folder, purpose] { const FolderClaim claim(folder, purpose); };
}

auto refuses_with(const std::string& text) {
  return ThrowsMessage<ClaimRefused>(HasSubstr(text));
}

TEST(FolderClaim, HasNewEmptyAndOwnFolders) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "empty");
  for (const char* name : {"new/deep", "empty"}) {
    EXPECT_NO_THROW(claiming(folder / name)());
    EXPECT_NO_THROW(claiming(folder / name)()) << "again";
  }
  write_text(folder / "empty/notes.txt", "of the user, in a folder of ours");
  EXPECT_NO_THROW(claiming(folder / "empty")());
}

TEST(FolderClaim, ASecondOneIsRefusedByTheNameOfTheProcess) {
  const TemporaryFolder folder;
  const FolderClaim claim(folder / "out", ClaimPurpose::new_run);
  EXPECT_EQ(claim.unlocked(), "");
  for (const ClaimPurpose purpose :
       {ClaimPurpose::new_run, ClaimPurpose::replacement, ClaimPurpose::resume}) {
    EXPECT_THAT(
        claiming(folder / "out", purpose),
        ThrowsMessage<ClaimRefused>(AllOf(HasSubstr((folder / "out").string() + " is in use by process " +
                                                    std::to_string(::getpid()) + " on host "))));
  }
}

TEST(FolderClaim, EndsWithItsProcessHoweverThatEnds) {
  const TemporaryFolder folder;
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const FolderClaim claim(folder / "out", ClaimPurpose::new_run);
    (void)!::write(ready[1], "x", 1);
    while (true) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(claiming(folder / "out"), refuses_with("in use by process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(claiming(folder / "out")());
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FolderClaim, WhatOthersWroteIsLeftAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "theirs");
  for (const char* name : {"checkpoint", "summary.json", "history.csv", "notes.txt"}) {
    write_text(folder / "theirs" / name, "theirs");
    for (const ClaimPurpose purpose :
         {ClaimPurpose::new_run, ClaimPurpose::replacement, ClaimPurpose::resume, ClaimPurpose::addition}) {
      EXPECT_THAT(claiming(folder / "theirs", purpose),
                  refuses_with("is not empty and was not made by ashlar"));
    }
    EXPECT_EQ(read_text(folder / "theirs" / name), "theirs");
    std::filesystem::remove(folder / "theirs" / name);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "theirs"));
  write_text(folder / "file", "");
  EXPECT_THAT(claiming(folder / "file"), refuses_with("Not a directory"));
  EXPECT_THAT(claiming(""), refuses_with("without a name"));
}

TEST(FolderClaim, ResultsAreKeptUnlessTheyAreToBeReplaced) {
  for (const char* name : {"checkpoint", "summary.json"}) {
    const TemporaryFolder folder;
    claiming(folder / "out")();
    write_text(folder / "out" / name, "");
    EXPECT_THAT(claiming(folder / "out"), refuses_with("--force"));
    for (const ClaimPurpose purpose :
         {ClaimPurpose::replacement, ClaimPurpose::resume, ClaimPurpose::addition})
      EXPECT_NO_THROW(claiming(folder / "out", purpose)());
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << "a claim alone changes nothing";
  }
}

TEST(FolderClaim, ResultsWithoutMarkerAreThoseOfAnEarlierVersion) {
  const TemporaryFolder folder;
  for (const char* name : {"with_checkpoint", "killed"}) std::filesystem::create_directory(folder / name);
  write_text(folder / "with_checkpoint/checkpoint", "ashlar checkpoint\n...");
  write_text(folder / "killed/history.csv", "step,time,dt,energy.kinetic\n");
  write_text(folder / "killed/blocks.pvd", "");
  write_text(folder / "killed/contacts.csv", "");
  for (const char* name : {"with_checkpoint", "killed"}) {
    EXPECT_THAT(claiming(folder / name), refuses_with("results of an earlier version"));
    EXPECT_NO_THROW(claiming(folder / name, ClaimPurpose::replacement)());
  }
}

TEST(FolderClaim, LinksAndPipesInTheWayAreNamed) {
  const TemporaryFolder folder;
  write_text(folder / "mine", "mine");
  std::filesystem::create_directory(folder / "my_folder");
  for (const char* name : {"history.csv", "contacts.csv", "checkpoint.tmp", "frames"}) {
    const auto out = folder / (std::string("out.") + name);
    claiming(out)();
    std::filesystem::create_symlink(folder / (name == std::string("frames") ? "my_folder" : "mine"),
                                    out / name);
    EXPECT_THAT(claiming(out, ClaimPurpose::replacement), refuses_with((out / name).string()));
    std::filesystem::remove(out / name);
    ASSERT_EQ(::mkfifo((out / name).c_str(), 0600), 0);
    EXPECT_THAT(claiming(out, ClaimPurpose::replacement), refuses_with((out / name).string()));
  }
  std::filesystem::create_directory(folder / "linked");
  std::filesystem::create_symlink(folder / "mine", folder / "linked/.ashlar");
  EXPECT_THAT(claiming(folder / "linked"), refuses_with(".ashlar"));
  std::filesystem::create_directory(folder / "strange");
  write_text(folder / "strange/.ashlar", "something else");
  EXPECT_THAT(claiming(folder / "strange"), refuses_with(".ashlar is in the way"));
  EXPECT_EQ(read_text(folder / "strange/.ashlar"), "something else");
  EXPECT_EQ(read_text(folder / "mine"), "mine");
}

TEST(FolderClaim, MissesItsFolder) {
  const TemporaryFolder folder;
  const FolderClaim claim(folder / "out", ClaimPurpose::new_run);
  EXPECT_NO_THROW(claim.check());
  std::filesystem::remove_all(folder / "out");
  EXPECT_THROW(claim.check(), std::runtime_error);
  claiming(folder / "out")();
  EXPECT_THROW(claim.check(), std::runtime_error) << "another one's by now";
}

}  // namespace
}  // namespace ashlar::folder_claim_test
