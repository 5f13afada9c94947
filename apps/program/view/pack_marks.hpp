// Bolts, loads and supports of a frame in the format of ViewFrames::read.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/program/view/packed_numbers.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// Appends a frame of bolts.pvd; sets bolts of the head. @throws std::runtime_error if an array is missing
void pack_bolts(PackedNumbers& numbers, const UnstructuredGrid& grid, nlohmann::ordered_json& head);

/// Appends a frame of loads.pvd; sets loads, supports and support_corners of the head.
/// @throws std::runtime_error if an array is missing
void pack_loads_and_supports(PackedNumbers& numbers, const UnstructuredGrid& grid,
                             nlohmann::ordered_json& head);

}  // namespace ashlar
