// Names of the keys that [contact] and [[joint]] have in common: those of a joint's law.
#pragma once

#include <string>
#include <vector>

namespace ashlar::keys {

[[nodiscard]] std::vector<std::string> joint_law_keys();

}  // namespace ashlar::keys
