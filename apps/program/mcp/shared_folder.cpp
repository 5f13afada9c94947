#include "apps/program/mcp/shared_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "apps/results/folder/folder_claim.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

constexpr std::size_t longest_path = 1000;  // bytes, below the limit of every file system in use

/// For messages: control characters are replaced, and only the beginning of a long text is shown.
std::string shown_path(std::string text) {
  constexpr std::size_t most = 200;
  if (text.size() > most) text = text.substr(0, most) + "...";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; }, '?');
  return text;
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char letter) { return letter < ' ' || letter == 127; });
}

}  // namespace

SharedFolder::SharedFolder(const std::filesystem::path& folder) : root_(std::filesystem::canonical(folder)) {}

std::filesystem::path SharedFolder::inside(const std::string& said) const {
  const auto refuse = [&](const char* why, const char* instead) {
    throw ToolRefusal(fmt::format("path ({}) {}; {}", shown_path(said), why, instead));
  };
  constexpr auto relative = "give one relative to the server's folder, such as wall.toml";
  if (said.empty()) refuse("is empty", relative);
  if (said.size() > longest_path) refuse("is longer than 1000 bytes", "give a shorter one");
  if (has_control_character(said)) refuse("has control characters", "give a path of letters");
  const std::filesystem::path path(said);
  if (path.is_absolute()) refuse("is absolute", relative);
  for (const std::filesystem::path& part : path) {
    const std::string name = part.string();
    if (name == "..") refuse("leads out of the server's folder (..)", relative);
    if (name.starts_with('-')) refuse("has a name that begins with -", "give another name");
    if (name.size() > 1 && name.starts_with('.'))
      refuse("names a hidden file", "give a name without a dot at its start");
  }
  const std::filesystem::path normal = path.lexically_normal();
  // A link to nothing is followed once somebody makes its target.
  std::filesystem::path place = root_;
  std::error_code ignored;
  for (const std::filesystem::path& part : normal) {
    place /= part;
    if (std::filesystem::is_symlink(place, ignored) && !std::filesystem::exists(place, ignored))
      refuse("is a link to nothing, or below one", "give a file or folder that exists, or a new name");
  }
  if (!is_below(root_ / normal, root_))
    refuse("leads out of the server's folder through a link", "give a file or folder that lies in it");
  return normal;
}

std::filesystem::path SharedFolder::file(const std::string& said) const {
  std::filesystem::path path = inside(said);
  std::error_code ignored;
  if (!std::filesystem::exists(root_ / path, ignored))
    throw ToolRefusal(
        fmt::format("there is no file {}; list_files shows those that exist", shown_path(said)));
  if (!std::filesystem::is_regular_file(root_ / path, ignored))
    throw ToolRefusal(fmt::format("{} is no plain file; list_files shows those that are", shown_path(said)));
  return path;
}

std::filesystem::path SharedFolder::results(const std::string& said) const {
  std::filesystem::path path = inside(said);
  if (!holds_results(root_ / path))
    throw ToolRefusal(
        fmt::format("{} holds no results of a run; run_start makes a result folder", shown_path(said)));
  return path;
}

std::filesystem::path SharedFolder::new_file(const std::string& said, bool replace) const {
  std::filesystem::path path = inside(said);
  std::error_code ignored;
  for (std::filesystem::path folder = path.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (std::filesystem::exists(root_ / folder / ".ashlar", ignored))
      throw ToolRefusal(fmt::format(
          "{} is in a result folder, whose files belong to its run; give another folder", shown_path(said)));
  const auto kind = std::filesystem::symlink_status(root_ / path, ignored).type();
  if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::regular)
    throw ToolRefusal(fmt::format("{} is a folder or a link; give another name", shown_path(said)));
  if (kind == std::filesystem::file_type::regular && !replace)
    throw ToolRefusal(fmt::format("{} exists; give another name, or replace: true", shown_path(said)));
  std::filesystem::create_directories((root_ / path).parent_path());
  return path;
}

}  // namespace ashlar
