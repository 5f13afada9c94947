#include "apps/results/system/child_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace ashlar {
namespace {

/// Standard output and errors of a program, redirected to files.
class Redirections {
 public:
  Redirections(const std::filesystem::path& out, const std::filesystem::path& err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    constexpr int mode = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, out.c_str(), mode, 0600);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, err.c_str(), mode, 0600);
  }
  ~Redirections() { posix_spawn_file_actions_destroy(&actions_); }
  Redirections(const Redirections&) = delete;
  Redirections& operator=(const Redirections&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Makes a program the leader of a process group, so that its child processes can be ended with it.
class OwnGroup {
 public:
  OwnGroup() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~OwnGroup() { posix_spawnattr_destroy(&attributes_); }
  OwnGroup(const OwnGroup&) = delete;
  OwnGroup& operator=(const OwnGroup&) = delete;

  [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};
std::atomic<pid_t> group_to_end = 0;
static_assert(std::atomic<pid_t>::is_always_lock_free);

extern "C" void end_with_child(int signal) {
  if (const pid_t group = group_to_end; group > 0) ::kill(-group, SIGKILL);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

/// While this exists, a signal that would end this program ends the child's group too, which the terminal's signals
/// do not reach. Signals handled otherwise are not changed.
class EndsTogether {
 public:
  EndsTogether() {
    for (std::size_t k = 0; k < ending_signals.size(); ++k) {
      sigaction(ending_signals[k], nullptr, &old_[k]);
      if (old_[k].sa_handler != SIG_DFL) continue;
      struct sigaction action {};
      action.sa_handler = end_with_child;
      sigaction(ending_signals[k], &action, nullptr);
    }
  }
  ~EndsTogether() {
    group_to_end = 0;
    for (std::size_t k = 0; k < ending_signals.size(); ++k) sigaction(ending_signals[k], &old_[k], nullptr);
  }
  EndsTogether(const EndsTogether&) = delete;
  EndsTogether& operator=(const EndsTogether&) = delete;

  void set_group(pid_t group) { group_to_end = group; }

 private:
  std::array<struct sigaction, ending_signals.size()> old_{};
};

/// @return as run_program; empty if the limit was reached, and then the program's whole group is ended.
std::optional<int> wait_for(pid_t child, std::chrono::duration<double> limit) {
  constexpr std::chrono::milliseconds pause(10);
  const auto start = std::chrono::steady_clock::now();
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (ended < 0 && errno != EINTR)
      throw std::runtime_error(fmt::format("cannot wait for a program: {}", std::strerror(errno)));
    if (std::chrono::steady_clock::now() - start > limit) break;
    std::this_thread::sleep_for(pause);
  }
  ::kill(-child, SIGKILL);
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return std::nullopt;
}

}  // namespace

bool is_executable(const std::filesystem::path& file) {
  return ::access(file.c_str(), X_OK) == 0;
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (is_executable(candidate)) return candidate;
  }
  return std::nullopt;
}

std::optional<int> run_program(const std::vector<std::string>& command, const std::filesystem::path& out,
                               const std::filesystem::path& err, std::chrono::duration<double> limit) {
  const Redirections redirections(out, err);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const OwnGroup group;
  EndsTogether ends_together;
  const int error = ::posix_spawn(&child, command.front().c_str(), redirections.get(), group.get(),
                                  arguments.data(), environ);
  if (error != 0) {
    throw std::runtime_error(fmt::format("cannot start {}: {}", command.front(), std::strerror(error)));
  }
  ends_together.set_group(child);
  return wait_for(child, limit);
}

}  // namespace ashlar
