#include "solver/limit/key_groups.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"
#include "solver/limit/held_bodies.hpp"

namespace ashlar {
namespace {

/// Bodies that move by more than this share of the fastest belong to a mechanism.
constexpr double moving_share = 1e-2;

/// @param blocks sorted, whose forces count
Vector3 force_of(const RigidModel& model, const LimitMotion& motion, const std::vector<int>& blocks) {
  Vector3 force = Vector3::Zero();
  std::vector<bool> counted(model.bodies.size(), false);
  for (const LimitMotion::Block& block : motion.blocks) {
    const int body = model.body_of[at(block.block)];
    if (body < 0 || counted[at(body)] || !std::binary_search(blocks.begin(), blocks.end(), block.block))
      continue;
    counted[at(body)] = true;
    force += model.bodies[at(body)].mass * block.acceleration;
  }
  return force;
}

/// Blocks of the motion that are faster than a share of the fastest one.
std::vector<int> fast_blocks(const LimitMotion& motion) {
  double most = 0.0;
  for (const LimitMotion::Block& block : motion.blocks) most = std::max(most, block.acceleration.norm());
  std::vector<int> blocks;
  for (const LimitMotion::Block& block : motion.blocks)
    if (block.acceleration.norm() >= moving_share * most) blocks.push_back(block.block);
  return blocks;
}

}  // namespace

std::vector<KeyGroup> key_groups(const RigidModel& model, const std::vector<bool>& reduced,
                                 const KeyGroupSearch& search) {
  std::vector<KeyGroup> groups;
  std::vector<bool> free(model.bodies.size(), true);
  while (static_cast<int>(groups.size()) < search.most && search.may_continue()) {
    HeldModel part = with_held_bodies(model, free, reduced);
    if (part.model.bodies.empty() || part.model.bodies.front().blocks.empty()) break;
    LimitAnalysis analysis(std::move(part.model), std::move(part.reduced), search.threads);
    const LimitAnswer answer = analysis.strength_factor(search.factors, search.may_continue);
    // Where nothing moves below the associated limit, its motion is both.
    const LimitBracket& limit = answer.released.motion ? answer.released : answer.associated;
    const std::optional<LimitTrial>& trial = limit.motion;
    if (answer.interrupted || !trial || !limit.upper) break;
    KeyGroup group;
    group.lower = limit.lower;
    group.upper = *limit.upper;
    group.motion = analysis.motion_of(*trial);
    group.blocks = fast_blocks(group.motion);
    if (group.blocks.empty()) break;
    if (group.upper < search.wanted || !group.lower || *group.lower < search.wanted) {
      const LimitTrial wanted = analysis.released({search.wanted, 1.0});
      if (wanted.outcome == LimitOutcome::moves)
        group.needed = -force_of(analysis.model(), analysis.motion_of(wanted), group.blocks);
    }
    for (const int block : group.blocks)
      if (const int body = model.body_of[at(block)]; body >= 0) free[at(body)] = false;
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ashlar
