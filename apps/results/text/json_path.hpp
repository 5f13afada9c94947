// Values in JSON by paths of keys with dots between, which keys and names may have, too.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace ashlar {

/// The value at a path: "factor_of_safety.lower"; an entry of a list goes by one of its texts or, if
/// none is that, its number from 0: "thrust.support.1.least", "moving.block.acceleration.0".
/// @return null if there is none
[[nodiscard]] const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& place,
                                                     std::string_view path);

}  // namespace ashlar
