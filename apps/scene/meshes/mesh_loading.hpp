// Loads a mesh file as a checked solid, or reports all of its defects.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/scene/model/diagnostics.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Largest number of defects of one kind listed for one mesh.
inline constexpr std::size_t listed_mesh_defects = 100;

/// @param name the file as the user named it. @return empty if there were faults, which are reported
[[nodiscard]] std::optional<Polyhedron> load_solid(const std::string& name, const std::filesystem::path& file,
                                                   Diagnostics& diagnostics);

}  // namespace ashlar
