#include "apps/sweep/sweep_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>

#include "apps/results/atomic_file.hpp"
#include "apps/results/identity_json.hpp"
#include "apps/results/json_text.hpp"
#include "apps/results/output_stream.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/override_option.hpp"
#include "apps/run/run_command.hpp"
#include "apps/run/run_files.hpp"
#include "apps/run/run_messages.hpp"
#include "apps/scene/fault_text.hpp"
#include "apps/scene/input_file.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_loading.hpp"
#include "apps/study/log_log_plot.hpp"
#include "apps/sweep/sample_statistics.hpp"
#include "apps/sweep/sweep_plot.hpp"
#include "apps/sweep/sweep_table.hpp"
#include "apps/sweep/variants.hpp"
#include "apps/view/svg_picture.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto poll_interval = std::chrono::milliseconds(20);

/// The summary of a run that has ended; null: there is none.
Json ended_summary(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  if (!std::filesystem::exists(file)) return nullptr;
  Json summary = naming_the_file(file, [&] { return parse_json(whole_file(file)); });
  if (!summary.is_object() || summary.value("status", std::string()) == "interrupted") return nullptr;
  return summary;
}

int exit_status_in(const Json& summary) {
  const std::string status = summary.value("status", std::string());
  return status == "failed" || status == "not converged" ? exit_status::failed : exit_status::done;
}

/// How the log of a run begins whose results were not of the present files.
constexpr std::string_view again = "run again: ";

/// A run that has ended: kept, run again where files or the program are others, or refused where the scene is.
int run_over_results(RunOptions run, const Json& summary, std::ostream& log) {
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(run.scene, run.overrides, diagnostics);
  const bool has_scene = loaded && summary.contains("scene");
  if (has_scene && Json(to_json(loaded->scene)) == summary.at("scene")) {
    const Json was = summary.contains("identity") ? summary.at("identity") : Json();
    const std::vector<std::string> differences = identity_differences(was, scene_identity(*loaded));
    if (differences.empty()) {
      log << "kept: these results are of this scene\n";
      return exit_status_in(summary);
    }
    log << again << fmt::format("{}\n", fmt::join(differences, "; "));
    run.force = true;
  }
  if (!run.force) {
    diagnostics.print(log);
    const std::string changes =
        has_scene ? changes_since(*run.out, loaded->scene, scene_identity(*loaded)) : "";
    log << fmt::format("ashlar: error: results of another scene ({}), --force or another table is needed{}\n",
                       run.out->string(), changes);
    return exit_status::bad_input;
  }
  return run_command(run, log);
}

/// True if a run that did not end left a state to go on from.
bool has_state(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / checkpoint_name) || std::filesystem::exists(folder / trials_name);
}

/// True if a run can go on from the state in its folder. What is wrong with the scene is told when it is run.
bool is_of_this_scene(const RunOptions& run) {
  Diagnostics told_later;
  const std::optional<LoadedScene> loaded = load_scene(run.scene, run.overrides, told_later);
  if (!loaded || !std::filesystem::exists(*run.out / checkpoint_name)) return loaded.has_value();
  try {
    (void)read_checkpoint(*run.out / checkpoint_name, scene_identity(*loaded).scene);
    return true;
  } catch (const CheckpointError&) {
    return false;
  }
}

/// One variant: kept, gone on with, or run. Called in a process of its own.
int run_variant(RunOptions run, std::ostream& log) {
  const Json summary = ended_summary(*run.out);
  if (!summary.is_null()) return run_over_results(std::move(run), summary, log);
  run.resume = has_state(*run.out) && (!run.force || is_of_this_scene(run));
  run.force = run.force && !run.resume;
  return run_command(run, log);
}

/// The same with whatever is thrown in the log.
int logged_variant(const RunOptions& run, std::ostream& log) {
  try {
    return run_variant(run, log);
  } catch (const std::bad_alloc& error) {
    log << "ashlar: error: " << missing_memory(error) << '\n';
  } catch (const std::exception& error) {
    log << "ashlar: error: " << fault_text(error) << '\n';
  }
  return exit_status::failed;
}

/// The process ends with the status of the run.
[[noreturn]] void run_in_child(const RunOptions& run, OutputFile log_file) {
  // A signal to the terminal's group is the sweep's to pass on: once.
  (void)setpgid(0, 0);
  // A sweep that is killed leaves no run behind.
  (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
  OutputStreamBuffer buffer(std::move(log_file));
  std::ostream log(&buffer);
  _exit(logged_variant(run, log));
}

/// Why results were not kept, as a log tells; empty: they were, or there were none.
std::string reason_in(const std::filesystem::path& log) {
  std::ifstream stream(log);
  std::string line;
  std::getline(stream, line);
  return line.starts_with(again) ? line : "";
}

/// Runs of variants in processes, some at a time.
class Runs {
 public:
  Runs(const SweepOptions& options, std::vector<RunOptions> runs, std::vector<std::string> names,
       std::ostream& err)
      : options_(options), runs_(std::move(runs)), names_(std::move(names)), err_(err) {}

  /// @return exit status of the sweep
  int go() {
    const InterruptGuard guard;
    const std::size_t jobs = options_.jobs > 0 ? static_cast<std::size_t>(options_.jobs)
                                               : std::max(1U, std::thread::hardware_concurrency());
    std::size_t next = 0;
    while (next < runs_.size() || !children_.empty()) {
      if (InterruptGuard::interrupted()) {
        stop();
        next = runs_.size();
      }
      while (next < runs_.size() && children_.size() < jobs) start(next++);
      if (!collect()) std::this_thread::sleep_for(poll_interval);
    }
    return stopped_ ? exit_status::interrupted : status_;
  }

 private:
  [[nodiscard]] static std::filesystem::path log_of(const RunOptions& run) {
    return run.out->string() + ".log";
  }

  void start(std::size_t run) {
    std::optional<OutputFile> log;
    try {
      log.emplace(log_of(runs_[run]), OutputFile::Start::empty);
    } catch (const std::runtime_error& fault) {
      err_ << fmt::format("ashlar: error: {}; a plain file is written there\n", fault_text(fault));
      note(run, exit_status::bad_input);
      return;
    }
    const pid_t child = fork();
    if (child < 0) {
      const int reason = errno;
      stop();
      throw std::system_error(reason, std::generic_category(), "a process for a run cannot be made");
    }
    if (child == 0) run_in_child(runs_[run], std::move(*log));
    children_.emplace(child, run);
  }

  /// Takes note of one run that has ended. @return whether there was one
  bool collect() {
    for (const auto& [child, run] : children_) {
      int how = 0;
      const pid_t ended = waitpid(child, &how, WNOHANG);
      if (ended == 0) continue;
      if (ended < 0) how = -1;
      note(run, ended > 0 && WIFEXITED(how) ? WEXITSTATUS(how) : exit_status::failed);
      children_.erase(child);
      return true;
    }
    return false;
  }

  void note(std::size_t run, int status) {
    ++done_;
    // Refused is worse than failed, being stopped is told by stopped_.
    if (status == exit_status::interrupted)
      stopped_ = true;
    else
      status_ = std::max(status_, status);
    if (options_.quiet && status == exit_status::done) return;
    const char* word = status == exit_status::done          ? "done"
                       : status == exit_status::failed      ? "failed"
                       : status == exit_status::interrupted ? "interrupted"
                                                            : "refused";
    err_ << fmt::format("{} of {}: {}: {}", done_, runs_.size(), names_[run], word);
    if (status != exit_status::done) err_ << fmt::format(", see {}", log_of(runs_[run]).string());
    if (const std::string reason = reason_in(log_of(runs_[run])); !reason.empty())
      err_ << fmt::format(" ({})", reason);
    err_ << std::endl;
  }

  void stop() {
    if (stopped_) return;
    stopped_ = true;
    for (const auto& [child, run] : children_) (void)kill(child, SIGTERM);
  }

  const SweepOptions& options_;
  std::vector<RunOptions> runs_;
  std::vector<std::string> names_;
  std::ostream& err_;
  std::map<pid_t, std::size_t> children_;
  std::size_t done_ = 0;
  int status_ = exit_status::done;
  bool stopped_ = false;
};

/// True if a file is a table of these keys, or is not there.
bool may_be_replaced(const std::filesystem::path& table, const SweepTable& mine) {
  if (!std::filesystem::exists(table)) return true;
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);
  const auto folder = std::find(mine.columns.begin(), mine.columns.end(), "folder");
  return line.starts_with(fmt::format("{}", fmt::join(mine.columns.begin(), folder + 2, ",")));
}

/// @param names what is varied in each
std::vector<RunOptions> runs_of(const SweepOptions& options, const std::vector<VariedKey>& keys,
                                const std::vector<Variant>& variants, const std::filesystem::path& folder,
                                std::vector<std::string>& names) {
  std::vector<RunOptions> runs;
  for (const Variant& variant : variants) {
    RunOptions& run = runs.emplace_back();
    run.scene = options.scene;
    run.overrides = options.overrides;
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < keys.size(); ++k)
      settings.push_back(fmt::format("{}={}", keys[k].key, variant.values[k]));
    run.overrides.insert(run.overrides.end(), settings.begin(), settings.end());
    run.out = folder / variant.folder;
    run.force = options.force;
    run.quiet = true;
    names.push_back(fmt::format("{}", fmt::join(settings, ", ")));
  }
  return runs;
}

/// Samples may have drawn the same values.
void run_each_once(std::vector<RunOptions>& runs, std::vector<std::string>& names) {
  std::set<std::filesystem::path> known;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!known.insert(*runs[k].out).second) continue;
    if (kept != k) {
      runs[kept] = std::move(runs[k]);
      names[kept] = std::move(names[k]);
    }
    ++kept;
  }
  runs.resize(kept);
  names.resize(kept);
}

/// @throws std::invalid_argument if what has the names of the pictures is none
void refuse_other_pictures(std::filesystem::path picture) {
  if (picture.extension() == ".png") refuse_other_file(picture, "PNG picture", {png_mark});
  refuse_other_file(picture.replace_extension(".svg"), "SVG picture", {svg_mark});
}

/// The first value that was asked for, or else the first usual one beside the time.
std::string first_value(const SweepOptions& options, const std::vector<VariedKey>& keys,
                        const SweepTable& table) {
  if (!options.values.empty()) return options.values.front();
  const std::size_t first = keys.size() + 2;  // after folder and status
  return table.columns.size() > first + 1 ? table.columns[first + 1] : table.columns.at(first);
}

void write_picture(const SweepOptions& options, const std::string& svg, std::ostream& err) {
  std::filesystem::path file = *options.picture;
  file.replace_extension(".svg");
  write_file_atomically(file, svg, Durability::process);
  if (!options.quiet) err << fmt::format("picture: {}\n", file.string());
  if (options.picture->extension() == ".png")
    err << write_png(svg, *options.picture, plot_width, plot_height) << '\n';
}

/// Statistics of the first value over the samples, and its histogram.
void tell_samples(const SweepOptions& options, const std::vector<VariedKey>& keys, const SweepTable& table,
                  std::ostream& err) {
  constexpr double unit_factor = 1.0;  // below which a factor of safety or of loads is failure
  const std::string value = first_value(options, keys, table);
  const std::vector<SampleGroup> groups = sample_groups(keys, table, value);
  for (const SampleGroup& group : groups)
    err << fmt::format("{}{}{}\n", group.name, group.name.empty() ? "" : ": ",
                       to_string(statistics_of(group.values, unit_factor), value, unit_factor));
  if (options.picture) write_picture(options, histogram_svg(groups, value), err);
}

}  // namespace

int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  const auto refuse = [&](const std::string& why) {
    err << fmt::format("ashlar: error: {}\n", why);
    return static_cast<int>(exit_status::bad_input);
  };
  if (options.picture && options.picture->extension() != ".svg" && options.picture->extension() != ".png")
    return refuse(
        fmt::format("{} is no picture that is made, .svg or .png is needed", options.picture->string()));
  if (options.scene == "-") return refuse("a sweep reads its scene many times (-), a file is needed");
  std::vector<VariedKey> keys;
  std::vector<Variant> variants;
  try {
    for (const std::string& text : options.varied) keys.push_back(parse_varied_key(text));
    variants = variants_of(keys, options.samples);
    // Told before the runs, not after.
    if (options.picture && options.samples.count == 0) (void)sweep_svg(keys, {{"value"}, {}}, "value");
    if (options.picture && !options.force) refuse_other_pictures(*options.picture);
  } catch (const std::invalid_argument& fault) {
    return refuse(fault.what());
  }
  const std::filesystem::path file = options.table.value_or(options.scene.stem().string() + ".sweep.csv");
  std::filesystem::path folder = file;
  folder.replace_extension(".runs");
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    return refuse(fmt::format("{} is no folder, another table is needed", folder.string()));
  if (!options.force && !may_be_replaced(file, sweep_table(keys, {}, {}, {})))
    return refuse(
        fmt::format("{} is no table of these keys, another name or --force is needed", file.string()));
  std::filesystem::create_directories(folder);

  std::vector<std::string> names;
  std::vector<std::filesystem::path> folders;
  std::vector<RunOptions> runs = runs_of(options, keys, variants, folder, names);
  for (const RunOptions& run : runs) folders.push_back(*run.out);
  run_each_once(runs, names);
  const int status = Runs(options, std::move(runs), std::move(names), err).go();
  const SweepTable table = sweep_table(keys, variants, folders, options.values);
  for (std::size_t k = 0; k < options.values.size(); ++k) {
    const std::size_t column = table.columns.size() - options.values.size() + k;
    if (std::all_of(table.rows.begin(), table.rows.end(),
                    [&](const auto& row) { return row[column].empty(); }))
      err << fmt::format("ashlar: warning: no run has a number of that name ({})\n", options.values[k]);
  }
  const std::string text = table_csv(table);
  write_file_atomically(file, text, Durability::process);
  out << text;
  if (!options.quiet) err << fmt::format("table: {}\n", file.string());
  if (options.samples.count > 0)
    tell_samples(options, keys, table, err);
  else if (options.picture)
    write_picture(options, sweep_svg(keys, table, first_value(options, keys, table)), err);
  return status;
}

void declare_sweep_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("sweep", "Run a scene with several values of some keys; writes a table");
  // Lives as long as the callback that reads it.
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
          "Samples of the values that are drawn: their statistics are told at the end, and --picture is a "
          "histogram")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command->add_option("--seed", options->samples.seed, "Of the samples (default: 1)")
      ->check(CLI::NonNegativeNumber)
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
      ->add_option("--picture", options->picture,
                   "A picture too, of the first value against the keys: .svg, or .png with an .svg beside it")
      ->type_name("FILE");
  command->add_option("-j,--jobs", options->jobs, "Runs at a time (default: one for each processor)")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command->add_flag("--force", options->force, "Replace results of other scenes, and another table");
  command->add_flag("-q,--quiet", options->quiet, "Only faults");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = sweep_command(*options, context.out, context.err); });
}

}  // namespace ashlar
