#include "apps/scene/build/limit_choices.hpp"

#include <algorithm>

#include "apps/scene/model/block_names.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {
namespace {

bool name_any(const Scene& scene, const std::vector<std::string>& patterns, std::size_t block) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return pattern_names_block(scene, pattern, block); });
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return pattern_matches(pattern, name); });
}

}  // namespace

ReducedJoints::ReducedJoints(const Scene& scene) : rock_(scene.rock) {
  const std::vector<std::string>& patterns = scene.analysis.safety.of;
  for (std::size_t k = 0; k < scene.block.size(); ++k) block_.push_back(name_any(scene, patterns, k));
  for (const SceneCut& cut : scene.cut) cut_.push_back(matches_any(patterns, cut.name));
}

bool ReducedJoints::contains(std::size_t a, std::size_t b) const {
  if (block_[a] || block_[b]) return true;
  if (!rock_) return false;
  const std::vector<std::size_t> cuts = rock_->cuts_between(a, b);
  return std::any_of(cuts.begin(), cuts.end(), [&](std::size_t cut) { return cut_[cut]; });
}

std::vector<bool> multiplied_blocks(const Scene& scene) {
  std::vector<bool> multiplied;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    multiplied.push_back(name_any(scene, scene.analysis.capacity.of, k));
  return multiplied;
}

}  // namespace ashlar
