#include "apps/results/system/process_copy.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>
#include <string_view>
#include <system_error>

namespace ashlar {
namespace {

bool write_all(int stream, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(stream, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_all(int stream) {
  std::string all;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t size = ::read(stream, part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return all;
    all.append(part.data(), static_cast<std::size_t>(size));
  }
}

/// For a copy: the signal when this process has ended. @param parent this process
void end_with(pid_t parent, int signal) {
  (void)::prctl(PR_SET_PDEATHSIG, signal);
  if (::getppid() != parent) ::_exit(1);  // it had already
}

}  // namespace

ProcessCopy::ProcessCopy(const std::function<int()>& run) {
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0)
    throw std::system_error(errno, std::generic_category(), "a process for a run cannot be made");
  if (process_ > 0) return;
  (void)::setpgid(0, 0);
  end_with(parent, SIGTERM);
  ::_exit([&]() noexcept { return run(); }());
}

std::optional<int> ProcessCopy::ended() const {
  int how = 0;
  const pid_t ended = ::waitpid(static_cast<pid_t>(process_), &how, WNOHANG);
  if (ended == 0) return std::nullopt;
  return ended > 0 && WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

void ProcessCopy::ask_to_end() const {
  (void)::kill(static_cast<pid_t>(process_), SIGTERM);
}

std::optional<std::string> told_by_copy(const std::function<std::optional<std::string>()>& tell) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return std::nullopt;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    end_with(parent, SIGKILL);
    ::close(ends[0]);
    bool told = false;
    try {
      if (const std::optional<std::string> text = tell()) told = write_all(ends[1], *text);
    } catch (const std::exception&) {
      told = false;
    }
    ::_exit(told ? 0 : 1);
  }
  ::close(ends[1]);
  std::string text;
  int how = 0;
  if (child > 0) {
    text = read_all(ends[0]);
    while (::waitpid(child, &how, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(ends[0]);
  const bool well = child > 0 && WIFEXITED(how) && WEXITSTATUS(how) == 0;
  return well ? std::optional(text) : std::nullopt;
}

}  // namespace ashlar
