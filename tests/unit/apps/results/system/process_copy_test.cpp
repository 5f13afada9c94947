#include "apps/results/system/process_copy.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "support/temporary_folder.hpp"

namespace ashlar::process_copy_test {
namespace {

/// Its exit status when it has ended.
int status_of(const ProcessCopy& copy) {
  for (;;) {
    if (const std::optional<int> status = copy.ended()) return *status;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(ProcessCopy, EndsWithTheResultOfTheFunction) {
  int known = 3;
  const ProcessCopy copy([&] { return known += 4; });
  EXPECT_EQ(status_of(copy), 7);
  EXPECT_EQ(known, 3) << "another process's";
}

TEST(ProcessCopy, EndsWhenAsked) {
  const ProcessCopy copy([] {
    std::signal(SIGTERM, SIG_DFL);
    std::this_thread::sleep_for(std::chrono::hours(1));
    return 0;
  });
  EXPECT_EQ(copy.ended(), std::nullopt);
  copy.ask_to_end();
  EXPECT_EQ(status_of(copy), -1);
}

TEST(ProcessCopy, PrintsToItsFilesAndHasNoInput) {
  const TemporaryFolder folder;
  const ProcessCopy copy(
      [] {
        std::cout << "results" << std::flush;
        std::cerr << "faults";
        return std::cin.get() == std::istream::traits_type::eof() ? 5 : 6;
      },
      CopyStreams{folder / "out", folder / "err"});
  EXPECT_EQ(status_of(copy), 5);
  EXPECT_EQ(read_text(folder / "out"), "results");
  EXPECT_EQ(read_text(folder / "err"), "faults");
  const ProcessCopy without([] { return 0; }, CopyStreams{folder / "none" / "out", folder / "err"});
  EXPECT_EQ(status_of(without), 1);
}

TEST(ProcessCopy, IsEndedAtOnce) {
  const ProcessCopy copy([] {
    std::signal(SIGTERM, SIG_IGN);
    std::this_thread::sleep_for(std::chrono::hours(1));
    return 0;
  });
  copy.ask_to_end();
  copy.end_at_once();
  EXPECT_EQ(status_of(copy), -1);
}

TEST(ToldByCopy, IsWhatTheFunctionReturns) {
  // More than a pipe holds.
  const std::string text(1000000, 'a');
  EXPECT_EQ(told_by_copy([&]() -> std::optional<std::string> { return text + '\0' + 'b'; }),
            text + '\0' + 'b');
  EXPECT_EQ(told_by_copy([]() -> std::optional<std::string> { return std::nullopt; }), std::nullopt);
  EXPECT_EQ(told_by_copy([]() -> std::optional<std::string> { throw std::runtime_error("fault"); }),
            std::nullopt);
  EXPECT_EQ(told_by_copy([]() -> std::optional<std::string> {
              std::raise(SIGKILL);
              return "text";
            }),
            std::nullopt);
}

}  // namespace
}  // namespace ashlar::process_copy_test
