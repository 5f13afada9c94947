#include "apps/program/verify/cases/scene_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "apps/results/system/this_process.hpp"
#include "apps/scene/toml/include.hpp"
#include "apps/scene/toml/parameters.hpp"
#include "apps/scene/toml/scene_overrides.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {
namespace {

/// Entries of a table in the order of the file.
std::vector<std::pair<const toml::key*, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (auto entry = table.cbegin(); entry != table.cend(); ++entry)
    entries.emplace_back(&entry->first, &entry->second);
  const auto place = [](const auto& entry) {
    const toml::source_position& at = entry.first->source().begin;
    return std::pair{at.line, at.column};
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return entries;
}

/// A value of a key in one variant.
struct Chosen {
  std::string key;
  const toml::node* value;
};

/// All combinations of the values of one entry of `vary`.
std::vector<std::vector<Chosen>> combinations(const toml::table& entry) {
  std::vector<std::vector<Chosen>> all(1);
  for (const auto& [key, node] : in_order(entry)) {
    const std::string name(key->str());
    std::vector<const toml::node*> values;
    if (const toml::array* list = node->as_array())
      for (const toml::node& value : *list) values.push_back(&value);
    else
      values.push_back(node);
    std::vector<std::vector<Chosen>> next;
    for (const std::vector<Chosen>& before : all) {
      for (const toml::node* value : values) {
        next.push_back(before);
        next.back().push_back({name, value});
      }
    }
    all = std::move(next);
  }
  return all;
}

std::string toml_text(const toml::node& node) {
  std::string text;
  node.visit([&](const auto& value) {
    std::ostringstream stream;
    if constexpr (toml::is_floating_point<decltype(value)>)
      stream << fmt::format("{}", value.get());
    else
      stream << value;
    text = stream.str();
  });
  return text;
}

/// The name of a choice in labels: the last part of its path, and its value without quotes.
std::string label_of(const Chosen& chosen) {
  const bool number = chosen.value->is_number();
  std::string value = number ? fmt::format("{:.6g}", number_in(*chosen.value)) : toml_text(*chosen.value);
  if (value.size() > 1 && (value.front() == '\'' || value.front() == '"'))
    value = value.substr(1, value.size() - 2);
  if (value.starts_with("= ")) value.erase(0, 2);
  return chosen.key.substr(chosen.key.rfind('.') + 1) + " " + value;
}

/// Reads the cases of one file.
class CaseReader {
 public:
  CaseReader(TomlReading& reading, std::vector<std::string> files, std::filesystem::path folder)
      : reading_(reading), files_(std::move(files)), folder_(std::move(folder)) {}

  /// @param source the table, which `table` reads
  [[nodiscard]] SceneCase read(const std::string& name, const toml::table& source, TomlTableReader table) {
    SceneCase result;
    result.name = name;
    result.place = reading_.places().key(name);
    std::string scene;
    for (const char* key : {"about", "reference", "source", "scene"})
      if (!table.given(key)) table.require(key);
    (void)table.read_text("about", result.about);
    (void)table.read_text("reference", result.reference);
    (void)table.read_text("source", result.source);
    if (table.read_text("scene", scene)) result.scene = folder_ / scene;
    const toml::table* define = table.table_at("define");
    const auto varied = read_varied(source, table);
    result.checks = table.read_tables("check", [&](TomlTableReader& check) { return read_check(check); });
    if (result.checks.empty())
      reading_.error(result.place, fmt::format("case {} has no check, one is needed", name));
    if (!scene.empty()) add_variants(result, varied, define);
    return result;
  }

 private:
  /// The variants; one without values if there is no `vary`. Its entries have free names, which no reader knows.
  static std::vector<std::vector<Chosen>> read_varied(const toml::table& source, TomlTableReader& table) {
    if (!table.given("vary")) return {{}};
    std::vector<std::vector<Chosen>> all;
    const toml::array* list = source.get_as<toml::array>("vary");
    if (list == nullptr || !list->is_array_of_tables()) {
      table.error_at_value("vary", "vary has the wrong type, an array of tables is needed");
      return {{}};
    }
    for (const toml::node& entry : *list)
      for (std::vector<Chosen>& variant : combinations(*entry.as_table())) all.push_back(std::move(variant));
    return all;
  }

  CaseText read_expression(TomlTableReader& table, const char* key) {
    CaseText result;
    if (table.read_text(key, result.text)) result.place = reading_.places().value(table.path(key));
    return result;
  }

  CaseText read_tolerance(TomlTableReader& table, const char* key) {
    if (table.text_at(key)) return read_expression(table, key);
    std::optional<double> value;
    if (!table.read_number(key, value, range::not_negative) || !value) return {};
    return {fmt::format("{}", *value), reading_.places().value(table.path(key))};
  }

  CaseCheck read_check(TomlTableReader& table) {
    CaseCheck check;
    check.place = reading_.places().key(table.path());
    (void)table.read_text("what", check.what);
    check.value = read_expression(table, "value");
    if (!check.value.given()) table.require("value");
    if (check.what.empty()) check.what = check.value.text;
    int references = 0;
    for (const auto& [key, kind] : {std::pair{"expect", CaseCheck::Kind::equal},
                                    {"at_least", CaseCheck::Kind::at_least},
                                    {"at_most", CaseCheck::Kind::at_most},
                                    {"is", CaseCheck::Kind::is}}) {
      if (!table.given(key)) continue;
      ++references;
      check.kind = kind;
      // A number is an expression, too.
      check.expected = kind == CaseCheck::Kind::is ? read_expression(table, key) : read_reference(table, key);
    }
    if (references != 1)
      table.error_at_table(fmt::format(
          "check has {} references, one of expect, at_least, at_most and is is needed", references));
    const CaseText relative = read_tolerance(table, "relative"), absolute = read_tolerance(table, "absolute");
    check.relative = relative.given();
    check.tolerance = check.relative ? relative : absolute;
    const bool compares = check.kind == CaseCheck::Kind::equal;
    if ((relative.given() && absolute.given()) || (compares && !check.tolerance.given()))
      table.error_at_table("check has no single tolerance, one of relative and absolute is needed");
    check.when = read_expression(table, "when");
    return check;
  }

  CaseText read_reference(TomlTableReader& table, const char* key) {
    if (table.text_at(key)) return read_expression(table, key);
    std::optional<double> value;
    if (!table.read_number(key, value, range::any_number) || !value) return {};
    return {fmt::format("{:.17g}", *value), reading_.places().value(table.path(key))};
  }

  /// Values and overrides of all variants.
  void add_variants(SceneCase& result, const std::vector<std::vector<Chosen>>& varied,
                    const toml::table* define) {
    std::optional<SceneDocument> document = read_document(result.scene, result.place, reading_.diagnostics());
    if (!document) return;
    if (varied.empty())
      reading_.error(result.place,
                     fmt::format("case {} has no variant, vary with values is needed", result.name));
    const toml::table* parameters = document->tree["parameters"].as_table();
    std::vector<std::string> files = files_;
    files.insert(files.end(), document->files.begin(), document->files.end());
    for (const std::vector<Chosen>& chosen : varied) {
      toml::table values = parameters == nullptr ? toml::table{} : *parameters;
      CaseVariant& variant = result.variants.emplace_back();
      for (Chosen value : chosen) {
        if (value.key.starts_with("parameters.")) value.key.erase(0, std::strlen("parameters."));
        const bool is_parameter = value.key.find('.') == std::string::npos;
        variant.overrides.push_back((is_parameter ? "parameters." : "") + value.key + "=" +
                                    toml_text(*value.value));
        variant.label += (variant.label.empty() ? "" : ", ") + label_of(value);
        if (!is_parameter) continue;
        if (!values.contains(value.key))
          reading_.error(*value.value,
                         fmt::format("{} is no parameter of {}, a parameter or a path with dots is needed",
                                     value.key, result.scene.filename().string()));
        values.insert_or_assign(value.key, *value.value);
      }
      if (define != nullptr)
        for (auto entry = define->cbegin(); entry != define->cend(); ++entry) {
          if (values.contains(entry->first.str()))
            reading_.error(
                entry->second,
                fmt::format("{} is a parameter of the scene, another name is needed", entry->first.str()));
          values.insert_or_assign(entry->first, entry->second);
        }
      toml::table whole;
      whole.insert("parameters", std::move(values));
      // Copies of nodes have no places: faults have that of the table of definitions.
      Diagnostics faults;
      ScenePlaces places;
      TomlReading reading(files, faults, places);
      variant.names = read_parameters(whole, reading);
      for (const Diagnostic& fault : faults.sorted())
        reading_.error(reading_.places().key(result.name + ".define"),
                       fmt::format("case {}: {}", result.name, fault.message));
    }
  }

  TomlReading& reading_;
  std::vector<std::string> files_;
  std::filesystem::path folder_;
};

std::vector<SceneCase> read_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::optional<SceneDocument> document = read_document(file, {file.string(), 1, 1}, diagnostics);
  if (!document) return {};
  ScenePlaces places;
  const Place start{file.string(), 1, 1};
  places.record("", {start, start});
  TomlReading reading(document->files, diagnostics, places);
  TomlTableReader top(reading, document->tree, "", "");
  CaseReader reader(reading, document->files, file.parent_path());
  std::vector<SceneCase> cases;
  for (const auto& [key, node] : in_order(document->tree)) {
    const std::string name(key->str());
    std::optional<TomlTableReader> table = top.table(name);
    if (!table) continue;
    cases.push_back(reader.read(name, *node->as_table(), std::move(*table)));
  }
  reading.report_unknown_keys();
  return cases;
}

void add_cases(const std::filesystem::path& folder, std::vector<SceneCase>& cases, Diagnostics& diagnostics) {
  const std::filesystem::path file = folder / "cases.toml";
  if (std::filesystem::exists(file))
    for (SceneCase& found : read_file(file, diagnostics)) cases.push_back(std::move(found));
  std::vector<std::filesystem::path> below;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory()) below.push_back(entry.path());
  std::sort(below.begin(), below.end());
  for (const std::filesystem::path& path : below) add_cases(path, cases, diagnostics);
}

}  // namespace

std::vector<SceneCase> read_cases(const std::filesystem::path& folder, Diagnostics& diagnostics) {
  std::vector<SceneCase> cases;
  try {
    add_cases(folder, cases, diagnostics);
  } catch (const std::filesystem::filesystem_error& error) {
    diagnostics.error(
        {folder.string()},
        fmt::format("folder cannot be read ({}), a folder of cases is needed", error.code().message()));
    return {};
  }
  if (cases.empty() && diagnostics.good())
    diagnostics.error({folder.string()}, "folder has no cases.toml, a folder of cases is needed");
  std::set<std::string> names;
  for (const SceneCase& found : cases)
    if (!names.insert(found.name).second)
      diagnostics.error(found.place,
                        fmt::format("case {} is there already, another name is needed", found.name));
  return cases;
}

std::filesystem::path own_cases() {
  std::error_code ignored;
  const std::filesystem::path folder =
      program_file().parent_path().parent_path() / "share/ashlar/verification";
  return std::filesystem::is_directory(folder, ignored) ? folder : std::filesystem::path();
}

}  // namespace ashlar
