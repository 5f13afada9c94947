#include "apps/blocks/block_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ashlar {
namespace {

/// OBJ names end at a blank.
std::string obj_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return letter <= ' '; }, '_');
  return name;
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
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    const int first = static_cast<int>(grid.points.size());
    grid.points.insert(grid.points.end(), mesh.points.begin(), mesh.points.end());
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
    const TriangleMesh& mesh = loaded.solids[k].mesh();
    const std::string name = obj_name(loaded.scene.block[k].name);
    fmt::format_to(out, "o {}\ng {}\n", name, name);
    for (const Vector3& point : mesh.points)
      fmt::format_to(out, "v {} {} {}\n", point.x(), point.y(), point.z());
    for (const auto& [a, b, c] : mesh.triangles)
      fmt::format_to(out, "f {} {} {}\n", first + static_cast<std::size_t>(a),
                     first + static_cast<std::size_t>(b), first + static_cast<std::size_t>(c));
    first += mesh.points.size();
  }
  return fmt::to_string(text);
}

}  // namespace ashlar
