#include "apps/results/system/child_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace ashlar {
namespace {

/// All that the copies of this process need between fork and exec, where nothing may be allocated.
class Launch {
 public:
  Launch(const std::vector<std::string>& command, const std::filesystem::path& out,
         const std::filesystem::path& err)
      : texts_(command),
        out_(std::filesystem::absolute(out)),
        err_(std::filesystem::absolute(err)),
        folder_(out_.parent_path()),
        arguments_(command.size()) {
    texts_.front() = std::filesystem::absolute(command.front());
    // A thread of OpenBLAS takes 128 MiB of address space, and it waits without end for what a limit does not allow.
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"})
      texts_.push_back(std::string(name) + "=1");
    for (char** variable = environ; *variable != nullptr; ++variable)
      if (!sets_threads(*variable)) variables_.push_back(*variable);
    for (std::size_t k = 0; k < texts_.size(); ++k) {
      if (k < command.size())
        arguments_[k] = texts_[k].data();
      else
        variables_.push_back(texts_[k].data());
    }
    arguments_.push_back(nullptr);
    variables_.push_back(nullptr);
  }

  /// Turns the present process into the program. @return only if that fails: the reason
  [[nodiscard]] int become_program() noexcept {
    constexpr int mode = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW;
    const std::array streams = {::open("/dev/null", O_RDONLY), ::open(out_.c_str(), mode, 0600),
                                ::open(err_.c_str(), mode, 0600)};
    for (std::size_t k = 0; k < streams.size(); ++k)
      if (streams[k] < 0 || ::dup2(streams[k], static_cast<int>(k)) < 0) return errno;
    if (::chdir(folder_.c_str()) != 0) return errno;
    ::execve(arguments_.front(), arguments_.data(), variables_.data());
    return errno;
  }

 private:
  static bool sets_threads(std::string_view variable) {
    const std::string_view name = variable.substr(0, variable.find('='));
    return name == "OPENBLAS_NUM_THREADS" || name == "OMP_NUM_THREADS" || name == "MKL_NUM_THREADS";
  }

  std::vector<std::string> texts_;  ///< arguments, then variables that are set
  std::filesystem::path out_, err_, folder_;
  std::vector<char*> arguments_, variables_;
};

extern "C" void end_own_group(int) {
  (void)::kill(0, SIGKILL);
}

void set_default_signals() noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGXFSZ, SIGUSR1})
    (void)::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  (void)::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// A process between this one and the program: the leader of its group, which ends all of the group when this process
/// has ended, however. It ends as the program does, and is a copy of a process with threads: it allocates nothing.
/// @param parent this process. @param fault where it writes the reason if the program cannot be started
[[noreturn]] void supervise(Launch& launch, pid_t parent, int fault) noexcept {
  (void)::setpgid(0, 0);
  set_default_signals();
  (void)::signal(SIGTERM, end_own_group);
  (void)::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  // Locks and pipes of this process are not kept by another one.
  if (fault > 0) (void)::close_range(0, static_cast<unsigned>(fault) - 1, 0);
  (void)::close_range(static_cast<unsigned>(fault) + 1, ~0U, 0);
  const pid_t leader = ::getpid();
  const pid_t program = ::_Fork();
  if (program <= 0) {
    (void)::signal(SIGTERM, SIG_DFL);
    int reason = program < 0 ? errno : 0;
    if (program == 0) {
      (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() == leader) reason = launch.become_program();
    }
    (void)!::write(fault, &reason, sizeof reason);
    ::_exit(1);
  }
  (void)::close(fault);
  int how = 0;
  while (::waitpid(program, &how, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(how)) ::_exit(WEXITSTATUS(how));
  (void)::kill(leader, SIGKILL);
  ::_exit(1);
}

/// @return the supervisor's process. @throws std::runtime_error if the program cannot be started
pid_t start(Launch& launch, const std::string& name) {
  // Above the standard streams, which the program gets new.
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("cannot start {}: {}", name, std::strerror(errno)));
  const int fault = ::fcntl(ends[1], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  (void)::close(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = fault < 0 ? -1 : ::_Fork();
  if (child == 0) supervise(launch, parent, fault);
  int reason = child < 0 ? errno : 0;
  (void)::close(fault);
  while (child > 0 && ::read(ends[0], &reason, sizeof reason) < 0 && errno == EINTR) {
  }
  (void)::close(ends[0]);
  if (reason == 0) return child;
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  throw std::runtime_error(fmt::format("cannot start {}: {}", name, std::strerror(reason)));
}

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
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!std::filesystem::path(folder).is_absolute()) continue;
    std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (is_executable(candidate)) return candidate;
  }
  return std::nullopt;
}

std::optional<int> run_program(const std::vector<std::string>& command, const std::filesystem::path& out,
                               const std::filesystem::path& err, std::chrono::duration<double> limit) {
  Launch launch(command, out, err);
  EndsTogether ends_together;
  const pid_t child = start(launch, command.front());
  ends_together.set_group(child);
  return wait_for(child, limit);
}

}  // namespace ashlar
