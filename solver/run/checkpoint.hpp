// Snapshots of a simulation (step/snapshot.hpp) as bytes.
#pragma once

#include <string>
#include <string_view>

#include "solver/step/snapshot.hpp"

namespace ashlar {

[[nodiscard]] std::string to_bytes(const SimulationSnapshot& snapshot);

/// @throws std::runtime_error if the bytes are not those of a snapshot.
[[nodiscard]] SimulationSnapshot snapshot_from_bytes(std::string_view bytes);

}  // namespace ashlar
