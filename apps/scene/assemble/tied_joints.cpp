#include "apps/scene/assemble/tied_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "solver/ground/tied_pairs.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

/// Calls visit(a, b) for each pair of blocks, a < b, that a joint matches until it returns false.
template <class Visit>
void for_each_pair(const JointTable& table, std::size_t joint, Visit visit) {
  if (table.is_of_cut(joint)) {
    for (const auto& [a, b] : table.pairs_parted_by(joint))
      if (!visit(a, b)) return;
    return;
  }
  for (const std::size_t first : table.matched(joint, 0)) {
    for (const std::size_t second : table.matched(joint, 1)) {
      if (first == second) continue;
      if (!visit(std::min(first, second), std::max(first, second))) return;
    }
  }
}

/// Pairs tied by a joint, sorted.
std::vector<std::pair<std::size_t, std::size_t>> tied_pairs(const Scene& scene, const JointTable& table,
                                                            const std::vector<BlockSummary>& blocks) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    if (!scene.joint[k].tied.value_or(false)) continue;
    for_each_pair(table, k, [&](std::size_t a, std::size_t b) {
      if (!(blocks[a].fixed() && blocks[b].fixed())) pairs.insert({a, b});
      return true;
    });
  }
  std::erase_if(pairs, [&](const auto& pair) { return !table.law_between(pair.first, pair.second).tied; });
  return {pairs.begin(), pairs.end()};
}

/// True if a joint ties two blocks over a common face by a bond that breaks.
bool bonds_any(const JointTable& table, std::size_t joint, const BlockSystem& system) {
  bool bonds = false;
  const std::vector<BlockModel>& blocks = system.blocks();
  // The first of several processes has the models of all blocks.
  const bool has_all = system.exchange().first();
  const auto is_known = [&](std::size_t block) { return has_all || system.here(static_cast<int>(block)); };
  for_each_pair(table, joint, [&](std::size_t a, std::size_t b) {
    bonds =
        table.law_between(a, b).tie && is_known(a) && is_known(b) && have_common_face(blocks[a], blocks[b]);
    return !bonds;
  });
  return bonds;
}

/// True if later [[joint]]s untie all pairs tied by a joint.
bool is_untied(const JointTable& table, std::size_t joint) {
  bool left_any = false;
  for_each_pair(table, joint, [&](std::size_t a, std::size_t b) {
    const SceneJointLaw law = table.law_between(a, b);
    left_any = law.tied || law.tie;
    return !left_any;
  });
  return table.matches_a_pair(joint) && !left_any;
}

/// True if a block tied by a joint is absent at present.
bool waits(const JointTable& table, std::size_t joint, const BlockSystem& system) {
  bool waits = false;
  for_each_pair(table, joint, [&](std::size_t a, std::size_t b) {
    waits = !system.present(static_cast<int>(a)) || !system.present(static_cast<int>(b));
    return !waits;
  });
  return waits;
}

}  // namespace

std::vector<TieRequest> ties_of(const Scene& scene, const JointTable& table,
                                const std::vector<BlockSummary>& blocks) {
  std::vector<TieRequest> ties;
  for (const auto& [a, b] : tied_pairs(scene, table, blocks))
    ties.push_back(
        automatic_tie(static_cast<int>(a), static_cast<int>(b), blocks[a].stiffness, blocks[b].stiffness));
  return ties;
}

void check_ties(const Scene& scene, const JointTable& table, const BlockSystem& system,
                Diagnostics& diagnostics) {
  std::vector<bool> ties(scene.joint.size(), false);
  for (const TiedBlocks& tie : system.ties()) {
    for (const std::size_t joint :
         table.joints_between(static_cast<std::size_t>(tie.a), static_cast<std::size_t>(tie.b)))
      ties[joint] = true;
  }
  for (std::size_t k = 0; k < scene.joint.size(); ++k)
    ties[k] = ties[k] || (scene.joint[k].tie && bonds_any(table, k, system));
  ties = any_of_run(system, ties);
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    const SceneJoint& joint = scene.joint[k];
    if (!(joint.tied.value_or(false) || joint.tie) || ties[k] || waits(table, k, system)) continue;
    if (is_untied(table, k)) {
      diagnostics.warning(scene.places.key(fmt::format("joint.{}.tied", k)),
                          "tied has no effect: a later [[joint]] of the same blocks unties them");
      continue;
    }
    diagnostics.error(
        scene.places.key(fmt::format("joint.{}.tied", k)),
        fmt::format("tied blocks without a common face ({}, {}), blocks are tied over faces that "
                    "lie in one plane and overlap",
                    joint.blocks[0], joint.blocks[1]));
  }
}

}  // namespace ashlar
