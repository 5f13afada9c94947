#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <system_error>
#include <utility>

#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/book.hpp"
#include "apps/program/mcp/command_call.hpp"
#include "apps/program/mcp/tools/tools.hpp"
#include "apps/program/new/new_command.hpp"
#include "apps/program/new/starting_scenes.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_schema.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_file_bytes = 4'000'000;  // that a client writes or reads
constexpr std::size_t most_listed = 500;

/// Endings of files that scenes consist of.
constexpr std::array file_endings = {".toml", ".csv", ".txt", ".json", ".dat", ".off",
                                     ".obj",  ".stl", ".ply", ".msh",  ".dxf", ".at2"};

ToolStart list_the_files(Workspace& workspace, const Json& arguments) {
  const std::string said = arguments.value("folder", std::string("."));
  const std::filesystem::path folder = workspace.folder().root() / workspace.folder().inside(said);
  std::error_code fault;
  Json entries = Json::array();
  std::size_t left_out = 0;
  std::vector<std::filesystem::directory_entry> found;
  for (auto at = std::filesystem::directory_iterator(folder, fault);
       !fault && at != std::filesystem::directory_iterator(); at.increment(fault))
    if (!at->path().filename().string().starts_with('.')) found.push_back(*at);
  if (fault) throw ToolRefusal(fmt::format("{} cannot be listed ({}); give a folder", said, fault.message()));
  std::sort(found.begin(), found.end());
  for (const std::filesystem::directory_entry& entry : found) {
    if (entries.size() == most_listed) {
      ++left_out;
      continue;
    }
    Json told = {{"name", entry.path().filename().string()}};
    if (entry.is_symlink(fault))
      told["kind"] = "link";
    else if (entry.is_directory(fault))
      told["kind"] = holds_results(entry.path()) ? "result folder" : "folder";
    else
      told["kind"] = "file";
    if (told["kind"] == "file") told["bytes"] = entry.file_size(fault);
    entries.push_back(std::move(told));
  }
  Json data = {{"folder", said}, {"entries", std::move(entries)}};
  if (left_out > 0) data["left_out"] = left_out;
  return data_answer(std::move(data));
}

ToolStart read_a_file(Workspace& workspace, const Json& arguments) {
  constexpr std::size_t usual_lines = 400;
  constexpr std::size_t most_text = 200'000;
  const std::filesystem::path path = workspace.folder().file(arguments["file"].get<std::string>());
  std::istringstream text(
      naming_the_file(path, [&] { return whole_file(workspace.folder().root() / path, most_input_bytes); }));
  if (text.str().find('\0') != std::string::npos)
    throw ToolRefusal(fmt::format("{} is no text; summary, history and picture read results", path.string()));
  const std::size_t first = arguments.value("first_line", std::size_t{1});
  const std::size_t count = arguments.value("lines", usual_lines);
  std::string shown;
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);)
    if (++number >= first && number < first + count && shown.size() < most_text) shown += line + '\n';
  if (shown.size() > most_text) shown = shown.substr(0, most_text) + "...\n";
  if (number >= first + count || first > 1) shown += fmt::format("({} lines in all)\n", number);
  return ToolAnswer{std::move(shown), nullptr, "", false};
}

ToolStart write_a_file(Workspace& workspace, const Json& arguments) {
  const auto said = arguments["file"].get<std::string>();
  std::string ending = std::filesystem::path(said).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (std::find(file_endings.begin(), file_endings.end(), ending) == file_endings.end())
    throw ToolRefusal(fmt::format("files of scenes are written, not {}; give a name that ends with one of {}",
                                  ending.empty() ? "those without an ending" : ending,
                                  fmt::join(file_endings, " ")));
  const std::filesystem::path path = workspace.folder().new_file(said, arguments.value("replace", false));
  write_file_atomically(workspace.folder().root() / path, arguments["text"].get_ref<const std::string&>(),
                        Durability::process);
  return ToolAnswer{fmt::format("written: {}; check reads a scene and lists its faults", path.string()),
                    nullptr, "", false};
}

/// Copies an example of the book with the tables that it names.
void write_example(Workspace& workspace, const std::string& name, const std::filesystem::path& path) {
  constexpr std::string_view own_schema = "#:schema ../scene.schema.json",
                             schema = "#:schema scene.schema.json";
  std::string text(book_page("scenes/" + name + ".toml")->text);
  if (text.starts_with(own_schema)) text.replace(0, own_schema.size(), schema);
  const std::filesystem::path file = workspace.folder().root() / path;
  for (const BookPage& page : book_pages()) {
    if (!page.name.ends_with(".csv")) continue;
    const std::filesystem::path table = std::filesystem::path(page.name).filename();
    if (text.find(table.string()) == std::string::npos) continue;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file.parent_path() / table)))
      write_file_atomically(file.parent_path() / table, page.text, Durability::process);
  }
  write_file_of_kind(file.parent_path() / "scene.schema.json", json_text(scene_schema(), 2) + '\n',
                     {"schema of scenes", {R"("title": "Ashlar scene")"}});
  write_file_atomically(file, text, Durability::process);
}

std::vector<std::string> kinds_of_scenes() {
  std::vector<std::string> kinds;
  for (const StartingScene& scene : starting_scenes()) kinds.emplace_back(scene.kind);
  for (const std::string& name : example_names()) kinds.push_back("example:" + name);
  return kinds;
}

ToolStart make_a_scene(Workspace& workspace, const Json& arguments) {
  constexpr std::string_view example = "example:";
  const auto kind = arguments["kind"].get<std::string>();
  const std::string name = kind.starts_with(example) ? kind.substr(example.size()) : kind;
  const bool replace = arguments.value("replace", false);
  const std::filesystem::path path =
      workspace.folder().new_file(arguments.value("file", name + ".toml"), replace);
  if (path.extension() != ".toml")
    throw ToolRefusal(
        fmt::format("a scene is a TOML file, not {}; give a name that ends with .toml", path.string()));
  if (kind.starts_with(example)) {
    write_example(workspace, name, path);
  } else {
    std::ostringstream out, err;
    const int status = new_command({kind, workspace.folder().root() / path, replace}, out, err);
    if (status != exit_status::done) return command_error({status, out.str(), err.str()});
  }
  return ToolAnswer{
      fmt::format("scene: {}; read_file shows it, check lists its faults, run_start computes it",
                  path.string()),
      nullptr, "", false};
}

}  // namespace

std::vector<Tool> file_tools(Workspace& workspace) {
  const auto with = [&workspace](ToolStart (*call)(Workspace&, const Json&)) {
    return [&workspace, call](const Json& arguments) { return call(workspace, arguments); };
  };
  const Json file = text_argument("Path below the server's folder, such as models/wall.toml");
  const Json replace = flag_argument("Replace an existing file; false by default");
  std::vector<Tool> tools;
  tools.push_back({"list_files", "List files", "Files, folders and result folders of one folder.",
                   arguments_schema({{"folder", text_argument("Path; the server's folder by default")}}),
                   true, with(list_the_files)});
  tools.push_back(
      {"read_file", "Read a file", "Lines of a text file: a scene, a table, a log.",
       arguments_schema(
           {{"file", file},
            {"first_line", whole_number_argument("Number of the first line; 1 by default", 1, 100'000'000)},
            {"lines", whole_number_argument("At most so many; 400 by default", 1, 5000)}},
           {"file"}),
       true, with(read_a_file)});
  tools.push_back(
      {"new_scene", "Write a scene to begin with",
       "Write a commented scene that runs as it is: slope, wall, arch or tunnel to build on, or an example "
       "of "
       "the gallery. A starting point for a scene of your own: read it, then write_file the changed text.",
       arguments_schema({{"kind", word_argument("Which one", kinds_of_scenes())},
                         {"file", text_argument("Path to write; the kind's name and .toml by default")},
                         {"replace", replace}},
                        {"kind"}),
       false, with(make_a_scene)});
  tools.push_back({"write_file", "Write a file of a scene",
                   fmt::format("Write a scene (TOML), or a table, mesh or record that it reads. Endings: {}.",
                               fmt::join(file_endings, " ")),
                   arguments_schema({{"file", file},
                                     {"text", text_argument("The whole content", most_file_bytes)},
                                     {"replace", replace}},
                                    {"file", "text"}),
                   false, with(write_a_file)});
  return tools;
}

}  // namespace ashlar
