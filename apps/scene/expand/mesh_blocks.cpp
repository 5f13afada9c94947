#include "apps/scene/expand/mesh_blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "apps/scene/meshes/mesh_import.hpp"
#include "apps/scene/meshes/open_terrain.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "geometry/mesh/surface_repair.hpp"
#include "geometry/mesh/volume_mesh.hpp"

namespace ashlar {
namespace {

constexpr std::size_t listed_stones = 5;

/// Conversion of one file to blocks.
class Import {
 public:
  Import(const SceneMesh& mesh, std::filesystem::path file) : mesh_(mesh), file_(std::move(file)) {}

  /// @throws MeshFileError, std::invalid_argument of weld_corners
  std::vector<MeshGroup> stones() {
    std::vector<MeshGroup> stones = bodies();
    weld(stones);
    if (mesh_.split == SceneMesh::Split::components) stones = components_of(std::move(stones.front().mesh));
    if (mesh_.close_below)
      for (MeshGroup& stone : stones) close_terrain_below(stone.mesh, *mesh_.close_below / mesh_.scale);
    repair(stones);
    turn(stones);
    return stones;
  }

  /// Summary of the changes.
  [[nodiscard]] std::string note(std::size_t stones) const {
    std::string text = file_.string();
    if (mesh_.split != SceneMesh::Split::none)
      text += fmt::format(": {} stone{}", stones, stones == 1 ? "" : "s");
    if (mesh_.weld > 0.0)
      text += fmt::format(": {} corners welded to others within {:g} m, {} triangles that vanished left out",
                          welded_, mesh_.weld, vanished_);
    if (mesh_.close_below) text += fmt::format(": closed by walls down to z = {:g} m", *mesh_.close_below);
    if (mesh_.repair)
      text += fmt::format(
          ": repaired: {} holes filled with {} triangles, {} triangles left out, {} surfaces turned",
          repaired_.holes, repaired_.added, repaired_.removed, outward_);
    if (mesh_.flip != SceneMesh::Flip::never) {
      text += fmt::format(": {} surface{} turned", turned_.size(), turned_.size() == 1 ? "" : "s");
      if (!turned_.empty() && stones > 1) {
        const std::size_t shown = std::min(turned_.size(), listed_stones);
        text += fmt::format(" ({}{})",
                            fmt::join(turned_.begin(), turned_.begin() + static_cast<int>(shown), ", "),
                            shown < turned_.size() ? ", ..." : "");
      }
    }
    return text;
  }

 private:
  /// Parts of the file before any change.
  [[nodiscard]] std::vector<MeshGroup> bodies() const {
    const bool of_tetrahedra = mesh_.split == SceneMesh::Split::tetrahedra;
    if (!of_tetrahedra && mesh_.group.empty()) {
      if (mesh_.split == SceneMesh::Split::groups) return read_mesh_file_groups(file_);
      return {{"", read_mesh_file(file_)}};
    }
    VolumeMesh volume = read_volume_mesh(file_);
    if (!mesh_.group.empty()) volume = only_group(volume, mesh_.group);
    if (of_tetrahedra) return surfaces_of_tetrahedra(volume);
    if (mesh_.split == SceneMesh::Split::groups) return surfaces_of_groups(volume);
    return {{"", surface_of(volume)}};
  }

  void weld(std::vector<MeshGroup>& stones) {
    if (mesh_.weld == 0.0) return;
    for (MeshGroup& stone : stones) {
      const WeldCount count = weld_corners(stone.mesh, mesh_.weld / mesh_.scale);
      welded_ += count.corners;
      vanished_ += count.triangles;
    }
  }

  std::vector<MeshGroup> components_of(TriangleMesh mesh) const {
    // If parts touch, the assignment of triangles to parts depends on the orientation.
    const bool turned = mesh_.flip == SceneMesh::Flip::always ||
                        (mesh_.flip == SceneMesh::Flip::automatic && rounded_volume(mesh) < 0.0);
    if (turned) turn_inside_out(mesh);
    // For corners of adjacent faces that are welded, and in single precision or better in the file.
    constexpr double coincident = 1e-9;
    std::vector<MeshGroup> stones;
    for (TriangleMesh& component : closed_components(mesh, coincident)) {
      if (turned) turn_inside_out(component);
      stones.push_back({std::to_string(stones.size() + 1), std::move(component)});
    }
    return stones;
  }

  void repair(std::vector<MeshGroup>& stones) {
    if (!mesh_.repair) return;
    for (MeshGroup& stone : stones) {
      for (const Vector3& point : stone.mesh.points)
        if (!point.allFinite()) throw std::invalid_argument("a coordinate is not finite, numbers are needed");
      const SurfaceRepair done = repair_surface(stone.mesh);
      if (!done.complete)
        throw std::invalid_argument(fmt::format("a hole cannot be filled{}, a simpler one is needed",
                                                stone.name.empty() ? "" : " in " + stone.name));
      repaired_.holes += done.holes;
      repaired_.added += done.added;
      repaired_.removed += done.removed;
      outward_ += done.turned ? 1 : 0;
    }
  }

  void turn(std::vector<MeshGroup>& stones) {
    for (MeshGroup& stone : stones) {
      const bool needed = mesh_.flip == SceneMesh::Flip::always ||
                          (mesh_.flip == SceneMesh::Flip::automatic && rounded_volume(stone.mesh) < 0.0);
      if (!needed) continue;
      turn_inside_out(stone.mesh);
      turned_.push_back(stone.name);
    }
  }

  const SceneMesh& mesh_;
  std::filesystem::path file_;
  std::size_t welded_ = 0;
  std::size_t vanished_ = 0;
  SurfaceRepair repaired_;
  std::size_t outward_ = 0;
  std::vector<std::string> turned_;
};

SceneBlock block_of(const SceneBlock& block, MeshGroup stone, std::size_t number) {
  SceneBlock result = block;
  SceneMesh& mesh = std::get<SceneMesh>(result.shape);
  mesh.stone = std::make_shared<const TriangleMesh>(std::move(stone.mesh));
  if (mesh.split == SceneMesh::Split::none) return result;
  mesh.number = static_cast<int>(number);
  result.name = fmt::format("{}.{}", block.name, stone.name);
  return result;
}

}  // namespace

bool is_imported(const SceneBlock& block) {
  const SceneMesh* mesh = std::get_if<SceneMesh>(&block.shape);
  return mesh != nullptr && !mesh->stone &&
         (mesh->split != SceneMesh::Split::none || !mesh->group.empty() || mesh->weld > 0.0 || mesh->repair ||
          mesh->close_below || mesh->flip != SceneMesh::Flip::never);
}

std::vector<SceneBlock> stones_of(Scene& scene, const SceneBlock& block, const std::string& path,
                                  Diagnostics& diagnostics) {
  if (!std::holds_alternative<SceneMesh>(block.shape)) return {block};
  const SceneMesh& mesh = std::get<SceneMesh>(block.shape);
  const Place place = scene.places.value(path + ".mesh.file");
  const std::filesystem::path file = scene.file.parent_path() / mesh.file;
  const std::optional<std::string> warning = import_warning(file);
  if (warning && !mesh.stone) diagnostics.warning(place, *warning);
  if (!is_imported(block)) return {block};
  SceneBlock without_shape = block;
  without_shape.shape = {};
  Import import(mesh, file);
  try {
    std::vector<MeshGroup> stones = import.stones();
    scene.notes.push_back(import.note(stones.size()));
    std::vector<SceneBlock> blocks;
    blocks.reserve(stones.size());
    for (MeshGroup& stone : stones) blocks.push_back(block_of(block, std::move(stone), blocks.size() + 1));
    return blocks;
  } catch (const MeshFileError& error) {
    diagnostics.error(place, fmt::format("mesh file cannot be used ({}: {}), {} is needed",
                                         to_string(Place{file.string(), error.line(), error.column()}),
                                         error.what(), readable_mesh));
  } catch (const std::invalid_argument& error) {
    diagnostics.error(
        place, fmt::format("mesh cannot be {} ({})", mesh.close_below ? "closed below" : "welded or repaired",
                           error.what()));
  }
  return {without_shape};
}

}  // namespace ashlar
