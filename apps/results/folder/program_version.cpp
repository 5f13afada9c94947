#include "apps/results/folder/program_version.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <zlib.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/scene/meshes/xml_reader.hpp"
#include "geometry/library_versions.hpp"
#include "solver/library_versions.hpp"

namespace ashlar {

std::string program_version() {
  return ASHLAR_VERSION;
}

std::vector<std::pair<std::string, std::string>> tool_versions() {
#ifdef __clang__
  std::vector<std::pair<std::string, std::string>> versions = {{"Clang", __clang_version__}};
#else
  std::vector<std::pair<std::string, std::string>> versions = {{"GCC", __VERSION__}};
#endif
  for (auto& version : geometry_library_versions()) versions.push_back(std::move(version));
  for (auto& version : solver_library_versions()) versions.push_back(std::move(version));
  versions.emplace_back("toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
  versions.emplace_back("CLI11", CLI11_VERSION);
  versions.emplace_back("nlohmann-json",
                        fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                    NLOHMANN_JSON_VERSION_PATCH));
  versions.emplace_back(
      "fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  versions.emplace_back("zlib", zlibVersion());
  versions.emplace_back("expat", xml_library_version());
  return versions;
}

std::string version_text() {
  std::string text = "ashlar " + program_version();
  for (const auto& [name, version] : tool_versions()) text += fmt::format("\n  {} {}", name, version);
  return text;
}

}  // namespace ashlar
