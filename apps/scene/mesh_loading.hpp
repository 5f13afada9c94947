// A mesh file as a checked solid, or everything that is wrong with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/scene/diagnostics.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Defects of one kind that are listed of one mesh.
inline constexpr std::size_t listed_mesh_defects = 100;

/// @param name the file as the user named it. @return none if there were faults, which are added
[[nodiscard]] std::optional<Polyhedron> load_solid(const std::string& name, const std::filesystem::path& file,
                                                   Diagnostics& diagnostics);

}  // namespace ashlar
