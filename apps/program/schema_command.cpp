#include "apps/program/schema_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <vector>

#include "apps/results/columns/contact_columns.hpp"
#include "apps/results/columns/frame_columns.hpp"
#include "apps/results/columns/history_columns.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_schema.hpp"

namespace ashlar {

namespace {

nlohmann::ordered_json json_of(const std::vector<Column>& columns) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Column& column : columns)
    json.push_back(
        {{"name", column.name}, {"unit", column.unit}, {"group", column.group}, {"meaning", column.meaning}});
  return json;
}

/// Columns and fields of results: of history.csv by kind of measure ("": of the run), of contacts.csv, of frames.
nlohmann::ordered_json schema_of_results() {
  nlohmann::ordered_json json;
  for (const MeasureColumns& kind : columns_by_kind()) json["history.csv"][kind.kind] = json_of(kind.columns);
  json["contacts.csv"] = json_of(contact_columns());
  for (const FrameField& field : frame_fields())
    json["frames"][field.series].push_back(
        {{"name", field.name}, {"unit", field.unit}, {"meaning", field.meaning}});
  return json;
}

}  // namespace

void declare_schema_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("schema", "A JSON schema of scenes, for editors and validators");
  // Shared with the callback that reads it.
  const auto results = std::make_shared<bool>(false), keys = std::make_shared<bool>(false);
  command->add_flag("--results", *results, "The columns of results instead, with units and meanings");
  command->add_flag("--keys", *keys,
                    "The keys of scenes as lists instead, with values, units, defaults and meanings");
  command->callback([results, keys, &context] {
    context.out << json_text(*results ? schema_of_results()
                             : *keys  ? scene_reference()
                                      : scene_schema(),
                             2)
                << '\n';
    context.status = exit_status::done;
  });
}

}  // namespace ashlar
