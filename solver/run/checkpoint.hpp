// Snapshots of a simulation (step/accept/snapshot.hpp) as bytes.
#pragma once

#include <string>
#include <string_view>

#include "solver/archived_geometry.hpp"
#include "solver/step/accept/snapshot.hpp"

namespace ashlar {

[[nodiscard]] std::string to_bytes(const SimulationSnapshot& snapshot);

/// @throws std::runtime_error if the bytes are not those of a snapshot.
[[nodiscard]] SimulationSnapshot snapshot_from_bytes(std::string_view bytes);

/// Writes a snapshot as part of a larger archive.
void write_snapshot(ByteWriter& writer, const SimulationSnapshot& snapshot);
/// @throws std::runtime_error if the next bytes are not those of a snapshot.
[[nodiscard]] SimulationSnapshot read_snapshot(ByteReader& reader);

}  // namespace ashlar
