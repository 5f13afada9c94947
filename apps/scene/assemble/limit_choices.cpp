#include "apps/scene/assemble/limit_choices.hpp"

#include <algorithm>

#include "apps/scene/model/block_names.hpp"

namespace ashlar {
namespace {

bool name_any(const Scene& scene, const std::vector<std::string>& patterns, std::size_t block) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return pattern_names_block(scene, pattern, block); });
}

}  // namespace

std::vector<bool> multiplied_blocks(const Scene& scene) {
  std::vector<bool> multiplied;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    multiplied.push_back(name_any(scene, scene.analysis.capacity.of, k));
  return multiplied;
}

std::vector<bool> pushed_by_loads(const Scene& scene) {
  std::vector<bool> pushed;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    pushed.push_back(name_any(scene, scene.analysis.pushover.blocks, k));
  return pushed;
}

}  // namespace ashlar
