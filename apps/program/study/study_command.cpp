#include "apps/program/study/study_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <ostream>

#include "apps/program/plot/plot_script.hpp"
#include "apps/program/study/error_time_study.hpp"
#include "apps/program/study/orders_study.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/model/nearest_name.hpp"

namespace ashlar {
namespace {

std::vector<std::string> names_of(std::span<const Study> studies) {
  std::vector<std::string> list;
  list.reserve(studies.size());
  for (const Study& study : studies) list.emplace_back(study.name);
  return list;
}

}  // namespace

std::span<const Study> studies() {
  // In the order of --help.
  static constexpr std::array<Study, 2> all = {
      {{"orders", "error, unknowns and time of one block against its order", without_progress<study_orders>},
       {"error-time", "error of motion against run time: order, integrator, step, formulation",
        without_progress<study_error_time>}}};
  return all;
}

int study_command(const StudyOptions& options, std::span<const Study> known, std::ostream& out,
                  std::ostream& err) {
  const auto study = std::find_if(known.begin(), known.end(),
                                  [&](const Study& candidate) { return candidate.name == options.name; });
  if (study == known.end()) {
    err << fmt::format("ashlar: error: unknown study ({}), {}one of {} is needed\n", options.name,
                       guess(options.name, names_of(known)), fmt::join(names_of(known), ", "));
    return exit_status::bad_input;
  }
  const std::filesystem::path folder = options.folder.value_or(options.name + ".study");
  std::optional<FolderClaim> claim;
  try {
    claim.emplace(folder, ClaimPurpose::addition);
  } catch (const ClaimRefused& refused) {
    err << "ashlar: error: " << refused.what() << '\n';
    return exit_status::bad_input;
  }
  const StudyResult result = study->run([&err](const std::string& line) { err << line << std::endl; });
  const std::filesystem::path table = folder / (options.name + ".csv");
  const std::string text = table_csv(result);
  write_file_of_kind(table, text,
                     {"table of this study", {std::string_view(text).substr(0, text.find('\n'))}});
  out << table_text(result);
  for (const std::string& finding : result.findings) out << finding << '\n';
  out << fmt::format("table: {}\n", table.string());
  out << write_plot(result.plot, folder / (options.name + ".svg"), true);
  return result.holds ? exit_status::done : exit_status::failed;
}

void declare_study_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("study", "Measure error against cost; writes a table and a picture");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<StudyOptions>();
  std::string list = "Study:";
  for (const Study& study : studies()) list += fmt::format("\n  {}: {}", study.name, study.description);
  command->add_option("NAME", options->name, list)->required()->type_name("");
  command->add_option("--out", options->folder, "Result folder (default: NAME.study)")->type_name("DIR");
  command->callback(
      [options, &context] { context.status = study_command(*options, studies(), context.out, context.err); });
}

}  // namespace ashlar
