#include "apps/program/view/headless_browser.hpp"

#include <fmt/format.h>

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

#include "apps/results/system/child_program.hpp"
#include "apps/results/system/this_process.hpp"

namespace ashlar {
namespace {

std::string file_url(const std::filesystem::path& path) {
  const std::filesystem::path file = std::filesystem::absolute(path);
  // Windows: a drive follows a third slash, and a server's name the first two.
  const std::string root = file.root_name().string();
  std::string url = root.empty() ? "file://" : root.ends_with(':') ? "file:///" : "file:";
  for (const char c : file.generic_string()) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("/-_.~:", c) != nullptr;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), {}};
}

/// Status of a browser at its end, and its standard error.
struct BrowserRun {
  int status = 0;  ///< of run_program
  std::string errors;
  [[nodiscard]] bool good() const { return status == 0; }
};

/// @throws std::runtime_error if it does not finish within the limit
BrowserRun run_browser(std::vector<std::string> command, bool sandbox, const std::string& address,
                       const std::filesystem::path& folder, std::chrono::duration<double> limit) {
  if (!sandbox) command.emplace_back("--no-sandbox");
  command.push_back(address);
  const std::filesystem::path errors = folder / "errors";
  const std::optional<int> status = run_program(command, folder / "page", errors, limit);
  if (!status)
    throw std::runtime_error(
        fmt::format("{} did not finish within {} s and was ended", command.front(), limit.count()));
  return {*status, read_file(errors)};
}

/// Chromium's message if neither user namespaces nor its setuid helper are available.
constexpr std::string_view no_sandbox_there = "No usable sandbox";

}  // namespace

std::optional<std::filesystem::path> find_browser() {
  if (const char* chosen = std::getenv("ASHLAR_BROWSER")) return chosen;
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "chrome", "msedge"}) {
    if (auto found = find_program(name)) return found;
  }
  return std::nullopt;
}

std::string loaded_page(const std::filesystem::path& browser, const std::filesystem::path& folder,
                        const std::filesystem::path& page, const std::string& fragment,
                        std::chrono::duration<double> limit) {
  const std::vector<std::string> command = {browser.string(),
                                            "--headless",
                                            "--use-angle=swiftshader",
                                            "--enable-unsafe-swiftshader",
                                            "--disable-dev-shm-usage",
                                            "--no-first-run",
                                            "--disable-background-networking",
                                            "--user-data-dir=" + (folder / "profile").string(),
                                            "--dump-dom"};
  const std::string address = file_url(page) + "#" + fragment;
  // The page is made by this program, but its data may be untrusted: the sandbox is used if available. Chromium has
  // none for root.
  const bool sandbox = !has_all_rights();
  BrowserRun run = run_browser(command, sandbox, address, folder, limit);
  if (sandbox && !run.good() && run.errors.find(no_sandbox_there) != std::string::npos)
    run = run_browser(command, false, address, folder, limit);
  if (!run.good()) {
    constexpr std::size_t shown = 1000;
    throw std::runtime_error(
        fmt::format("{} failed: {}", browser.string(),
                    run.errors.substr(run.errors.size() - std::min(run.errors.size(), shown))));
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
