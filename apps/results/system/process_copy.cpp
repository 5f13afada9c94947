#include "apps/results/system/process_copy.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
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

/// For a copy. @return false if one cannot be opened
bool replace_streams(const CopyStreams& streams) {
  constexpr int mode = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW;
  const std::array opened = {::open("/dev/null", O_RDONLY), ::open(streams.out.c_str(), mode, 0600),
                             ::open(streams.err.c_str(), mode, 0600)};
  for (std::size_t k = 0; k < opened.size(); ++k)
    if (opened[k] < 0 || ::dup2(opened[k], static_cast<int>(k)) < 0) return false;
  return true;
}

}  // namespace

bool copies_have_streams() {
  return true;
}

ProcessCopy::ProcessCopy(const std::function<int()>& run, const std::optional<CopyStreams>& streams,
                         CopyEnd end) {
  if (streams) (void)std::fflush(nullptr);  // or the copy would write it once more
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0)
    throw std::system_error(errno, std::generic_category(), "a process for a run cannot be made");
  if (process_ > 0) return;
  (void)::setpgid(0, 0);
  end_with(parent, end == CopyEnd::asked ? SIGTERM : SIGKILL);
  if (streams && !replace_streams(*streams)) ::_exit(1);
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

void ProcessCopy::end_at_once() const {
  (void)::kill(static_cast<pid_t>(process_), SIGKILL);
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
