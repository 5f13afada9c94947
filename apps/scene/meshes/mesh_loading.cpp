#include "apps/scene/meshes/mesh_loading.hpp"

#include <fmt/format.h>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

std::optional<Polyhedron> load_solid(const std::string& name, const std::filesystem::path& file,
                                     Diagnostics& diagnostics) {
  try {
    TriangleMesh mesh = read_mesh(file);
    try {
      // Copied only if all defects have to be listed.
      return Polyhedron(std::move(mesh));
    } catch (const MeshError&) {
      for (const MeshDefect& defect : Polyhedron::find_defects(read_mesh(file), listed_mesh_defects)) {
        diagnostics.error({name, 0, 0}, fmt::format("{}: {}, a mesh must bound a solid",
                                                    to_string(defect.kind), defect.element));
      }
    }
  } catch (const MeshFileError& error) {
    diagnostics.error({name, error.line(), error.column()}, error.what());
  }
  return std::nullopt;
}

}  // namespace ashlar
