#include "apps/mesh_loading.hpp"

#include <fmt/format.h>

#include "geometry/mesh_io.hpp"

namespace ashlar {

std::optional<Polyhedron> load_solid(const std::string& name, const std::filesystem::path& file,
                                     Diagnostics& diagnostics) {
  try {
    const TriangleMesh mesh = read_mesh(file);
    const auto defects = Polyhedron::find_defects(mesh, listed_solid_defects);
    if (defects.empty()) return Polyhedron(mesh);
    for (const MeshDefect& defect : defects) {
      diagnostics.error({name, 0, 0}, fmt::format("{}: {}, a mesh must bound a solid", to_string(defect.kind),
                                                  defect.element));
    }
  } catch (const MeshFileError& error) {
    diagnostics.error({name, error.line(), error.column()}, error.what());
  }
  return std::nullopt;
}

}  // namespace ashlar
