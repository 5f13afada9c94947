#include "apps/scene/keys/table_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace ashlar::keys {
namespace {

/// The first of the keys that is given.
std::optional<std::string> given_among(TomlTableReader& table, const std::vector<const char*>& keys) {
  for (const char* key : keys)
    if (table.given(key)) return key;
  return std::nullopt;
}

bool is_required(TomlTableReader& table, const AnyKey& key, const void* object) {
  if (key.required) return true;
  if (key.required_if && key.required_if(object)) return true;
  return !key.required_without.empty() && !given_among(table, key.required_without) &&
         !given_among(table, key.excluded_by);
}

/// Null if JSON does not have the key.
Json value_of(const AnyKey& key, const void* object) {
  if ((key.written && !key.written(object)) || (key.applies && !key.applies(object))) return nullptr;
  Json value = key.values->json(key.member_of(object));
  if (key.omit_empty && (value.empty() || value == "")) return nullptr;
  return value;
}

/// As in a scene: numbers as short as they are.
std::string toml_text(const Json& value) {
  if (value.is_number_float()) {
    std::string text = fmt::format("{:g}", value.get<double>());
    if (const std::size_t plus = text.find("e+"); plus != std::string::npos) text.erase(plus + 1, 1);
    return text;
  }
  if (!value.is_array()) return value.dump();
  std::string list;
  for (const Json& entry : value) list += (list.empty() ? "" : ", ") + toml_text(entry);
  return fmt::format("[{}]", list);
}

std::string default_of(const AnyKey& key, const void* defaults) {
  if (!key.absent.empty()) return key.absent;
  if (key.required) return "required";
  const Json value = value_of(key, defaults);
  return value.is_null() || value.is_object() ? "none" : fmt::format("`{}`", toml_text(value));
}

}  // namespace

bool refuse_beside(TomlTableReader& table, const std::string& key, const std::string& other) {
  table.error_at_key(key, fmt::format("{} beside {} (both given), only one of both is allowed", key, other));
  return false;
}

bool check_one_of(TomlTableReader& table, const char* what, const std::vector<const char*>& keys) {
  std::vector<std::string> given;
  for (const char* key : keys)
    if (table.given(key)) given.emplace_back(key);
  if (given.size() == 1) return true;
  const std::string number =
      given.empty() ? fmt::format("no {}", what) : fmt::format("{} {}s", given.size(), what);
  table.error_at_table(fmt::format("{} has {} ({}), exactly one of {} is needed", table.name(), number,
                                   given.empty() ? "none given" : fmt::format("{}", fmt::join(given, ", ")),
                                   fmt::join(keys, ", ")));
  return false;
}

TableKeys TableKeys::of_any(std::string meaning, const TableKeys& common,
                            const std::vector<const TableKeys*>& kinds) {
  std::vector<AnyKey> keys = common.keys_;
  for (const TableKeys* kind : kinds)
    for (AnyKey key : kind->keys_) {
      const auto same = [&](const AnyKey& other) { return other.name == key.name; };
      if (std::any_of(keys.begin(), keys.end(), same)) continue;
      key.absent = default_of(key, kind->defaults_.get());
      key.required = false;
      keys.push_back(std::move(key));
    }
  return {std::move(meaning), std::move(keys), {}, common.defaults_};
}

bool TableKeys::read(TomlTableReader& table, void* object) const {
  bool good = read_values(table, object);
  // Conditions are about values, which are read in any order.
  for (const AnyKey& key : keys_) good = check_presence(table, key, object) && good;
  for (const Rule& rule : rules_) good = rule(table, object) && good;
  return good;
}

bool TableKeys::read_table(TomlTableReader& parent, const std::string& key, void* object) const {
  if (std::optional<TomlTableReader> content = parent.table(key)) return read(*content, object);
  TomlTableReader empty = parent.empty_table(key);
  for (const AnyKey& inner : keys_) (void)empty.given(inner.name);
  return !parent.given(key);
}

bool TableKeys::read_values(TomlTableReader& table, void* object) const {
  bool good = true;
  for (const AnyKey& key : keys_) {
    if (key.found) continue;
    const bool given = table.given(key.name);
    const std::optional<std::string> other = given ? given_among(table, key.excluded_by) : std::nullopt;
    if (other) {
      good = refuse_beside(table, key.name, *other);
    } else if (!key.values->read(table, key.name, key.member(object)) && given) {
      key.values->spoil(key.member(object));
      good = false;
    }
  }
  return good;
}

bool TableKeys::check_presence(TomlTableReader& table, const AnyKey& key, const void* object) const {
  if (key.found) return true;
  if (!table.given(key.name)) {
    if (!is_required(table, key, object)) return true;
    table.require(key.name);
    key.values->spoil(key.member(const_cast<void*>(object)));
    return false;
  }
  if (!key.applies || key.applies(object)) return true;
  table.error_at_key(
      key.name, fmt::format("{} has no effect without {}, leave it out or choose that", key.name, key.needs));
  return false;
}

Json TableKeys::json(const void* object) const {
  Json json = Json::object();
  for (const AnyKey& key : keys_)
    if (Json value = value_of(key, object); !value.is_null()) json[key.name] = std::move(value);
  return json;
}

Json TableKeys::schema() const {
  Json properties = Json::object(), required = Json::array();
  for (const AnyKey& key : keys_) {
    if (key.found) continue;
    Json property = key.values->schema();
    std::string description = key.unit;
    if (!key.unit.empty() && !key.meaning.empty()) description += ", ";
    description += key.meaning;
    if (!description.empty()) property["description"] = std::move(description);
    properties[key.name] = std::move(property);
    if (key.required) required.push_back(key.name);
  }
  Json json = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!meaning_.empty()) json["description"] = meaning_;
  if (!required.empty()) json["required"] = std::move(required);
  return json;
}

Json TableKeys::rows() const {
  Json rows = Json::array();
  add_rows(rows, "");
  return rows;
}

void TableKeys::add_rows(Json& rows, const std::string& prefix) const {
  for (const AnyKey& key : keys_) {
    if (key.found) continue;
    const TableKeys* inner = key.values->inner();
    if (inner == nullptr || !key.meaning.empty())
      rows.push_back({{"key", prefix + key.name},
                      {"value", key.values->words()},
                      {"unit", key.unit},
                      {"default", default_of(key, defaults_.get())},
                      {"meaning", key.meaning}});
    if (inner != nullptr && !key.brief) inner->add_rows(rows, prefix + key.name + ".");
  }
}

void TableKeys::spoil(void* object) const {
  for (const AnyKey& key : keys_) key.values->spoil(key.member(object));
}

}  // namespace ashlar::keys
