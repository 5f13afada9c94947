#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/command_call.hpp"
#include "apps/program/mcp/tools/tools.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr double longest_wait = 300.0;  // s

/// The last line of progress that a run has printed; empty: none.
std::string last_progress(const std::string& messages) {
  const std::size_t line = messages.rfind("\nstep ");
  const std::size_t begin = line == std::string::npos ? 0 : line + 1;
  if (!std::string_view(messages).substr(begin).starts_with("step ")) return "";
  return messages.substr(begin, messages.find('\n', begin) - begin);
}

/// Values of its summary that say how a run ended.
void add_end(const std::filesystem::path& folder, Json& told) {
  try {
    const Json summary = parse_json(whole_file(folder / "summary.json"));
    for (const char* key : {"status", "message", "end_time", "time", "steps"})
      if (summary.contains(key)) told[key] = summary[key];
  } catch (const std::exception& fault) {
    told["status"] = std::string("summary.json cannot be read: ") + fault.what();
  }
}

std::string next_step(const ServedRun& run, int status) {
  if (status == exit_status::bad_input)
    return "refused: see messages; correct the scene (check) and start it again";
  if (run.too_long) return "stopped at the server's limit of hours; its state is kept, resume: true goes on";
  if (status == exit_status::interrupted)
    return "stopped; its state is kept, run_start with resume: true goes on";
  if (status == exit_status::done) return "summary, history and picture show its results";
  return "failed: see messages and summary; its last good state is kept";
}

Json state_of(const Workspace& workspace, ServedRun& run) {
  constexpr std::size_t most_messages = 6000;
  const std::optional<int> status = run.process->status();
  const std::string messages = run.process->err();
  Json told = {{"run", run.name},
               {"scene", run.scene.string()},
               {"folder", run.folder.string()},
               {"state", status ? "ended" : "working"},
               {"seconds", std::round(10.0 * run.process->seconds()) / 10.0}};
  if (!status && run.asked_to_end) told["state"] = "stopping after the present step";
  if (const std::string progress = last_progress(messages); !progress.empty()) told["progress"] = progress;
  if (status) {
    told["exit_status"] = *status;
    if (*status != exit_status::bad_input) add_end(workspace.folder().root() / run.folder, told);
    told["next"] = next_step(run, *status);
    told["messages"] = last_part(messages, most_messages);
  }
  return told;
}

/// Waits for the end of a run.
class RunCall final : public ToolCall {
 public:
  enum class IfCancelled { may_continue, ends };

  RunCall(Workspace& workspace, ServedRun& run, double seconds, IfCancelled if_cancelled)
      : workspace_(workspace),
        run_(run),
        until_(std::chrono::steady_clock::now() +
               std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                   std::chrono::duration<double>(seconds))),
        if_cancelled_(if_cancelled) {}

  std::optional<ToolAnswer> answer() override {
    const std::optional<int> status = run_.process->status();
    if (!status && std::chrono::steady_clock::now() < until_) return std::nullopt;
    ToolAnswer answer = data_answer(state_of(workspace_, run_));
    // A scene with faults is the caller's fault; a run that fails is a result.
    answer.is_error = status == exit_status::bad_input;
    return answer;
  }

  void cancel() override {
    if (if_cancelled_ == IfCancelled::may_continue || std::exchange(run_.asked_to_end, true)) return;
    run_.process->ask_to_end();
  }

  [[nodiscard]] std::string progress() const override { return last_progress(run_.process->err()); }

 private:
  Workspace& workspace_;
  ServedRun& run_;
  std::chrono::steady_clock::time_point until_;
  IfCancelled if_cancelled_;
};

ToolStart start_a_run(Workspace& workspace, const Json& arguments) {
  constexpr double usual_wait = 2.0;
  RunOptions options;
  options.scene = workspace.folder().file(arguments["scene"].get<std::string>());
  options.out = workspace.folder().inside(
      arguments.value("out", (options.scene.parent_path() / options.scene.stem()).string() + ".out"));
  options.overrides = overrides_of(arguments);
  options.resume = arguments.value("resume", false);
  options.force = arguments.value("replace", false);
  options.threads = arguments.value("threads", 1);
  if (options.resume && options.force)
    throw ToolRefusal("resume goes on with results, replace computes them again; give one of both");
  if (options.out == options.scene) throw ToolRefusal("out is the scene itself; give another folder");
  ServedRun& run = workspace.start(std::move(options));
  return std::make_unique<RunCall>(workspace, run, arguments.value("wait_seconds", usual_wait),
                                   RunCall::IfCancelled::ends);
}

ToolStart tell_a_run(Workspace& workspace, const Json& arguments) {
  if (arguments.contains("run"))
    return std::make_unique<RunCall>(workspace, workspace.run_of(arguments["run"].get<std::string>()),
                                     arguments.value("wait_seconds", 0.0),
                                     RunCall::IfCancelled::may_continue);
  Json runs = Json::array();
  for (const std::unique_ptr<ServedRun>& run : workspace.runs()) runs.push_back(state_of(workspace, *run));
  for (Json& run : runs) run.erase("messages");
  return data_answer({{"runs", std::move(runs)}});
}

ToolStart stop_a_run(Workspace& workspace, const Json& arguments) {
  constexpr double usual_wait = 60.0;
  ServedRun& run = workspace.run_of(arguments["run"].get<std::string>());
  if (!run.process->status() && !std::exchange(run.asked_to_end, true)) run.process->ask_to_end();
  return std::make_unique<RunCall>(workspace, run, arguments.value("wait_seconds", usual_wait),
                                   RunCall::IfCancelled::may_continue);
}

}  // namespace

std::vector<Tool> run_tools(Workspace& workspace) {
  const auto with = [&workspace](ToolStart (*call)(Workspace&, const Json&)) {
    return [&workspace, call](const Json& arguments) { return call(workspace, arguments); };
  };
  const Json run = text_argument("Its name, such as run-1");
  const auto wait = [](const char* meaning) { return number_argument(meaning, 0.0, longest_wait); };
  const auto processors = static_cast<std::int64_t>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<Tool> tools;
  tools.push_back(
      {"run_start", "Start a run",
       "Simulate a scene, in the background. Returns the run's name; if it ends within wait_seconds, its "
       "end. Poll it by "
       "run_status. Results go to one folder for each run.",
       arguments_schema(
           {{"scene", text_argument("Path of a scene (TOML) below the server's folder")},
            {"out", text_argument("Result folder; the scene's path without .toml, with .out, by default")},
            {"set",
             settings_argument("Keys of the scene to override, for example {\"analysis.end_time\": 0.5}")},
            {"resume", flag_argument("Go on with the results in the folder, after a stop")},
            {"replace", flag_argument("Compute results in the folder again")},
            {"threads", whole_number_argument("Threads; 1 by default", 1, processors)},
            {"wait_seconds", wait("Wait so long for its end; 2 by default")}},
           {"scene"}),
       false, with(start_a_run)});
  tools.push_back(
      {"run_status", "State of runs",
       "How far a run is, or how it ended with its messages. Without a name: all runs of this server.",
       arguments_schema({{"run", run}, {"wait_seconds", wait("Wait so long for its end; 0 by default")}}),
       true, with(tell_a_run)});
  tools.push_back(
      {"run_stop", "Stop a run",
       "Ask a run to end after its present step. Its state is kept: run_start with resume goes on bit for "
       "bit.",
       arguments_schema({{"run", run}, {"wait_seconds", wait("Wait so long for its end; 60 by default")}},
                        {"run"}),
       false, with(stop_a_run)});
  return tools;
}

}  // namespace ashlar
