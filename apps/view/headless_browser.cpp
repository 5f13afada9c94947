#include "apps/view/headless_browser.hpp"

#include <fmt/format.h>
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

#include "apps/view/child_program.hpp"

namespace ashlar {
namespace {

std::string file_url(const std::filesystem::path& path) {
  std::string url = "file://";
  for (const char c : std::filesystem::absolute(path).string()) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("/-_.~", c) != nullptr;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
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
  const std::optional<int> status = run_program(command, folder / "page", errors, limit);
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
