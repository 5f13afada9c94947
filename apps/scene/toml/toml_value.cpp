#include "apps/scene/toml/toml_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/toml_faults.hpp"
#include "geometry/exact/coordinate_limit.hpp"

namespace ashlar {

// A formula with its value.
static std::string describe_number(const toml::node& node, double value) {
  return node.is_string() ? fmt::format("{} = {}", describe(node), value) : describe(node);
}

std::string whole_number_words(int low, int high) {
  return high == std::numeric_limits<int>::max() ? fmt::format("a whole number of at least {}", low)
                                                 : fmt::format("a whole number from {} to {}", low, high);
}

void TomlValue::wrong_type(std::string_view words, std::string_view hint) const {
  reading_.error(
      node_, fmt::format("{} has the wrong type ({}), {} is needed{}", key_, describe(node_), words, hint));
}

std::optional<double> TomlValue::finite_number(std::string_view words) const {
  if (!TomlReading::has_number(node_)) {
    const auto* text = node_.as_string();
    wrong_type(words, text == nullptr ? "" : number_hint(**text));
    return std::nullopt;
  }
  const std::optional<double> value = reading_.number(node_, key_);
  if (!value || std::isfinite(*value)) return value;
  reading_.error(node_, fmt::format("{} is not finite ({}), {} is needed", key_, describe(node_), words));
  return std::nullopt;
}

std::optional<double> TomlValue::number(const NumberRange& range) const {
  const std::optional<double> value = finite_number(range.words);
  if (!value || range.contains(*value)) return value;
  reading_.error(node_, fmt::format("{} is out of range ({}), {} is needed", key_,
                                    describe_number(node_, *value), range.words));
  return std::nullopt;
}

std::optional<int> TomlValue::whole_number(int low, int high, std::string_view other) const {
  const std::string words = whole_number_words(low, high).append(other);
  const bool formula = !node_.is_number() && TomlReading::has_number(node_);
  if (!node_.is_integer() && !formula) {
    wrong_type(words);
    return std::nullopt;
  }
  const std::optional<double> value = reading_.number(node_, key_);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) {
    reading_.error(node_, fmt::format("{} is no whole number ({}), {} is needed; round(...) makes one", key_,
                                      describe_number(node_, *value), words));
    return std::nullopt;
  }
  if (*value < low || *value > high) {
    reading_.error(node_, fmt::format("{} is out of range ({}), {} is needed", key_,
                                      describe_number(node_, *value), words));
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

std::optional<std::size_t> TomlValue::word(const std::vector<std::string>& words) const {
  const std::string all = fmt::format("\"{}\"", fmt::join(words, "\", \""));
  const auto* text = node_.as_string();
  if (!text) {
    wrong_type(fmt::format("one of {}", all));
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), **text);
  if (found != words.end()) return found - words.begin();
  reading_.error(node_, fmt::format("unknown {} ({}), {}one of {} is needed", key_, describe(node_),
                                    guess(**text, words, "\""), all));
  return std::nullopt;
}

std::optional<std::vector<double>> TomlValue::row(std::size_t width, std::string_view words) const {
  const toml::array* array = node_.as_array();
  if (!array) {
    wrong_type(words);
    return std::nullopt;
  }
  if (array->size() != width) {
    reading_.error(
        node_, fmt::format("{} has the wrong length ({} entries), {} is needed", key_, array->size(), words));
    return std::nullopt;
  }
  std::vector<double> row;
  for (const toml::node& entry : *array)
    if (const auto value = TomlValue(reading_, entry, key_).finite_number("a number")) row.push_back(*value);
  if (row.size() != width) return std::nullopt;
  return row;
}

bool TomlValue::holds_place(const Vector3& place) const {
  for (const double coordinate : place) {
    if (!is_too_far(coordinate)) continue;
    reading_.error(
        node_, fmt::format("{} has a coordinate that is too large ({:g} m), -1e150 to 1e150 is needed", key_,
                           coordinate));
    return false;
  }
  return true;
}

}  // namespace ashlar
