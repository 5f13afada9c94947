#include "apps/scene/model/block_names.hpp"

#include <algorithm>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {

std::string name_before_cuts(const Scene& scene, std::size_t block) {
  if (!scene.rock || scene.rock->origin[block].piece < 0) return "";
  return scene.uncut[scene.rock->origin[block].uncut].name;
}

bool pattern_names_block(const Scene& scene, const std::string& pattern, std::size_t block) {
  if (pattern_matches(pattern, scene.block[block].name)) return true;
  if (!scene.rock) return false;
  if (pattern == name_before_cuts(scene, block)) return true;
  const std::vector<std::string>& others = scene.rock->other_names[block];
  return std::any_of(others.begin(), others.end(),
                     [&](const std::string& name) { return pattern_matches(pattern, name); });
}

std::string own_name(const Scene& scene, const std::string& name) {
  const auto is_own = [&](const SceneBlock& block) { return block.name == name; };
  if (!scene.rock || std::any_of(scene.block.begin(), scene.block.end(), is_own)) return name;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const std::vector<std::string>& others = scene.rock->other_names[k];
    if (std::find(others.begin(), others.end(), name) != others.end()) return scene.block[k].name;
  }
  return name;
}

}  // namespace ashlar
