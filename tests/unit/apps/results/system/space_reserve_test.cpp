#include "apps/results/system/space_reserve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace ashlar::space_reserve_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

// tests/endurance tests it on a full disk.
TEST(SpaceReserve, LeavesNothingInTheFolder) {
  const TemporaryFolder folder;
  SpaceReserve reserve(folder.path());
  reserve.hold(100000);
  EXPECT_EQ(reserve.held(), 100000U);
  EXPECT_EQ(folder.entry_count(), 0U);
  reserve.hold(10);
  EXPECT_EQ(reserve.held(), 100000U) << "never less";
  reserve.hold(200000);
  EXPECT_EQ(reserve.held(), 200000U);
  reserve.release();
  EXPECT_EQ(reserve.held(), 0U);
  reserve.hold(10);
  EXPECT_EQ(reserve.held(), 10U);
}

TEST(SpaceReserve, NamesTheFolderWithoutSpace) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { SpaceReserve(folder / "none").hold(1); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cannot keep 1 bytes free in "),
                                                      HasSubstr("none: No such file or directory"))));
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit limited = old;
  limited.rlim_cur = 1000;
  const auto old_handler = signal(SIGXFSZ, SIG_IGN);
  SpaceReserve reserve(folder.path());
  reserve.hold(1000);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  EXPECT_THROW(reserve.hold(100000), std::runtime_error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  signal(SIGXFSZ, old_handler);
  EXPECT_EQ(reserve.held(), 1000U);
}

}  // namespace
}  // namespace ashlar::space_reserve_test
