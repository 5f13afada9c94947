#include "apps/program/mcp/mcp_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <ostream>
#include <system_error>
#include <thread>

#include "apps/program/mcp/mcp_session.hpp"
#include "apps/program/mcp/tools/tools.hpp"
#include "apps/program/number_option.hpp"
#include "apps/results/system/input_lines.hpp"
#include "apps/results/system/interrupt_guard.hpp"
#include "apps/results/system/process_copy.hpp"
#include "apps/results/text/json_text.hpp"

namespace ashlar {
namespace {

constexpr std::size_t longest_message = 16'000'000;  // bytes
constexpr double bytes_of_gigabyte = 1e9;
// While calls work their ends are looked for; otherwise only runs are looked after.
constexpr std::chrono::milliseconds busy_wait(10), idle_wait(500);

/// Takes lines until the client is gone or somebody asks the server to end.
void serve(McpSession& session, Workspace& workspace, const std::ostream& out) {
  InputLines lines(longest_message);
  while (!lines.ended() && out.good() && !InterruptGuard::interrupted()) {
    while (const std::optional<InputLine> line = lines.next()) {
      if (line->too_long)
        session.refuse_long_line(longest_message);
      else
        session.receive(line->text);
    }
    session.poll();
    workspace.look_after_runs();
    lines.wait(session.works() ? busy_wait : idle_wait);
  }
}

}  // namespace

int mcp_command(const McpOptions& options, std::ostream& out, std::ostream& err) {
  if (!copies_have_streams()) {
    err << "ashlar: error: mcp runs calls in copies of its process, which Windows does not have; run it on "
           "Linux, or in "
           "the Windows Subsystem for Linux\n";
    return exit_status::failed;
  }
  const InterruptGuard guard;
  std::unique_ptr<Workspace> workspace;
  try {
    workspace = std::make_unique<Workspace>(options.folder, options.limits);
    // Commands then name files as clients do.
    std::filesystem::current_path(workspace->folder().root());
  } catch (const std::filesystem::filesystem_error& fault) {
    err << fmt::format("ashlar: error: folder {} cannot be used ({}), give one that exists\n",
                       options.folder.string(), fault.code().message());
    return exit_status::bad_input;
  }
  {
    McpSession session(all_tools(*workspace), [&out](const nlohmann::ordered_json& message) {
      // Processes that are started inherit nothing unwritten.
      out << json_text(message) << '\n' << std::flush;
    });
    serve(session, *workspace, out);
  }
  while (!workspace->end_runs()) std::this_thread::sleep_for(busy_wait);
  return InterruptGuard::interrupted() ? exit_status::interrupted : exit_status::done;
}

void declare_mcp_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand(
      "mcp", "Serve agents by the Model Context Protocol, over standard input and output");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<McpOptions>();
  const auto memory = std::make_shared<double>(options->limits.scene.memory / bytes_of_gigabyte);
  command
      ->add_option("--folder", options->folder,
                   "Folder that clients work in: scenes and results outside of it are not reached")
      ->required()
      ->type_name("DIR");
  command->add_option("--runs", options->limits.runs, "Most runs at a time (default: 2)")
      ->type_name("N")
      ->transform(whole_number_option(1, 1000));
  command
      ->add_option("--blocks", options->limits.scene.blocks,
                   "Most blocks of a scene that is run (default: 5000)")
      ->type_name("N")
      ->transform(whole_number_option(1));
  const RealOptionRange above_zero{.low = 0.0, .low_allowed = false, .words = "a number > 0"};
  command->add_option("--memory", *memory, "Most memory that a run is estimated to need, GB (default: 4)")
      ->type_name("GB")
      ->transform(real_number_option(above_zero));
  command
      ->add_option("--hours", options->limits.hours,
                   "Longest run; it is then stopped, its state kept (default: 24)")
      ->type_name("H")
      ->transform(real_number_option(above_zero));
  command
      ->add_option("--seconds", options->limits.seconds,
                   "Longest call of another tool; it is then given up (default: 600)")
      ->type_name("S")
      ->transform(real_number_option(above_zero));
  command->callback([options, memory, &context] {
    options->limits.scene.memory = bytes_of_gigabyte * *memory;
    context.status = mcp_command(*options, context.out, context.err);
  });
}

}  // namespace ashlar
