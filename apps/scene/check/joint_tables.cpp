#include "apps/scene/check/joint_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"

namespace ashlar {
namespace {

/// Paths of all joints, those of stages last.
std::vector<std::string> paths_of_joints(const Scene& scene) {
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < scene.joint.size(); ++k) paths.push_back(fmt::format("joint.{}", k));
  for (std::size_t s = 0; s < scene.stage.size(); ++s)
    for (std::size_t k = 0; k < scene.stage[s].joint.size(); ++k)
      paths.push_back(fmt::format("stage.{}.joint.{}", s, k));
  return paths;
}

/// The scene with all joints from its start.
Scene with_all_joints(Scene scene) {
  for (const SceneStage& stage : scene.stage)
    scene.joint.insert(scene.joint.end(), stage.joint.begin(), stage.joint.end());
  return scene;
}

/// Different lists of at least two joints that match the same pair of blocks.
std::set<std::vector<std::size_t>> lists_of_joints(const Scene& scene) {
  const JointTable table(scene);
  // Two blocks that are matched by the same joints, or one, stand for all of them.
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> kinds;
  const std::vector<std::vector<std::size_t>> globs = table.globs_of_blocks();
  for (std::size_t block = 0; block < globs.size(); ++block)
    if (auto& kind = kinds[globs[block]]; kind.size() < 2) kind.push_back(block);
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

std::optional<std::string> first_given(const Scene& scene, const std::string& key) {
  const auto given = [&](const std::string& path) { return scene.places.contains(path + "." + key); };
  if (given("contact")) return "contact." + key;
  for (const std::string& path : paths_of_joints(scene))
    if (given(path)) return path + "." + key;
  return std::nullopt;
}

std::vector<JointTablePath> tables_of_joints(const Scene& scene) {
  std::vector<JointTablePath> tables = {{{"contact"}, scene.contact.law}};
  const Scene all = with_all_joints(scene);
  const std::vector<std::string> paths = paths_of_joints(scene);
  for (std::size_t k = 0; k < paths.size(); ++k) {
    tables.push_back({{paths[k]}, scene.contact.law});
    override_law(tables.back().law, all.joint[k]);
  }
  if (paths.size() < 2) return tables;
  for (const std::vector<std::size_t>& list : lists_of_joints(all)) {
    JointTablePath table{{}, scene.contact.law};
    for (const std::size_t joint : list) {
      table.paths.insert(table.paths.begin(), paths[joint]);
      override_law(table.law, all.joint[joint]);
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
