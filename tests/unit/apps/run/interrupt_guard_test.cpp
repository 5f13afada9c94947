#include "apps/run/interrupt_guard.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <thread>

namespace ashlar {
namespace {

void ignore(int) {}

TEST(InterruptGuard, EachSignalToStopIsARequest) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1}) {
    const InterruptGuard guard;
    EXPECT_FALSE(InterruptGuard::interrupted());
    ::raise(signal);
    EXPECT_TRUE(InterruptGuard::interrupted()) << signal;
  }
}

// Runs in two threads: the one that began first ends first.
TEST(InterruptGuard, TheLastOfSeveralPutsBackWhatWasThere) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto old = std::signal(signal, ignore);
    std::optional<InterruptGuard> first, second;
    first.emplace();
    std::thread([&] { second.emplace(); }).join();
    first.reset();
    EXPECT_FALSE(InterruptGuard::interrupted());
    ::raise(signal);
    EXPECT_TRUE(InterruptGuard::interrupted()) << "one guard is left: " << signal;
    std::thread([&] { second.reset(); }).join();
    EXPECT_EQ(std::signal(signal, old), ignore) << "as it was";
  }
}

TEST(InterruptGuard, AStartTakesBackNoRequest) {
  const InterruptGuard first;
  ::raise(SIGTERM);
  const InterruptGuard second;
  EXPECT_TRUE(InterruptGuard::interrupted());
}

TEST(InterruptGuard, AClosedTerminalStaysIgnoredUnderNohup) {
  const auto old = std::signal(SIGHUP, SIG_IGN);
  {
    const InterruptGuard guard;
    ::raise(SIGHUP);
    EXPECT_FALSE(InterruptGuard::interrupted());
  }
  EXPECT_EQ(std::signal(SIGHUP, old), SIG_IGN) << "as it was";
}

// The system sends it each second from the limit on; the default action of a second one would end the process.
TEST(InterruptGuard, ALimitOfProcessorTimeThatIsToldAgainDoesNotEndTheProgram) {
  const InterruptGuard guard;
  ::raise(SIGXCPU);
  ::raise(SIGXCPU);
  EXPECT_TRUE(InterruptGuard::interrupted());
}

TEST(InterruptGuard, SignalsThatTheProcessHandlesStayWithIt) {
  static volatile std::sig_atomic_t heard = 0;
  const auto old = std::signal(SIGUSR1, [](int) { heard = 1; });
  {
    const InterruptGuard guard;
    ::raise(SIGUSR1);
    EXPECT_FALSE(InterruptGuard::interrupted());
  }
  EXPECT_EQ(heard, 1);
  (void)std::signal(SIGUSR1, old);
}

TEST(InterruptGuard, LogsThatNobodyReadsDoNotEndTheProgram) {
  const auto old = std::signal(SIGPIPE, SIG_DFL);
  {
    const InterruptGuard guard;
    ::raise(SIGPIPE);
    ::raise(SIGXFSZ);
    EXPECT_FALSE(InterruptGuard::interrupted());
  }
  EXPECT_EQ(std::signal(SIGPIPE, old), SIG_DFL);
}

}  // namespace
}  // namespace ashlar
