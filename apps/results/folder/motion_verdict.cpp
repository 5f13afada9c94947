#include "apps/results/folder/motion_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/results/folder/run_status.hpp"
#include "geometry/index.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

bool may_move(const Simulation& simulation, std::size_t block) {
  const BlockModel& model = simulation.blocks()[block];
  return !model.fixed() && !model.driven() && simulation.system().present(static_cast<int>(block));
}

/// Of the centroid since it was placed, m.
Vector3 way_of(const Simulation& simulation, std::size_t block) {
  const BlockModel& model = simulation.blocks()[block];
  const Eigen::MatrixX3d way = simulation.states()[block].position - model.initial_state().position;
  return way.transpose() * model.basis().values(model.basis().centroid());
}

Vector3 down_of(const Simulation& simulation) {
  const Vector3 gravity = simulation.system().settings().gravity_at(0.0);
  return gravity.norm() > 0.0 ? Vector3(gravity.normalized()) : Vector3(Vector3::Zero());
}

}  // namespace

void FallRecord::note(const Simulation& simulation) {
  const Vector3 down = down_of(simulation);
  if (down.isZero(0.0)) return;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    if (!may_move(simulation, k) || simulation.blocks()[k].incremental() != nullptr) continue;
    if (!(way_of(simulation, k).dot(down) > fallen_share * block_size(simulation.blocks()[k]))) continue;
    const int block = static_cast<int>(k);
    if (std::any_of(falls.begin(), falls.end(), [&](const BlockFall& fall) { return fall.block == block; }))
      continue;
    falls.push_back({block, simulation.time()});
  }
}

MotionVerdict verdict_of(const Simulation& simulation, const FallRecord& record) {
  MotionVerdict verdict;
  const Vector3 down = down_of(simulation);
  const double gravity = simulation.system().settings().largest_gravity();
  for (const BlockFall& fall : record.falls) {
    if (!may_move(simulation, at(fall.block))) continue;
    const Vector3 way = way_of(simulation, at(fall.block));
    verdict.fallen.push_back({fall.block, fall.time, way.dot(down), way.norm()});
  }
  verdict.displaced = static_cast<int>(displaced_blocks(simulation).size());
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    if (!may_move(simulation, k)) continue;
    const BlockModel& block = simulation.blocks()[k];
    const double speed = mean_motion(block, simulation.states()[k].velocity);
    if (!(speed > resting_share * std::sqrt(gravity * block_size(block)))) continue;
    ++verdict.moving;
    if (speed <= verdict.speed) continue;
    verdict.speed = speed;
    verdict.fastest = static_cast<int>(k);
  }
  return verdict;
}

std::string describe(const MotionVerdict& verdict, const Simulation& simulation) {
  constexpr std::size_t most_named = 5;
  std::size_t all = 0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) all += may_move(simulation, k) ? 1 : 0;
  const auto name = [&](int block) { return simulation.blocks()[at(block)].name(); };
  std::string text = verdict.at_rest()
                         ? "at rest"
                         : fmt::format("{} of {} blocks move, block {} fastest: {:.3g} m/s", verdict.moving,
                                       all, name(verdict.fastest), verdict.speed);
  const std::size_t fallen = verdict.fallen.size();
  if (fallen > 0)
    text += fmt::format("; {} of {} blocks {} fallen: ", fallen, all, fallen == 1 ? "has" : "have");
  for (std::size_t k = 0; k < std::min(fallen, most_named); ++k) {
    const MotionVerdict::Fallen& of = verdict.fallen[k];
    text +=
        fmt::format("{}{} at {:.4g} s, {:.3g} m down", k == 0 ? "" : ", ", name(of.block), of.time, of.drop);
  }
  if (fallen > most_named) text += fmt::format(" and {} more", fallen - most_named);
  const int others = verdict.displaced - static_cast<int>(fallen);
  if (others > 0)
    text += fmt::format("; {}{} {} more than a tenth of {} size from where {} placed", others,
                        fallen > 0    ? " others"
                        : others == 1 ? " block"
                                      : " blocks",
                        others == 1 ? "is" : "are", others == 1 ? "its" : "their",
                        others == 1 ? "it was" : "they were");
  return text;
}

}  // namespace ashlar
