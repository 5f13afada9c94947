#include "apps/scene/check/joint_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"

namespace ashlar {
namespace {

/// All joints of a scene, those of its stages last.
struct AllJoints {
  Scene scene;
  std::vector<std::string> paths;
};

AllJoints all_joints(const Scene& scene) {
  AllJoints all{scene, {}};
  for (std::size_t k = 0; k < scene.joint.size(); ++k) all.paths.push_back(fmt::format("joint.{}", k));
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    for (std::size_t k = 0; k < scene.stage[s].joint.size(); ++k) {
      all.scene.joint.push_back(scene.stage[s].joint[k]);
      all.paths.push_back(fmt::format("stage.{}.joint.{}", s, k));
    }
  }
  return all;
}

/// Different lists of at least two joints that match the same pair of blocks.
std::set<std::vector<std::size_t>> lists_of_joints(const Scene& scene) {
  const JointTable table(scene);
  // Two blocks that are matched by the same joints, or one, stand for all of them.
  std::vector<std::vector<bool>> matched(scene.block.size(), std::vector<bool>(2 * scene.joint.size()));
  for (std::size_t joint = 0; joint < scene.joint.size(); ++joint)
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::size_t block : table.matched(joint, side)) matched[block][2 * joint + side] = true;
  std::map<std::vector<bool>, std::vector<std::size_t>> kinds;
  for (std::size_t block = 0; block < matched.size(); ++block)
    if (auto& kind = kinds[matched[block]]; kind.size() < 2) kind.push_back(block);
  std::set<std::vector<std::size_t>> lists;
  const auto add = [&](std::size_t a, std::size_t b) {
    if (std::vector<std::size_t> list = table.joints_between(a, b); list.size() >= 2) lists.insert(list);
  };
  for (auto first = kinds.begin(); first != kinds.end(); ++first)
    for (auto second = first; second != kinds.end(); ++second)
      if (const auto [a, b] = std::pair(first->second.front(), second->second.back()); a != b) add(a, b);
  if (scene.rock)
    for (const auto& [pair, cuts] : scene.rock->common) add(pair.first, pair.second);
  return lists;
}

}  // namespace

std::vector<JointTablePath> tables_of_joints(const Scene& scene) {
  std::vector<JointTablePath> tables = {{{"contact"}, scene.contact.law}};
  const AllJoints all = all_joints(scene);
  for (std::size_t k = 0; k < all.paths.size(); ++k) {
    tables.push_back({{all.paths[k]}, scene.contact.law});
    override_law(tables.back().law, all.scene.joint[k]);
  }
  if (all.paths.size() < 2) return tables;
  for (const std::vector<std::size_t>& list : lists_of_joints(all.scene)) {
    JointTablePath table{{}, scene.contact.law};
    for (const std::size_t joint : list) {
      table.paths.insert(table.paths.begin(), all.paths[joint]);
      override_law(table.law, all.scene.joint[joint]);
      if (table.paths.size() >= 2) tables.push_back(table);
    }
  }
  return tables;
}

void JointFaults::report(const JointTablePath& table, std::initializer_list<const char*> keys,
                         const std::string& message, bool at_value) {
  for (const std::string& path : table.paths) {
    for (const char* key : keys) {
      const std::string place = fmt::format("{}.{}", path, key);
      if (!scene_.places.contains(place)) continue;
      if (reported_.insert(place + '\n' + message).second)
        diagnostics_.error(at_value ? scene_.places.value(place) : scene_.places.key(place), message);
      return;
    }
  }
}

}  // namespace ashlar
