#include "apps/run/interrupt_guard.hpp"

#include <gtest/gtest.h>

namespace ashlar {
namespace {

TEST(InterruptGuard, EachSignalToStopIsARequest) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
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
