#include "apps/run/scene_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> without_result = {"title", "analysis.end_time",
                                                            "analysis.memory_limit"};

std::string shown(const Json& value) {
  constexpr std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string name_of(const Json& entry, std::size_t index) {
  return entry.is_object() && entry.contains("name") && entry["name"].is_string()
             ? entry["name"].get<std::string>()
             : fmt::format("{}", index);
}

void compare(const std::string& path, const Json& was, const Json& is,
             std::vector<std::string>& differences) {
  if (was == is || std::find(without_result.begin(), without_result.end(), path) != without_result.end())
    return;
  if (was.is_object() && is.is_object()) {
    for (const auto& [key, value] : was.items()) {
      if (is.contains(key))
        compare(joined(path, key), value, is[key], differences);
      else
        differences.push_back(fmt::format("{} (was {}, is not given)", joined(path, key), shown(value)));
    }
    for (const auto& [key, value] : is.items())
      if (!was.contains(key))
        differences.push_back(fmt::format("{} (was not given, is {})", joined(path, key), shown(value)));
    return;
  }
  const auto holds_tables = [](const Json& list) {
    return list.is_array() && !list.empty() && list.front().is_object();
  };
  if (holds_tables(was) && holds_tables(is)) {
    if (was.size() != is.size())
      differences.push_back(fmt::format("{} (had {} entries, has {})", path, was.size(), is.size()));
    for (std::size_t k = 0; k < std::min(was.size(), is.size()); ++k)
      compare(joined(path, name_of(is[k], k)), was[k], is[k], differences);
    return;
  }
  differences.push_back(fmt::format("{} (was {}, is {})", path, shown(was), shown(is)));
}

}  // namespace

std::vector<std::string> scene_differences(const Json& was, const Json& is) {
  std::vector<std::string> differences;
  compare("", was, is, differences);
  return differences;
}

}  // namespace ashlar
