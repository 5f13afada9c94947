#include "apps/program/spectrum/spectrum_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "apps/program/number_option.hpp"
#include "apps/program/plot/plot_script.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/results/tables/response_spectrum.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/records/record_file.hpp"
#include "apps/scene/records/record_processing.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

/// Faults of the input, with their places.
struct SpectrumError : std::runtime_error {
  using runtime_error::runtime_error;
};

double scale_of(const std::string& text) {
  if (text == "g") return standard_gravity;
  if (const std::optional<double> scale = csv_number(text); scale && std::isfinite(*scale)) return *scale;
  throw SpectrumError(
      fmt::format("ashlar: error: --scale is no number (\"{}\"), a number or \"g\" is needed\n", text));
}

std::vector<AccelerationSegment> segments_of_record(const SpectrumOptions& options, std::ostream& err) {
  SceneRecord record;
  record.file = options.input;
  record.time = options.time;
  record.values = {options.column.empty() ? "acceleration" : options.column};
  record.scale = scale_of(options.scale);
  Diagnostics diagnostics;
  auto rows = read_record(record, "", {options.input.string(), 1, 1}, diagnostics);
  diagnostics.print(err);
  if (!rows) throw SpectrumError("");
  if (options.baseline) {
    if (rows->size() <= static_cast<std::size_t>(*options.baseline))
      throw SpectrumError(
          fmt::format("{}:1:1: error: record is too short for its baseline ({} rows), more than {} "
                      "are needed\n",
                      options.input.string(), rows->size(), *options.baseline));
    remove_baseline(*rows, *options.baseline);
  }
  std::vector<double> times, values;
  for (const auto& row : *rows) {
    times.push_back(row[0]);
    values.push_back(row[1]);
  }
  return segments_of_acceleration(times, values);
}

std::size_t column_of(const HistoryTable& table, const std::string& name, const std::filesystem::path& file) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
  throw SpectrumError(
      fmt::format("{}:1:1: error: no column of that name (\"{}\"), {}one of the first line is "
                  "needed\n",
                  file.string(), name, guess(name, table.columns, "\"")));
}

bool is_velocity(const std::string& column) {
  return column.ends_with(".vx") || column.ends_with(".vy") || column.ends_with(".vz");
}

std::vector<AccelerationSegment> segments_of_run(const SpectrumOptions& options) {
  const std::filesystem::path file = options.input / "history.csv";
  if (!is_velocity(options.column))
    throw SpectrumError(
        fmt::format("ashlar: error: --column is no velocity of a measured point (\"{}\"), NAME.vx, "
                    "NAME.vy or NAME.vz of a [[measure]] is needed\n",
                    options.column));
  const HistoryTable table = read_history(file, std::numeric_limits<std::size_t>::max());
  const std::size_t time = column_of(table, "time", file), value = column_of(table, options.column, file);
  const bool staged = std::find(table.columns.begin(), table.columns.end(), "stage") != table.columns.end();
  if (!staged && options.stage)
    throw SpectrumError("ashlar: error: --stage of a run without stages, leave it out\n");
  const std::size_t stage = staged ? column_of(table, "stage", file) : 0;
  const double wanted =
      !staged || table.rows.empty() ? 0.0 : options.stage.value_or(table.rows.back()[stage]);
  std::vector<double> times, values;
  for (const auto& row : table.rows) {
    if (staged && row[stage] != wanted) continue;
    if (!times.empty() && !(row[time] > times.back())) continue;
    times.push_back(row[time]);
    values.push_back(row[value]);
  }
  if (times.size() < 2)
    throw SpectrumError(
        fmt::format("{}:1:1: error: history is too short ({} times{}), at least 2 are needed\n",
                    file.string(), times.size(), staged ? fmt::format(" in stage {}", wanted) : ""));
  return segments_of_velocity(times, values);
}

constexpr std::string_view spectrum_header = "period,displacement,pseudo_velocity,pseudo_acceleration";

std::string table_of(const std::vector<SpectrumPoint>& spectrum) {
  std::string table = std::string(spectrum_header) + '\n';
  for (const SpectrumPoint& point : spectrum) {
    append_csv_number(table, point.period);
    for (const double value : {point.displacement, point.pseudo_velocity, point.pseudo_acceleration}) {
      table += ',';
      append_csv_number(table, value);
    }
    table += '\n';
  }
  return table;
}

Plot plot_of(const SpectrumOptions& options, const std::vector<SpectrumPoint>& spectrum) {
  Plot plot;
  plot.title = fmt::format("Response spectrum of {}{}{}, {:g} % damping", options.input.filename().string(),
                           options.column.empty() ? "" : ", ", options.column, options.damping);
  plot.x_label = "period, s";
  plot.y_label = "pseudo-acceleration, m/s\u00b2";
  plot.slopes = false;
  PlotSeries& series = plot.series.emplace_back();
  series.name = fmt::format("{:g} %", options.damping);
  series.marks = false;
  for (const SpectrumPoint& point : spectrum) {
    series.x.push_back(point.period);
    series.y.push_back(point.pseudo_acceleration);
  }
  return plot;
}

}  // namespace

int spectrum_command(const SpectrumOptions& options, std::ostream& out, std::ostream& err) {
  try {
    if (!(options.shortest < options.longest))
      throw SpectrumError(fmt::format("ashlar: error: --longest is not above --shortest ({} and {} s)\n",
                                      options.longest, options.shortest));
    const bool run = std::filesystem::is_directory(options.input);
    const auto segments = run ? segments_of_run(options) : segments_of_record(options, err);
    const auto spectrum =
        response_spectrum(segments, spectrum_periods(options.shortest, options.longest, options.periods),
                          options.damping / 100.0);
    const std::string table = table_of(spectrum);
    if (!options.out) {
      out << table;
      return exit_status::done;
    }
    refuse_other_plot(*options.out, true);
    write_file_of_kind(*options.out, table, {"response spectrum", {spectrum_header}});
    out << fmt::format("table: {}\n{}", options.out->string(),
                       write_plot(plot_of(options, spectrum), *options.out, true));
    return exit_status::done;
  } catch (const SpectrumError& fault) {
    err << fault.what();
  } catch (const std::invalid_argument& fault) {
    err << "ashlar: error: " << fault.what() << '\n';
  } catch (const std::runtime_error& fault) {
    err << "ashlar: error: " << fault_text(fault) << '\n';
    return exit_status::of(fault);
  }
  return exit_status::bad_input;
}

void declare_spectrum_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("spectrum", "Response spectrum of a record or of a measured point of a run");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<SpectrumOptions>();
  command
      ->add_option("INPUT", options->input, "Record (.AT2, .V2, .smc, .csv, .txt), or result folder of a run")
      ->required()
      ->type_name("");
  command
      ->add_option(
          "--column", options->column,
          "Accelerations of a record (.V2: acceleration, acceleration.2); of a run NAME.vx of a measure")
      ->type_name("NAME");
  command->add_option("--time", options->time, "Column of times of a record (default: time)")
      ->type_name("NAME");
  command->add_option("--scale", options->scale, "Factor of a record, to m/s^2: a number or g (default: 1)")
      ->type_name("FACTOR");
  command
      ->add_option("--baseline", options->baseline,
                   "Order of the polynomial that is removed from a record by least squares")
      ->transform(whole_number_option(0, largest_baseline_order));
  command->add_option("--stage", options->stage, "Stage of a run, from 1 on (default: the last)")
      ->transform(whole_number_option(1))
      ->type_name("N");
  command->add_option("--damping", options->damping, "Percent of critical damping (default: 5)")
      ->transform(real_number_option({.low = 0.0, .high = 99.0, .words = "a number from 0 to 99"}))
      ->type_name("PERCENT");
  command->add_option("--shortest", options->shortest, "Shortest period, s (default: 0.01)")
      ->transform(real_number_option({.low = 0.0, .low_allowed = false, .words = "a number > 0"}))
      ->type_name("S");
  command->add_option("--longest", options->longest, "Longest period, s (default: 10)")
      ->transform(real_number_option({.low = 0.0, .low_allowed = false, .words = "a number > 0"}))
      ->type_name("S");
  command->add_option("--periods", options->periods, "Number of periods, with equal ratios (default: 151)")
      ->transform(whole_number_option(2, 100000));
  command
      ->add_option("-o,--out", options->out,
                   "Table (CSV); a picture is written beside it (default: the table is printed)")
      ->type_name("FILE");
  command->callback(
      [options, &context] { context.status = spectrum_command(*options, context.out, context.err); });
}

}  // namespace ashlar
