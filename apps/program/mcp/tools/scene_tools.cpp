#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <system_error>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/command_call.hpp"
#include "apps/program/mcp/tools/tools.hpp"
#include "apps/program/run/run_command.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// JSON that a command has printed; null: it has not.
Json printed_json(const CommandOutcome& outcome) {
  if (outcome.out.empty()) return nullptr;
  try {
    return parse_json(outcome.out);
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

/// Reason not to run a scene that was checked.
Json limits_exceeded(const Json& report, const SceneLimits& limits) {
  Json exceeded = Json::array();
  if (!report.contains("estimate")) return exceeded;
  if (report["blocks"].get<std::uint64_t>() > limits.blocks)
    exceeded.push_back(fmt::format("this server runs at most {} blocks: make fewer", limits.blocks));
  if (report["estimate"]["memory_bytes"].get<double>() > limits.memory)
    exceeded.push_back(
        fmt::format("this server runs what needs at most {:.2g} GB: fewer blocks, lower orders or fewer "
                    "sub-faces need less",
                    limits.memory / 1e9));
  return exceeded;
}

ToolStart check_a_scene(Workspace& workspace, const Json& arguments) {
  std::vector<std::string> words = {
      "check", workspace.folder().file(arguments["scene"].get<std::string>()).string(), "--json"};
  add_overrides(words, arguments);
  return command_call(workspace,
                      {command_line_work(words), true, [&workspace](const CommandOutcome& outcome) {
                         Json report = printed_json(outcome);
                         if (!report.is_object()) return command_error(outcome);
                         Json exceeded = limits_exceeded(report, workspace.limits().scene);
                         if (!exceeded.empty()) report["limits_exceeded"] = std::move(exceeded);
                         return data_answer(std::move(report));
                       }});
}

/// The blocks that were asked for.
ToolAnswer chosen_blocks(Json report, const std::string& pattern, std::size_t first, std::size_t count) {
  Json chosen = Json::array();
  std::size_t matching = 0;
  for (Json& block : report["blocks"]) {
    if (!pattern_matches(pattern, block["name"].get<std::string>())) continue;
    if (matching++ >= first && chosen.size() < count) chosen.push_back(std::move(block));
  }
  report["matching"] = matching;
  report["first"] = first;
  report["blocks"] = std::move(chosen);
  return data_answer(std::move(report));
}

ToolStart list_blocks(Workspace& workspace, const Json& arguments) {
  constexpr std::size_t usual = 50;
  std::vector<std::string> words = {
      "blocks", workspace.folder().file(arguments["scene"].get<std::string>()).string(), "--json"};
  if (arguments.contains("removable"))
    words.push_back("--removable=" + arguments["removable"].get<std::string>());
  if (arguments.contains("stage")) words.push_back("--stage=" + arguments["stage"].get<std::string>());
  add_overrides(words, arguments);
  const auto answer = [pattern = arguments.value("names", std::string("*")),
                       first = arguments.value("first", std::size_t{0}),
                       count = arguments.value("count", usual)](const CommandOutcome& outcome) {
    Json report = printed_json(outcome);
    if (outcome.status != exit_status::done || !report.is_object()) return command_error(outcome);
    return chosen_blocks(std::move(report), pattern, first, count);
  };
  return command_call(workspace, {command_line_work(words), true, answer});
}

ToolStart report_contacts(Workspace& workspace, const Json& arguments) {
  std::vector<std::string> words = {
      "contacts", workspace.folder().file(arguments["a"].get<std::string>()).string(),
      workspace.folder().file(arguments["b"].get<std::string>()).string(), "--json"};
  for (const char* option : {"distance", "angle"})
    if (arguments.contains(option))
      words.push_back(fmt::format("--{}={}", option, json_text(arguments[option])));
  return command_call(workspace, {command_line_work(words), true, [](const CommandOutcome& outcome) {
                                    Json report = printed_json(outcome);
                                    const bool good =
                                        outcome.status == exit_status::done && report.is_object();
                                    return good ? data_answer(std::move(report)) : command_error(outcome);
                                  }});
}

/// A run whose results are removed with the call.
class ScratchRun {
 public:
  explicit ScratchRun(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~ScratchRun() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchRun(const ScratchRun&) = delete;
  ScratchRun& operator=(const ScratchRun&) = delete;

 private:
  std::filesystem::path folder_;
};

ToolStart explain_contacts(Workspace& workspace, const Json& arguments) {
  RunOptions options;
  options.scene = workspace.folder().file(arguments["scene"].get<std::string>());
  options.out = workspace.scratch_name();
  options.overrides = overrides_of(arguments);
  options.quiet = true;
  options.limits = workspace.limits().scene;
  options.explained_pair = arguments["a"].get<std::string>() + "," + arguments["b"].get<std::string>();
  const auto results = std::make_shared<ScratchRun>(*options.out);
  return command_call(workspace, {[options] { return run_command(options, std::cout, std::cerr); }, true,
                                  [results](const CommandOutcome& outcome) {
                                    if (outcome.out.empty()) return command_error(outcome);
                                    return ToolAnswer{outcome.out, nullptr, "", false};
                                  }});
}

ToolStart verify_cases(Workspace& workspace, const Json& arguments) {
  std::vector<std::string> words = {"verify", "--json"};
  if (!arguments.contains("cases"))
    words.emplace_back("--list");
  else
    for (const Json& name : arguments["cases"]) {
      if (name.get<std::string>().starts_with('-'))
        throw ToolRefusal("names of cases do not begin with -; verify without cases lists them");
      words.push_back(name);
    }
  // The cases are the program's, and lie beside it.
  return command_call(workspace, {command_line_work(words), false, [](const CommandOutcome& outcome) {
                                    Json report = printed_json(outcome);
                                    if (report.is_null()) return command_error(outcome);
                                    if (report.is_array()) report = {{"cases", std::move(report)}};
                                    return data_answer(std::move(report));
                                  }});
}

}  // namespace

std::vector<Tool> scene_tools(Workspace& workspace) {
  const auto with = [&workspace](ToolStart (*call)(Workspace&, const Json&)) {
    return [&workspace, call](const Json& arguments) { return call(workspace, arguments); };
  };
  const Json scene = text_argument("Path of a scene (TOML) below the server's folder");
  const Json set = settings_argument(
      "Keys of the scene to override, for example {\"analysis.end_time\": 0.5, \"block.stone.order\": 2}");
  std::vector<Tool> tools;
  tools.push_back(
      {"check", "Check a scene",
       "Read and validate a scene without running it. Returns all faults with file, line, column and "
       "message, "
       "and for a good scene its blocks, unknowns, memory and notes. Use it after every change of a scene.",
       arguments_schema({{"scene", scene}, {"set", set}}, {"scene"}), true, with(check_a_scene)});
  tools.push_back(
      {"blocks", "List the blocks of a scene",
       "Names, volumes, faces and neighbours of the blocks, also of pieces that cuts make; with a direction "
       "of gravity also "
       "the removable key blocks (Goodman and Shi).",
       arguments_schema(
           {{"scene", scene},
            {"names",
             text_argument("Only blocks with names of this pattern, such as rock.*; all by default")},
            {"first", whole_number_argument("Leave out so many of these; 0 by default", 0, 100'000'000)},
            {"count", whole_number_argument("At most so many; 50 by default", 0, 500)},
            {"removable", text_argument("Key-block analysis under a force of this direction, x,y,z: 0,0,-1")},
            {"stage", text_argument("Blocks of this stage; of all stages by default")},
            {"set", set}},
           {"scene"}),
       true, with(list_blocks)});
  tools.push_back(
      {"contacts", "Contacts of two meshes",
       "Exact contact report of two mesh files (OFF, OBJ, STL, PLY): relation, type, region, depth.",
       arguments_schema({{"a", text_argument("First mesh file")},
                         {"b", text_argument("Second mesh file")},
                         {"distance", number_argument("Contact distance, m", 0.0, 1e9)},
                         {"angle", number_argument("Contact angle, degrees", 0.0, 90.0)}},
                        {"a", "b"}),
       true, with(report_contacts)});
  tools.push_back(
      {"explain_contacts", "Explain the contacts of two blocks",
       "Run a scene to its end (results are not kept) and tell the contacts of two of its blocks there, and "
       "for each contact that was left out the reason. Shorten a long run by set: {\"analysis.end_time\": "
       "0.1}.",
       arguments_schema({{"scene", scene},
                         {"a", text_argument("Name of a block")},
                         {"b", text_argument("Name of another block")},
                         {"set", set}},
                        {"scene", "a", "b"}),
       true, with(explain_contacts)});
  tools.push_back(
      {"verify", "Verification cases",
       "Without cases: list the built-in cases with their references. With names: run these and compare them "
       "with their references (measured, reference, error, tolerance, passed).",
       arguments_schema({{"cases", texts_argument("Names of cases to run")}}), true, with(verify_cases)});
  return tools;
}

}  // namespace ashlar
