// Units of the numbers in summary.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ashlar {

/// The units of all numbers of a summary that have one: {"deepest.value": "m"}, by paths of keys with dots between;
/// entries of lists share the path of their list. Numbers without a unit, and those of `scene`, `automatic` and `peaks`, which
/// bring their own, are not in it.
[[nodiscard]] nlohmann::ordered_json summary_units(const nlohmann::ordered_json& summary);

/// Paths of numbers for which no unit is declared: none of a summary of the program.
[[nodiscard]] std::vector<std::string> undeclared_numbers(const nlohmann::ordered_json& summary);

}  // namespace ashlar
