#include "apps/program/view/view_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "apps/program/view/view_file.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {

int view_command(const ViewCommandOptions& options, std::ostream& out, std::ostream& err) {
  const std::filesystem::path page = options.page.value_or(options.folder / "view.html");
  try {
    refuse_other_file(page, view_page());
    ViewOptions wanted;
    wanted.points = options.all_points ? ViewPoints::all : ViewPoints::few;
    wanted.relative_to = options.relative_to;
    const ViewReport report = write_view_file(options.folder, page, wanted);
    out << fmt::format("view: {} ({} of {} frames, {:.1f} MB); open it in a browser\n", page.string(),
                       report.frames_kept, report.frames, 1e-6 * static_cast<double>(report.bytes));
    return exit_status::done;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    err << "ashlar: error: " << fault_text(error) << '\n';
    return exit_status::of(error);
  }
}

void declare_relative_to(CLI::App& command, std::optional<std::string>& block) {
  command
      .add_option("--relative-to", block,
                  "Displacements relative to a block, or none (default: the base, where a history moves one)")
      ->type_name("BLOCK");
}

void declare_view_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("view", "Write the results of a run as a page for the browser");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<ViewCommandOptions>();
  command->add_option("DIR", options->folder, "Result folder of a run")->required()->type_name("");
  command->add_option("-o,--out", options->page, "Page to write (default: DIR/view.html)")->type_name("FILE");
  command->add_flag("--points", options->all_points, "All contact points, also of frames with more than 500");
  declare_relative_to(*command, options->relative_to);
  command->callback(
      [options, &context] { context.status = view_command(*options, context.out, context.err); });
}

}  // namespace ashlar
