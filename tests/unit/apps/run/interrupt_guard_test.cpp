#include "apps/run/interrupt_guard.hpp"

#include <gtest/gtest.h>

namespace ashlar {
namespace {

TEST(InterruptGuard, EachSignalToStopIsARequest) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1}) {
    const InterruptGuard guard;
    EXPECT_FALSE(InterruptGuard::interrupted());
    ::raise(signal);
    EXPECT_TRUE(InterruptGuard::interrupted()) << signal;
  }
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
