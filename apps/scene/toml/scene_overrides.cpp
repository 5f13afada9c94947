#include "apps/scene/toml/scene_overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/toml_faults.hpp"
#include "apps/scene/toml/toml_reading.hpp"

namespace ashlar {
namespace {

// Keys of one table of which only one may be given.
const std::vector<std::vector<std::string_view>> exclusive_keys = {
    {"every", "interval"},
    {"box", "mesh", "hull", "sphere"},
    {"solid", "voronoi"},
    {"chord_tolerance", "subdivisions"},
    {"traction", "force"},
    {"plane", "point"},
    {"displacement_history", "velocity_history", "acceleration_history"}};

// A fault of one override, reported by apply_overrides.
struct OverrideError : std::runtime_error {
  using runtime_error::runtime_error;
};

struct Assignment {
  std::vector<std::string> path;
  toml::table tree;  // the path as nested tables, with the value at its end
};

// The single chain of keys of a document "a.b.c = 0".
std::vector<std::string> parse_path(const std::string& key) {
  std::vector<std::string> path;
  try {
    const toml::table parsed = parse_toml(key + " = 0", {});
    const toml::table* table = &parsed;
    while (table) {
      if (table->size() != 1) throw OverrideError(fmt::format("malformed key ({}), one is needed", key));
      path.emplace_back(table->begin()->first.str());
      table = table->begin()->second.as_table();
    }
  } catch (const toml::parse_error& error) {
    throw OverrideError(fmt::format("malformed key ({}), key.path=value is needed", error.description()));
  }
  return path;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + '"';
}

toml::table parse_tree(const std::string& key, std::string_view value, const std::string& origin) {
  try {
    return parse_toml(fmt::format("{} = {}", key, value), origin);
  } catch (const toml::parse_error& error) {
    if (const std::string range = number_out_of_range(error.description()); !range.empty())
      throw OverrideError(range);
    const std::size_t start = value.find_first_not_of(" \t");
    if (start == std::string_view::npos)
      throw OverrideError(fmt::format("no value (), a TOML value is needed"));
    if (std::string_view("[{\"'").find(value[start]) != std::string_view::npos)
      throw OverrideError(
          fmt::format("malformed value ({}: {}), a TOML value is needed", value, error.description()));
  }
  try {
    return parse_toml(fmt::format("{} = {}", key, quoted(value)), origin);
  } catch (const toml::parse_error& error) {
    throw OverrideError(
        fmt::format("malformed value ({}: {}), a TOML value is needed", value, error.description()));
  }
}

Assignment parse_assignment(const std::string& text, const std::string& origin) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw OverrideError(fmt::format("no = ({}), key.path=value is needed", text));
  const std::string key = text.substr(0, equals);
  Assignment result{parse_path(key), parse_tree(key, std::string_view(text).substr(equals + 1), origin)};
  const toml::table* table = &result.tree;
  for (std::size_t i = 0; table && i < result.path.size(); ++i) {
    if (table->size() != 1) throw OverrideError(fmt::format("several keys ({}), one is needed", text));
    table = table->begin()->second.as_table();
  }
  return result;
}

std::vector<std::string> names_of_entries(const toml::array& array) {
  std::vector<std::string> names;
  for (const toml::node& entry : array) {
    const toml::table* table = entry.as_table();
    const toml::node* name = table ? table->get("name") : nullptr;
    names.push_back(name && name->is_string() ? **name->as_string() : std::string());
  }
  return names;
}

std::size_t find_entry(const toml::array& array, const std::string& step, const std::string& where) {
  const std::vector<std::string> names = names_of_entries(array);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == step) return i;
  std::size_t index = 0;
  const char* end = step.data() + step.size();
  const auto [stop, status] = std::from_chars(step.data(), end, index);
  if (status == std::errc() && stop == end && index < array.size()) return index;
  if (array.empty()) throw OverrideError(fmt::format("no such entry ({}), {} is empty", step, where));
  std::string allowed = fmt::format("an index from 0 to {}", array.size() - 1);
  std::vector<std::string> named;
  for (const std::string& name : names)
    if (!name.empty()) named.push_back(name);
  if (!named.empty())
    allowed = fmt::format("{}{} or one of {}", guess(step, named), allowed, fmt::join(named, ", "));
  throw OverrideError(fmt::format("no such entry of {} ({}), {} is needed", where, step, allowed));
}

// Moves the only key of `from` to `to`, replacing it and the keys it excludes. Nodes are moved, as a copy would lose
// its source.
void move_only_key(toml::table& from, toml::table& to) {
  auto only = from.begin();
  const toml::key key = only->first;
  for (const auto& group : exclusive_keys)
    if (std::find(group.begin(), group.end(), key.str()) != group.end())
      for (const std::string_view excluded : group) to.erase(excluded);
  to.erase(key.str());
  only->second.visit([&](auto& value) { to.insert_or_assign(key, std::move(value)); });
}

void apply(toml::table& scene, Assignment& assignment) {
  toml::table* tree = &assignment.tree;
  toml::node* target = &scene;
  std::string where;
  for (std::size_t i = 0; i < assignment.path.size(); ++i) {
    const std::string& step = assignment.path[i];
    const bool last = i + 1 == assignment.path.size();
    if (toml::array* array = target->as_array()) {
      const std::size_t index = find_entry(*array, step, where);
      if (last) {
        tree->begin()->second.visit([&](auto& value) {
          array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), std::move(value));
        });
        return;
      }
      target = array->get(index);
    } else if (toml::table* table = target->as_table()) {
      if (last || !table->contains(step)) {
        move_only_key(*tree, *table);
        return;
      }
      target = table->get(step);
    } else {
      throw OverrideError(fmt::format("{} has no keys ({}), a table is needed", where, describe(*target)));
    }
    where += where.empty() ? step : "." + step;
    tree = tree->begin()->second.as_table();
  }
}

}  // namespace

void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides,
                     Diagnostics& diagnostics) {
  for (const std::string& text : overrides) {
    const std::string origin = "--set " + text;
    try {
      Assignment assignment = parse_assignment(text, origin);
      apply(scene, assignment);
    } catch (const OverrideError& error) {
      diagnostics.error({origin, 0, 0}, error.what());
    }
  }
}

}  // namespace ashlar
