#include "apps/program/sweep/sweep_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/results/text/json_path.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Results of one run.
struct RunValues {
  Json summary;                                        ///< null: none
  std::vector<std::pair<std::string, double>> at_end;  ///< columns of the history

  [[nodiscard]] std::optional<double> find(const std::string& given) const {
    const std::string name = present_name(given);
    const auto column =
        std::find_if(at_end.begin(), at_end.end(), [&](const auto& entry) { return entry.first == name; });
    if (column != at_end.end()) return column->second;
    const Json* value = value_at(summary, name);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  }
};

RunValues values_in(const std::filesystem::path& folder) {
  RunValues values;
  const std::filesystem::path summary = folder / "summary.json", history = folder / "history.csv";
  if (!std::filesystem::exists(summary)) return values;
  values.summary = naming_the_file(summary, [&] { return parse_json(whole_file(summary)); });
  if (!std::filesystem::exists(history)) return values;
  const HistoryTable table = read_history(history, 2);
  if (table.rows.empty()) return values;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    values.at_end.emplace_back(table.columns[k], table.rows.back()[k]);
  return values;
}

/// Default columns.
std::vector<std::string> usual_values(const std::vector<RunValues>& runs) {
  std::vector<std::string> names = {"time"};
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const RunValues& run : runs) {
    for (const char* factor : {"factor_of_safety", "load_factor"})
      if (run.summary.is_object() && run.summary.contains(factor))
        for (const char* end : {".lower", ".upper"}) add(std::string(factor) + end);
    if (!run.summary.is_object() || !run.summary.contains("scene")) continue;
    for (const Json& measure : run.summary.at("scene").value("measure", Json::array()))
      for (const auto& [column, value] : run.at_end)
        if (column.starts_with(measure.value("name", std::string()) + ".")) add(column);
  }
  return names;
}

/// Status of a variant without summary: an interrupted sweep may not have reached it.
std::string status_without_summary(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder.string() + ".log")) return "not run";
  return std::filesystem::exists(folder / ".ashlar") ? "interrupted" : "refused";
}

}  // namespace

SweepTable sweep_table(const std::vector<VariedKey>& keys, const std::vector<Variant>& variants,
                       const std::vector<std::filesystem::path>& folders,
                       const std::vector<std::string>& values) {
  std::vector<RunValues> runs;
  runs.reserve(folders.size());
  for (const std::filesystem::path& folder : folders) runs.push_back(values_in(folder));
  const std::vector<std::string> names = values.empty() ? usual_values(runs) : values;
  SweepTable table;
  for (const VariedKey& key : keys) table.columns.push_back(quote_csv_field(key.key));
  table.columns.insert(table.columns.end(), {"folder", "status"});
  for (const std::string& name : names) table.columns.push_back(quote_csv_field(name));
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<std::string>& row = table.rows.emplace_back();
    for (const std::string& value : variants[k].values) {
      // Numbers, including negative ones, are numbers in the table.
      row.push_back(csv_number(value) ? value : quote_csv_field(value));
    }
    row.push_back(quote_csv_field(folders[k].parent_path().filename().string() + "/" + variants[k].folder));
    row.push_back(runs[k].summary.is_object() ? runs[k].summary.value("status", std::string("damaged"))
                                              : status_without_summary(folders[k]));
    for (const std::string& name : names) {
      std::string& field = row.emplace_back();
      if (const std::optional<double> value = runs[k].find(name)) append_csv_number(field, *value);
    }
  }
  return table;
}

std::optional<std::size_t> column_of(const SweepTable& table, const std::string& name) {
  for (const std::string& known : {name, quote_csv_field(name)}) {
    const auto column = std::find(table.columns.begin(), table.columns.end(), known);
    if (column != table.columns.end()) return static_cast<std::size_t>(column - table.columns.begin());
  }
  return std::nullopt;
}

std::string table_csv(const SweepTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const std::vector<std::string>& row : table.rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

}  // namespace ashlar
