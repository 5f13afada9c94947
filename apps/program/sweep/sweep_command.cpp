#include "apps/program/sweep/sweep_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <stdexcept>

#include "apps/program/number_option.hpp"
#include "apps/program/plot/plot_script.hpp"
#include "apps/program/run/override_option.hpp"
#include "apps/program/sweep/sample_statistics.hpp"
#include "apps/program/sweep/sweep_plot.hpp"
#include "apps/program/sweep/sweep_runs.hpp"
#include "apps/program/sweep/sweep_table.hpp"
#include "apps/program/sweep/variants.hpp"
#include "apps/results/text/atomic_file.hpp"

namespace ashlar {
namespace {

/// True if a file is a table of these keys, or does not exist.
bool may_be_replaced(const std::filesystem::path& table, const SweepTable& mine) {
  if (!std::filesystem::exists(table)) return true;
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);
  const auto folder = std::find(mine.columns.begin(), mine.columns.end(), "folder");
  return line.starts_with(fmt::format("{}", fmt::join(mine.columns.begin(), folder + 2, ",")));
}

/// Equal samples are run once.
std::vector<SweepRun> runs_of(const SweepOptions& options, const std::vector<VariedKey>& keys,
                              const std::vector<Variant>& variants,
                              const std::vector<std::filesystem::path>& folders) {
  std::vector<SweepRun> runs;
  std::set<std::filesystem::path> known;
  for (std::size_t n = 0; n < variants.size(); ++n) {
    if (!known.insert(folders[n]).second) continue;
    auto& [run, name] = runs.emplace_back();
    run.scene = options.scene;
    run.overrides = options.overrides;
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < keys.size(); ++k)
      settings.push_back(fmt::format("{}={}", keys[k].key, variants[n].values[k]));
    run.overrides.insert(run.overrides.end(), settings.begin(), settings.end());
    run.out = folders[n];
    run.force = options.force;
    run.quiet = true;
    name = fmt::format("{}", fmt::join(settings, ", "));
  }
  return runs;
}

/// @throws std::invalid_argument if the folder of a picture does not exist, or if a file with its name or that of its script
/// is another one
void refuse_other_pictures(const std::filesystem::path& picture) {
  if (const auto folder = picture.parent_path(); !folder.empty() && !std::filesystem::is_directory(folder))
    throw std::invalid_argument(fmt::format("--picture {}: its folder does not exist", picture.string()));
  refuse_other_plot(picture, picture.extension() == ".png");
}

/// The first requested value, or else the first default one besides the time.
std::string first_value(const SweepOptions& options, const std::vector<VariedKey>& keys,
                        const SweepTable& table) {
  if (!options.values.empty()) return options.values.front();
  const std::size_t first = keys.size() + 2;  // after folder and status
  return table.columns.size() > first + 1 ? table.columns[first + 1] : table.columns.at(first);
}

void write_picture(const SweepOptions& options, const Plot& plot, std::ostream& err) {
  const std::string told = write_plot(plot, *options.picture, options.picture->extension() == ".png");
  if (!options.quiet || told.starts_with("no picture")) err << told;
}

/// Statistics of the first value over the samples, and its histogram.
void tell_samples(const SweepOptions& options, const std::vector<VariedKey>& keys, const SweepTable& table,
                  std::ostream& err) {
  constexpr double unit_factor = 1.0;  // below which a factor of safety or of loads is failure
  const std::string value = first_value(options, keys, table);
  const std::vector<SampleGroup> groups = sample_groups(keys, table, value, unit_factor);
  for (const SampleGroup& group : groups)
    err << fmt::format("{}{}{}\n", group.name, group.name.empty() ? "" : ": ",
                       to_string(statistics_of(group.values, unit_factor), value, unit_factor));
  if (options.picture) write_picture(options, histogram_of(groups, value), err);
}

}  // namespace

int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  const auto refuse = [&](const std::string& why) {
    err << fmt::format("ashlar: error: {}\n", why);
    return static_cast<int>(exit_status::bad_input);
  };
  if (options.picture && options.picture->extension() != ".svg" && options.picture->extension() != ".png")
    return refuse(fmt::format("{} is not a supported picture; use .svg or .png", options.picture->string()));
  if (options.scene == "-") return refuse("a sweep cannot read standard input (-); give a file");
  std::vector<VariedKey> keys;
  std::vector<Variant> variants;
  try {
    for (const std::string& text : options.varied) keys.push_back(parse_varied_key(text));
    variants = variants_of(keys, options.samples);
    // Faults are reported before the runs.
    if (options.picture && options.samples.count == 0) (void)sweep_plot(keys, {{"value"}, {}}, "value");
    if (options.picture) refuse_other_pictures(*options.picture);
  } catch (const std::invalid_argument& fault) {
    return refuse(fault.what());
  }
  const std::filesystem::path file = options.table.value_or(options.scene.stem().string() + ".sweep.csv");
  std::filesystem::path folder = file;
  folder.replace_extension(".runs");
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    return refuse(fmt::format("{} is not a folder; give another table", folder.string()));
  if (!options.force && !may_be_replaced(file, sweep_table(keys, {}, {}, {})))
    return refuse(
        fmt::format("{} is not a table of these keys; give another name or --force", file.string()));
  std::filesystem::create_directories(folder);

  std::vector<std::filesystem::path> folders;
  folders.reserve(variants.size());
  for (const Variant& variant : variants) folders.push_back(folder / variant.folder);
  const int status = run_sweep(runs_of(options, keys, variants, folders), options.jobs, options.quiet, err);
  const SweepTable table = sweep_table(keys, variants, folders, options.values);
  for (std::size_t k = 0; k < options.values.size(); ++k) {
    const std::size_t column = table.columns.size() - options.values.size() + k;
    if (std::all_of(table.rows.begin(), table.rows.end(),
                    [&](const auto& row) { return row[column].empty(); }))
      err << fmt::format(
          "ashlar: warning: no run has a number of that name ({}), a column of history.csv or a path in "
          "summary.json is "
          "needed, entries of lists by their name (thrust.left.least)\n",
          options.values[k]);
  }
  const std::string text = table_csv(table);
  write_file_atomically(file, text, Durability::process);
  out << text;
  if (!options.quiet) err << fmt::format("table: {}\n", file.string());
  if (options.samples.count > 0)
    tell_samples(options, keys, table, err);
  else if (options.picture)
    write_picture(options, sweep_plot(keys, table, first_value(options, keys, table)), err);
  return status;
}

void declare_sweep_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("sweep", "Run a scene with several values of some keys; writes a table");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<SweepOptions>();
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* text) {
    return command->add_option(name, values, text)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->take_all();
  };
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required()->type_name("");
  repeatable(
      "--vary", options->varied,
      "A key and its values; all combinations of several keys are run. Or a key and how its values are "
      "drawn: normal(MEAN,DEVIATION), normal(MEAN,DEVIATION,LEAST,MOST), lognormal(...) likewise, "
      "uniform(LEAST,MOST), triangular(LEAST,MODE,MOST) (repeatable)")
      ->required()
      ->type_name("KEY=A,B,...");
  command
      ->add_option(
          "--samples", options->samples.count,
          "Number of samples of random values: their statistics are printed at the end, and --picture is a "
          "histogram")
      ->transform(whole_number_option(1))
      ->type_name("N");
  command->add_option("--seed", options->samples.seed, "Of the samples (default: 1)")
      ->transform(whole_number_option(0, std::numeric_limits<std::uint64_t>::max()).description(""))
      ->type_name("S");
  repeatable("--value", options->values,
             "A number for the table: a column of history.csv at its end, or a path in summary.json "
             "(repeatable; default: time, factors, measures)")
      ->type_name("NAME");
  command
      ->add_option("-o,--out", options->table,
                   "The table (default: scene name + .sweep.csv); runs are beside it")
      ->type_name("FILE");
  command
      ->add_option(
          "--picture", options->picture,
          "A picture too, of the first value against the keys: .svg, or .png with an .svg beside it; a "
          "script beside them draws it (Python with matplotlib)")
      ->type_name("FILE");
  command->add_option("-j,--jobs", options->jobs, "Runs at a time (default: one for each processor)")
      ->transform(whole_number_option(1))
      ->type_name("N");
  command->add_flag("--force", options->force, "Replace results of other scenes, and another table");
  command->add_flag("-q,--quiet", options->quiet, "Only faults");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = sweep_command(*options, context.out, context.err); });
}

}  // namespace ashlar
