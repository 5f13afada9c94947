// Seeds of targets whose format does not last, made by the program as it is.
#pragma once

#include <string>
#include <vector>

namespace ashlar::fuzz {

/// Stored states of small stacks in the middle of contact, with springs, a curved block, and multipliers. The
/// checkpoint target takes each.
[[nodiscard]] std::vector<std::string> stored_states();

}  // namespace ashlar::fuzz
