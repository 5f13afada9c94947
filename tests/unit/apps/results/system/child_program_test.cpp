#include "apps/results/system/child_program.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "support/temporary_folder.hpp"

namespace ashlar::child_program_test {
namespace {

/// True if a process is there and no zombie.
bool runs(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("State:")) return line.find('Z') == std::string::npos;
  return false;
}

template <class Condition>
bool comes_true(Condition condition) {
  for (int k = 0; k < 2000 && !condition(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

TEST(ChildProgram, EndsWithTheProgramThatStartedIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const std::string noted = (folder / "pid").string();
    const pid_t starter = ::fork();
    ASSERT_GE(starter, 0);
    if (starter == 0) {
      std::signal(signal, SIG_DFL);
      (void)run_program({"/bin/sh", "-c", "echo $$ > " + noted + "; sleep 600"}, folder / "out",
                        folder / "err", std::chrono::seconds(600));
      ::_exit(0);
    }
    ASSERT_TRUE(comes_true([&] { return read_text(noted).ends_with('\n'); }));
    const pid_t child = std::stoi(read_text(noted));
    ASSERT_TRUE(runs(child));
    ::kill(starter, signal);
    int status = 0;
    ASSERT_EQ(::waitpid(starter, &status, 0), starter);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_TRUE(comes_true([&] { return !runs(child); })) << signal;
  }
}

TEST(ChildProgram, LeavesHandlersAsTheyWere) {
  const TemporaryFolder folder;
  const auto old = std::signal(SIGTERM, SIG_DFL);
  const std::optional<int> status =
      run_program({"/bin/true"}, folder / "out", folder / "err", std::chrono::seconds(60));
  EXPECT_EQ(status, 0);
  EXPECT_EQ(std::signal(SIGTERM, old), SIG_DFL);
}

}  // namespace
}  // namespace ashlar::child_program_test
