#include "apps/scene/assemble/joint_selection.hpp"

#include <algorithm>

#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {

JointSelection::JointSelection(const Scene& scene, const std::vector<std::string>& patterns)
    : rock_(scene.rock) {
  for (std::size_t k = 0; k < scene.block.size(); ++k) block_.push_back(means_block(scene, patterns, k));
  for (const SceneCut& cut : scene.cut)
    cut_.push_back(std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
      return pattern_matches(pattern, cut.name);
    }));
}

bool JointSelection::contains(std::size_t a, std::size_t b) const {
  if (block_[a] || block_[b]) return true;
  if (!rock_) return false;
  const std::vector<std::size_t> cuts = rock_->cuts_between(a, b);
  return std::any_of(cuts.begin(), cuts.end(), [&](std::size_t cut) { return cut_[cut]; });
}

}  // namespace ashlar
