#include "apps/results/tables/original_blocks.hpp"

#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/index.hpp"

namespace ashlar {

std::vector<int> original_blocks(const Scene& scene, const std::vector<BlockModel>& blocks) {
  const std::string mark = ".crack";
  std::map<std::string, int> by_name;
  for (std::size_t k = 0; k < scene.block.size(); ++k) by_name[scene.block[k].name] = static_cast<int>(k);
  const auto original = [&](const std::string& name) {
    for (std::size_t end = name.find(mark); end != std::string::npos; end = name.find(mark, end + 1))
      if (const auto found = by_name.find(name.substr(0, end)); found != by_name.end()) return found->second;
    throw std::logic_error("block \"" + name + "\" is no part of a block of the scene");
  };
  std::vector<int> originals;
  originals.reserve(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k)
    originals.push_back(k < scene.block.size() ? static_cast<int>(k) : original(blocks[k].name()));
  return originals;
}

int part_at(const std::vector<BlockModel>& blocks, const std::vector<int>& parts, int original,
            const Vector3& point) {
  int nearest = original;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (parts[k] != original) continue;
    const ClosestPoint closest = ClosestPointFinder(blocks[k].solid()).find_any(point);
    const double distance = closest.place == PointPlace::inside ? 0.0 : closest.squared_distance;
    if (distance < least) least = distance, nearest = static_cast<int>(k);
  }
  return nearest;
}

}  // namespace ashlar
