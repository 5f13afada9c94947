#include "apps/view/headless_browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

namespace ashlar {
namespace {

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

std::string file_url(const std::filesystem::path& path) {
  std::string url = "file://";
  for (const char c : std::filesystem::absolute(path).string()) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("/-_.~", c) != nullptr;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

/// What a program is started with: its standard output and errors go to files.
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

/// Makes a program the leader of a process group of its own, so that what it starts can be ended with it.
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

/// @return the status of waitpid; empty if the limit passed, and then the program's whole group is ended.
std::optional<int> wait_for(pid_t child, std::chrono::duration<double> limit) {
  constexpr std::chrono::milliseconds pause(10);
  const auto start = std::chrono::steady_clock::now();
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
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

/// @return as wait_for.
std::optional<int> run_program(const std::vector<std::string>& command, const Redirections& redirections,
                               std::chrono::duration<double> limit) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const OwnGroup group;
  const int error = ::posix_spawn(&child, command.front().c_str(), redirections.get(), group.get(),
                                  arguments.data(), environ);
  if (error != 0) {
    throw std::runtime_error(fmt::format("cannot start {}: {}", command.front(), std::strerror(error)));
  }
  return wait_for(child, limit);
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), {}};
}

}  // namespace

std::optional<std::filesystem::path> find_browser() {
  if (const char* chosen = std::getenv("ASHLAR_BROWSER")) return chosen;
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (auto found = find_program(name)) return found;
  }
  return std::nullopt;
}

std::string loaded_page(const std::filesystem::path& browser, const std::filesystem::path& folder,
                        const std::filesystem::path& page, const std::string& fragment,
                        std::chrono::duration<double> limit) {
  std::vector<std::string> command = {browser.string(),
                                      "--headless",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      "--disable-dev-shm-usage",
                                      "--no-first-run",
                                      "--disable-background-networking",
                                      "--user-data-dir=" + (folder / "profile").string(),
                                      "--dump-dom"};
  // Chromium refuses to build its sandbox as root; the page is this program's own.
  if (::geteuid() == 0) command.emplace_back("--no-sandbox");
  command.push_back(file_url(page) + "#" + fragment);
  const std::filesystem::path errors = folder / "errors";
  const std::optional<int> status = run_program(command, {folder / "page", errors}, limit);
  if (!status) {
    throw std::runtime_error(
        fmt::format("{} did not finish within {} s and was ended", browser.string(), limit.count()));
  }
  if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0) {
    constexpr std::size_t shown = 1000;
    const std::string text = read_file(errors);
    throw std::runtime_error(fmt::format("{} failed: {}", browser.string(),
                                         text.substr(text.size() - std::min(text.size(), shown))));
  }
  return read_file(folder / "page");
}

std::optional<std::string> left_text(const std::string& page, std::string_view id) {
  const std::string start = fmt::format("<pre id=\"{}\">", id);
  const std::size_t found = page.find(start);
  if (found == std::string::npos) return std::nullopt;
  const std::size_t begin = found + start.size();
  return page.substr(begin, page.find("</pre>", begin) - begin);
}

}  // namespace ashlar
