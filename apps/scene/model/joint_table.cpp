#include "apps/scene/model/joint_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "apps/scene/model/block_names.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {

JointTable::JointTable(const Scene& scene)
    : law_(scene.contact.law), joints_(scene.joint), rock_(scene.rock), listed_(scene.block.size()) {
  for (const SceneCut& cut : scene.cut) cut_names_.push_back(cut.name);
  std::map<std::string, std::vector<std::size_t>> by_name;
  for (std::size_t k = 0; k < scene.block.size(); ++k) by_name[scene.block[k].name].push_back(k);
  const auto matched_by = [&](const std::string& pattern, const SceneJoint& joint, std::size_t index) {
    // Patterns of joints with a region are kept apart: a name has no line break.
    const std::string key = joint.inside ? fmt::format("{}\n{}", pattern, index) : pattern;
    const auto [place, is_new] = blocks_of_.emplace(key, std::vector<std::size_t>{});
    if (!is_new) return &place->second;
    // A name without glob characters is that of one block, or of one that was cut.
    if (pattern.find_first_of("*?[\\") == std::string::npos) {
      auto found = by_name.find(pattern);
      if (found == by_name.end()) found = by_name.find(own_name(scene, pattern));
      if (found != by_name.end()) {
        place->second = found->second;
      } else {
        for (std::size_t k = 0; k < scene.block.size(); ++k)
          if (name_before_cuts(scene, k) == pattern) place->second.push_back(k);
      }
    } else {
      for (std::size_t k = 0; k < scene.block.size(); ++k)
        if (pattern_names_block(scene, pattern, k)) place->second.push_back(k);
    }
    if (joint.inside)
      std::erase_if(place->second, [&](std::size_t k) {
        return !std::binary_search(joint.inside->blocks.begin(), joint.inside->blocks.end(), k);
      });
    return &place->second;
  };
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    for (const std::string& pattern : scene.joint[k].blocks)
      matched_.push_back(matched_by(pattern, scene.joint[k], k));
    const std::size_t rarer = matched(k, 0).size() <= matched(k, 1).size() ? 0 : 1;
    for (const std::size_t block : matched(k, rarer)) listed_[block].push_back(k);
  }
}

bool JointTable::matches(std::size_t joint, std::size_t side, std::size_t block) const {
  return std::binary_search(matched(joint, side).begin(), matched(joint, side).end(), block);
}

std::vector<std::vector<std::size_t>> JointTable::globs_of_blocks() const {
  std::vector<std::vector<std::size_t>> globs(listed_.size());
  for (std::size_t glob = 0; glob < matched_.size(); ++glob) {
    if (matched_[glob]->size() == globs.size()) continue;
    for (const std::size_t block : *matched_[glob]) globs[block].push_back(glob);
  }
  return globs;
}

std::vector<std::size_t> JointTable::joints_between(std::size_t a, std::size_t b) const {
  std::vector<std::size_t> candidates;
  std::set_union(listed_[a].begin(), listed_[a].end(), listed_[b].begin(), listed_[b].end(),
                 std::back_inserter(candidates));
  std::erase_if(candidates, [&](std::size_t joint) {
    return !(matches(joint, 0, a) && matches(joint, 1, b)) && !(matches(joint, 0, b) && matches(joint, 1, a));
  });
  if (std::any_of(candidates.begin(), candidates.end(),
                  [&](std::size_t joint) { return is_of_cut(joint); })) {
    std::set<std::string> cuts;
    if (rock_)
      for (const std::size_t cut : rock_->cuts_between(a, b)) cuts.insert(cut_names_[cut]);
    std::erase_if(candidates,
                  [&](std::size_t joint) { return is_of_cut(joint) && !cuts.contains(joints_[joint].cut); });
  }
  return candidates;
}

SceneJointLaw JointTable::law_between(std::size_t a, std::size_t b) const {
  SceneJointLaw law = law_;
  for (const std::size_t joint : joints_between(a, b)) override_law(law, joints_[joint]);
  return law;
}

std::vector<std::pair<std::size_t, std::size_t>> JointTable::pairs_parted_by(std::size_t joint) const {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (!rock_) return pairs;
  for (const auto& [pair, cuts] : rock_->common) {
    const bool parted = std::any_of(cuts.begin(), cuts.end(),
                                    [&](std::size_t cut) { return cut_names_[cut] == joints_[joint].cut; });
    const auto& [a, b] = pair;
    if (parted &&
        ((matches(joint, 0, a) && matches(joint, 1, b)) || (matches(joint, 0, b) && matches(joint, 1, a))))
      pairs.push_back(pair);
  }
  return pairs;
}

bool JointTable::matches_a_pair(std::size_t joint) const {
  const std::vector<std::size_t>&first = matched(joint, 0), &second = matched(joint, 1);
  if (first.empty() || second.empty()) return false;
  return first.size() > 1 || second.size() > 1 || first.front() != second.front();
}

}  // namespace ashlar
