// JSON schemas of values of a scene (draft 2020-12). Any number may be the text of a formula, "= 2*h".
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/scene/toml/number_ranges.hpp"

namespace ashlar::keys {

/// A number in a range, or a formula for it. @param type "number" or "integer"
[[nodiscard]] nlohmann::ordered_json schema_of_number(const NumberRange& range, const char* type);
/// @param least number of items, 0: any
[[nodiscard]] nlohmann::ordered_json schema_of_array(nlohmann::ordered_json items, std::size_t least);
/// An array of so many numbers.
[[nodiscard]] nlohmann::ordered_json schema_of_row(std::size_t width);
[[nodiscard]] nlohmann::ordered_json schema_of_text();
/// { file, time, values, scale, baseline, resample }
[[nodiscard]] nlohmann::ordered_json schema_of_record();
/// One of several forms.
[[nodiscard]] nlohmann::ordered_json schema_of_any(std::vector<nlohmann::ordered_json> forms);

}  // namespace ashlar::keys
