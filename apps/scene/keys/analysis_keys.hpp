// Parts of the keys of [analysis].
#pragma once

#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_analysis.hpp"

namespace ashlar::keys {

[[nodiscard]] Key<SceneAnalysis> pushover_of_analysis();
[[nodiscard]] Key<SceneAnalysis> spectrum_of_analysis();
/// A pushover needs a direction or a number of them.
bool check_push_direction(TomlTableReader& table, SceneAnalysis& analysis);

}  // namespace ashlar::keys
