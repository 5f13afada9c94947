#include "apps/results/system/interrupt_guard.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <thread>

namespace ashlar::interrupt_guard_test {
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

/// Exit status of a process after two signals, or 128 + the signal if it continues. @param pause between, microseconds
int end_of_process(int signal, useconds_t pause) {
  const pid_t process = ::fork();
  if (process == 0) {
    (void)std::signal(signal, SIG_DFL);
    const InterruptGuard guard;
    ::raise(signal);
    ::usleep(pause);
    ::raise(signal);
    ::_exit(InterruptGuard::interrupted() ? 128 + signal : 1);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(process, &status, 0), process);
  return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

// `timeout` signals its child and then its whole group.
TEST(InterruptGuard, WhatIsSentTwiceAtOnceIsOneRequest) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(end_of_process(signal, 0), 128 + signal);
    EXPECT_EQ(end_of_process(signal, 400'000), signal) << "a second one ends the program";
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
}  // namespace ashlar::interrupt_guard_test
