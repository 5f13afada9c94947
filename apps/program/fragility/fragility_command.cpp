#include "apps/program/fragility/fragility_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "apps/program/fragility/fragility_results.hpp"
#include "apps/program/number_option.hpp"
#include "apps/program/plot/plot_script.hpp"
#include "apps/program/run/override_option.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/include.hpp"
#include "apps/scene/toml/scene_overrides.hpp"

namespace ashlar {
namespace {

constexpr std::size_t most_scales = 10'000;

[[noreturn]] void refuse_scales(const std::string& text, const std::string& what) {
  throw std::invalid_argument(
      fmt::format("--scales {}: {}, FIRST:STEP:LAST or numbers > 0 between commas are "
                  "needed",
                  text, what));
}

std::vector<double> scales_of_range(const std::string& text, const std::vector<double>& range) {
  constexpr double rounding = 1e-6;  // of the step
  if (range.size() != 3) refuse_scales(text, fmt::format("range has {} numbers", range.size()));
  const double first = range[0], step = range[1], last = range[2];
  if (!(step > 0.0)) refuse_scales(text, fmt::format("step is not above 0 ({})", step));
  if (!(last >= first))
    refuse_scales(text, fmt::format("last scale is below the first ({} and {})", last, first));
  const double steps = std::floor((last - first) / step + rounding);
  if (!(steps < static_cast<double>(most_scales)))
    refuse_scales(text, fmt::format("more than {} scales", most_scales));
  std::vector<double> scales;
  for (double k = 0.0; k <= steps; ++k) {
    // As a user writes it: 0.3, not 0.30000000000000004.
    const std::string digits = fmt::format("{:.12g}", first + k * step);
    scales.push_back(csv_number(digits).value_or(first + k * step));
  }
  return scales;
}

/// Faults of the command line and of files, already told or to be told as the exception's text.
struct Refused : std::runtime_error {
  using runtime_error::runtime_error;
};

void refuse_faults(const Diagnostics& diagnostics, std::ostream& err) {
  if (diagnostics.good()) return;
  diagnostics.print(err);
  throw Refused("");
}

/// Faults of a scene that could be run, but not by records.
void check_motion(const FragilityPlan& plan, const Scene& scene, Diagnostics& diagnostics) {
  const Place place = scene.places.value(plan.staged ? "stage" : "analysis.type");
  const SceneAnalysis& last = plan.staged ? scene.stage.back().analysis : scene.analysis;
  if (last.type != SceneAnalysis::Type::dynamic)
    diagnostics.error(
        place, fmt::format("records move a scene in time only, analysis.type = \"dynamic\" is needed{}",
                           plan.staged ? " in its last stage" : ""));
  for (const FragilityRecord& record : plan.records)
    if (plan.staged && record.end > last.end_time)
      diagnostics.error(place,
                        fmt::format("the last stage ends before record {} does ({} and {} s), an end_time of "
                                    "at least that of its record is needed",
                                    record.name, last.end_time, record.end));
}

/// Builds the scene with a record, so that names of columns are known and faults are told before the runs.
void check_scene(const FragilityPlan& plan, std::ostream& err) {
  const PlannedRun first = planned_runs(plan, "").front();
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded = load_scene(plan.scene, first.options.overrides, diagnostics);
  if (loaded) check_motion(plan, loaded->scene, diagnostics);
  refuse_faults(diagnostics, err);
  diagnostics.print(err);
  const Run run(std::move(*loaded));
  if (CollapseWatch(run.whole(), run.simulation()).blocks() == 0)
    diagnostics.error(
        {plan.scene.string(), 1, 1},
        "no block can move (all are fixed, or moved by supports), one that is neither is needed");
  refuse_faults(diagnostics, err);
  for (const Limit& limit : plan.limits) (void)demand_of_row(limit, run.columns());
}

FragilityPlan plan_of(const FragilityOptions& options, const IntensityMeasure& measure, std::ostream& err) {
  FragilityPlan plan;
  if (options.scene == "-")
    throw Refused("a fragility analysis cannot read standard input (-), a file is needed");
  plan.scene = options.scene;
  plan.scales = parse_scales(options.scales);
  for (const std::string& text : options.limits) plan.limits.push_back(parse_limit(text));
  if (plan.limits.empty()) plan.limits.push_back(parse_limit("collapse"));
  for (std::size_t k = 0; k < plan.limits.size(); ++k)
    for (std::size_t n = 0; n < k; ++n)
      if (plan.limits[k].text == plan.limits[n].text)
        throw Refused(fmt::format("--limit is given twice ({}), each is needed once", plan.limits[k].text));
  for (const std::string& text : options.varied) {
    plan.drawn.push_back(parse_varied_key(text));
    if (!plan.drawn.back().drawn)
      throw Refused(
          fmt::format("--vary lists values of {}, a random value is needed, as normal(MEAN,DEVIATION); "
                      "another scene is another analysis",
                      plan.drawn.back().key));
  }
  plan.samples = options.samples;
  plan.overrides = options.overrides;
  plan.after = options.after;
  plan.frames = options.frames;
  plan.force = options.force;
  Diagnostics diagnostics;
  std::optional<SceneDocument> document = read_document(plan.scene, {plan.scene.string(), 1, 1}, diagnostics);
  refuse_faults(diagnostics, err);
  apply_overrides(document->tree, plan.overrides, diagnostics);
  refuse_faults(diagnostics, err);
  plan.staged = document->tree.contains("stage");
  plan.places = record_places(document->tree, plan.scene, diagnostics);
  refuse_faults(diagnostics, err);
  auto records = read_records(options.records, plan.scene, plan.places, plan.overrides, measure, diagnostics);
  refuse_faults(diagnostics, err);
  plan.records = std::move(*records);
  check_scene(plan, err);
  return plan;
}

constexpr std::string_view table_mark = "record,scale,";

/// The folder of the results. @throws Refused if it, or a file in it, is another one
std::filesystem::path claimed_folder(const FragilityOptions& options) {
  const std::filesystem::path folder = options.out.value_or(options.scene.stem().string() + ".fragility");
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw Refused(fmt::format("{} is not a folder, another name is needed", folder.string()));
  refuse_other_file(folder / "fragility.csv", {"table of a fragility analysis", {table_mark}});
  for (const char* picture : {"fragility.svg", "ida.svg"}) refuse_other_plot(folder / picture, false);
  std::filesystem::create_directories(folder / "runs");
  return folder;
}

void write_results(const FragilityOptions& options, const FragilityPlan& plan,
                   const IntensityMeasure& measure, const std::vector<PlannedRun>& runs,
                   const std::filesystem::path& folder, std::ostream& out, std::ostream& err) {
  const std::vector<FragilityRow> rows = rows_of(plan, runs);
  constexpr double percent = 0.01;
  std::vector<FragilityFit> fits;
  for (std::size_t k = 0; k < plan.limits.size(); ++k)
    fits.push_back(fit_of(rows, k, percent * options.confidence));
  write_file_of_kind(folder / "fragility.csv", table_csv(fragility_table(plan, measure, rows)),
                     {"table of a fragility analysis", {table_mark}});
  write_file_atomically(folder / "fragility.json",
                        json_text(fragility_json(plan, measure, rows, fits), 1) + "\n", Durability::process);
  std::string told = write_plot(fragility_plot(plan, measure, rows, fits), folder / "fragility.svg", false);
  for (std::size_t k = 0; k < plan.limits.size(); ++k)
    if (const std::optional<Plot> plot = ida_plot(plan, measure, rows, k)) {
      told += write_plot(*plot, folder / "ida.svg", false);
      break;
    }
  const std::string unit = measure.unit().empty() ? "" : " " + measure.unit();
  for (std::size_t k = 0; k < plan.limits.size(); ++k)
    out << fmt::format("{}: {}\n", plan.limits[k].text, describe(fits[k], unit));
  const auto open = std::count_if(rows.begin(), rows.end(), [&](const FragilityRow& row) {
    return !row.outcome || !row.outcome->certain();
  });
  if (open > 0)
    err << fmt::format("ashlar: warning: {} of {} runs have no outcome and are not counted\n", open,
                       rows.size());
  if (!options.quiet) err << fmt::format("table: {}\n{}", (folder / "fragility.csv").string(), told);
}

CLI::Option* repeatable(CLI::App& command, const char* name, std::vector<std::string>& values,
                        const char* text) {
  return command.add_option(name, values, text)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->take_all();
}

/// Options that say what is run, and what is asked of it.
void declare_input(CLI::App& command, FragilityOptions& options) {
  command.add_option("SCENE", options.scene, "Scene file (TOML) whose acceleration_history is a file")
      ->required()
      ->type_name("");
  command
      .add_option("--records", options.records,
                  "Folder of records (.AT2, .V2, .smc, .csv, .txt) that take the place of that file")
      ->required()
      ->type_name("FOLDER");
  command
      .add_option("--scales", options.scales,
                  "Factors of the records: FIRST:STEP:LAST, or numbers between commas")
      ->required()
      ->type_name("A:B:C");
  repeatable(
      command, "--limit", options.limits,
      "What a run must not exceed: a comparison of a formula of columns of history.csv with a number, as "
      "\"storey.drift > 0.02\", or collapse (repeatable; default: collapse). A collapse exceeds all")
      ->type_name("LIMIT");
  command
      .add_option("--intensity", options.intensity,
                  "Intensity of the curves: pga, sa(PERIOD) with 5 % damping, or scale (default: pga)")
      ->type_name("MEASURE");
}

/// Options of the runs and their results.
void declare_runs(CLI::App& command, FragilityOptions& options) {
  repeatable(command, "--vary", options.varied,
             "A key and how its values are drawn, as for sweep (repeatable)")
      ->type_name("KEY=normal(...)");
  command
      .add_option("--samples", options.samples.count,
                  "Number of samples of random values, with each record and scale")
      ->transform(whole_number_option(1))
      ->type_name("N");
  command.add_option("--seed", options.samples.seed, "Of the samples (default: 1)")
      ->transform(whole_number_option(0, std::numeric_limits<std::uint64_t>::max()).description(""))
      ->type_name("S");
  command.add_option("--confidence", options.confidence, "Percent of the bounds of the curves (default: 95)")
      ->transform(real_number_option({.low = 1.0, .high = 99.99, .words = "a number from 1 to 99.99"}))
      ->type_name("PERCENT");
  command
      .add_option("--after", options.after,
                  "Time after the record, s, after which a run ends at the latest (default: 5)")
      ->transform(real_number_option({.low = 0.0, .words = "a number >= 0"}))
      ->type_name("S");
  command.add_option("-o,--out", options.out, "Folder of the results (default: scene name + .fragility)")
      ->type_name("FOLDER");
  command.add_option("-j,--jobs", options.jobs, "Runs at a time (default: one for each processor)")
      ->transform(whole_number_option(1))
      ->type_name("N");
  command.add_flag("--frames", options.frames,
                   "Keep the frames that the scene asks for (default: the first and the last state)");
  command.add_flag("--force", options.force, "Replace results of other scenes");
  command.add_flag("-q,--quiet", options.quiet, "Only faults and the fits");
  declare_overrides(command, options.overrides);
}

}  // namespace

std::vector<double> parse_scales(const std::string& text) {
  const bool is_range = text.find(':') != std::string::npos;
  std::vector<double> scales = numbers_of<double>(text, is_range ? ':' : ',');
  if (scales.empty()) refuse_scales(text, "not a list of numbers");
  if (std::any_of(scales.begin(), scales.end(), [](double scale) { return !std::isfinite(scale); }))
    refuse_scales(text, "a number is not finite");
  if (is_range) scales = scales_of_range(text, scales);
  std::sort(scales.begin(), scales.end());
  if (!(scales.front() > 0.0))
    refuse_scales(text, fmt::format("a scale is not above 0 ({})", scales.front()));
  if (const auto twice = std::adjacent_find(scales.begin(), scales.end()); twice != scales.end())
    refuse_scales(text, fmt::format("a scale is given twice ({})", *twice));
  return scales;
}

int fragility_command(const FragilityOptions& options, std::ostream& out, std::ostream& err) {
  FragilityPlan plan;
  IntensityMeasure measure;
  std::vector<PlannedRun> runs;
  std::filesystem::path folder;
  try {
    measure = parse_intensity(options.intensity);
    plan = plan_of(options, measure, err);
    folder = claimed_folder(options);
    runs = planned_runs(plan, folder / "runs");
  } catch (const Refused& fault) {
    if (*fault.what() != '\0') err << fmt::format("ashlar: error: {}\n", fault.what());
    return exit_status::bad_input;
  } catch (const std::invalid_argument& fault) {
    err << fmt::format("ashlar: error: {}\n", fault.what());
    return exit_status::bad_input;
  }
  const int status = execute(plan, runs, options.jobs, options.quiet, err);
  write_results(options, plan, measure, runs, folder, out, err);
  return status;
}

void declare_fragility_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand(
      "fragility", "Run a scene with scaled records of earthquakes; fits fragility curves to limits");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<FragilityOptions>();
  declare_input(*command, *options);
  declare_runs(*command, *options);
  command->callback(
      [options, &context] { context.status = fragility_command(*options, context.out, context.err); });
}

}  // namespace ashlar
