#include "apps/program/blocks/block_files.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Names in OBJ and STL files end at a blank.
std::string word_of(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return letter <= ' '; }, '_');
  return name;
}

/// True for a block that is not there in the stage of the scene.
bool is_absent(const LoadedScene& loaded, std::size_t block) {
  return !loaded.scene.absent.empty() && loaded.scene.absent[block];
}

}  // namespace

UnstructuredGrid block_grid(const BlockReport& report, const std::vector<RemovableBlock>& removable) {
  const LoadedScene& loaded = report.loaded();
  UnstructuredGrid grid;
  for (const SceneBlock& block : loaded.scene.block) grid.block_names.push_back(block.name);
  std::vector<std::int32_t> block, mode;
  std::vector<double> volume, factor;
  std::vector<const RemovableBlock*> looked_at(loaded.solids.size(), nullptr);
  for (const RemovableBlock& of : removable) looked_at[of.block] = &of;
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (!report.is_there(k)) continue;
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    const int first = static_cast<int>(grid.points.size());
    for (const Vector3& point : mesh.points) grid.points.emplace_back(loaded.scene.origin + point);
    for (const auto& [a, b, c] : mesh.triangles) {
      grid.add_cell(VtkCellType::triangle, std::array{first + a, first + b, first + c});
      block.push_back(static_cast<std::int32_t>(k));
      volume.push_back(report.blocks()[k].volume);
      mode.push_back(looked_at[k] == nullptr ? -1 : static_cast<std::int32_t>(looked_at[k]->key.mode));
      const double safety = looked_at[k] == nullptr ? -1.0 : looked_at[k]->factor_of_safety;
      factor.push_back(std::isfinite(safety) ? safety : std::numeric_limits<double>::max());
    }
  }
  grid.cell_data = {{"block", 1, {}, std::move(block)}, {"volume", 1, {}, std::move(volume)}};
  if (!removable.empty()) {
    grid.cell_data.push_back({"mode", 1, {}, std::move(mode)});
    grid.cell_data.push_back({"factor_of_safety", 1, {}, std::move(factor)});
  }
  return grid;
}

std::string block_obj(const LoadedScene& loaded) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  std::size_t first = 1;
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (is_absent(loaded, k)) continue;
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    const std::string name = word_of(loaded.scene.block[k].name);
    fmt::format_to(out, "o {}\ng {}\n", name, name);
    for (const Vector3& of_model : mesh.points) {
      const Vector3 point = loaded.scene.origin + of_model;
      fmt::format_to(out, "v {} {} {}\n", point.x(), point.y(), point.z());
    }
    for (const auto& [a, b, c] : mesh.triangles)
      fmt::format_to(out, "f {} {} {}\n", first + static_cast<std::size_t>(a),
                     first + static_cast<std::size_t>(b), first + static_cast<std::size_t>(c));
    first += mesh.points.size();
  }
  return fmt::to_string(text);
}

std::string block_stl(const LoadedScene& loaded) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (is_absent(loaded, k)) continue;
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    const std::string name = word_of(loaded.scene.block[k].name);
    fmt::format_to(out, "solid {}\n", name);
    for (const auto& triangle : mesh.triangles) {
      const auto corner = [&](std::size_t i) -> const Vector3& { return mesh.points[at(triangle[i])]; };
      const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
      fmt::format_to(out, "facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
      for (const std::size_t i : {0U, 1U, 2U}) {
        const Vector3 point = loaded.scene.origin + corner(i);
        fmt::format_to(out, "vertex {} {} {}\n", point.x(), point.y(), point.z());
      }
      fmt::format_to(out, "endloop\nendfacet\n");
    }
    fmt::format_to(out, "endsolid {}\n", name);
  }
  return fmt::to_string(text);
}

std::string block_msh(const LoadedScene& loaded) {
  fmt::memory_buffer names, nodes, elements;
  std::size_t node = 0, element = 0;
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (is_absent(loaded, k)) continue;
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    std::string name = loaded.scene.block[k].name;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char letter) { return letter < ' ' || letter == '"'; }, '_');
    fmt::format_to(std::back_inserter(names), "2 {} \"{}\"\n", k + 1, name);
    const std::size_t first = node + 1;
    for (const Vector3& of_model : mesh.points) {
      const Vector3 point = loaded.scene.origin + of_model;
      fmt::format_to(std::back_inserter(nodes), "{} {} {} {}\n", ++node, point.x(), point.y(), point.z());
    }
    for (const auto& triangle : mesh.triangles)
      fmt::format_to(std::back_inserter(elements), "{} 2 2 {} {} {} {} {}\n", ++element, k + 1, k + 1,
                     first + at(triangle[0]), first + at(triangle[1]), first + at(triangle[2]));
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 "
      "8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n"
      "$Elements\n{}\n{}$EndElements\n",
      loaded.solids.size(), fmt::to_string(names), node, fmt::to_string(nodes), element,
      fmt::to_string(elements));
}

}  // namespace ashlar
