#include "apps/results/folder/motion_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "apps/results/folder/run_status.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// True for a block of this rank that may move.
bool may_move(const Simulation& simulation, std::size_t block) {
  const int index = static_cast<int>(block);
  if (!simulation.system().present(index) || !simulation.system().owns(index)) return false;
  const BlockModel& model = simulation.blocks()[block];
  return !model.fixed() && !model.driven();
}

/// Of the centroid since it was placed, m.
Vector3 displacement_of(const Simulation& simulation, std::size_t block) {
  const BlockModel& model = simulation.blocks()[block];
  const Eigen::MatrixX3d displacement = simulation.states()[block].position - model.initial_state().position;
  return displacement.transpose() * model.basis().values(model.basis().centroid());
}

Vector3 down_of(const Simulation& simulation) {
  const Vector3 gravity = simulation.system().settings().gravity_at(0.0);
  return gravity.norm() > 0.0 ? Vector3(gravity.normalized()) : Vector3(Vector3::Zero());
}

/// Of the centroid, m.
Vector3 centroid_place(const Simulation& simulation, std::size_t block) {
  const PolynomialBasis& basis = simulation.blocks()[block].basis();
  return simulation.states()[block].position.transpose() * basis.values(basis.centroid());
}

/// m along `down`, of the lowest corner of blocks that are held, as placed; infinite: there are none.
double lowest_of_held(const Simulation& simulation, const Vector3& down) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double lowest = -infinite;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k)
    if (simulation.system().present(static_cast<int>(k)) &&
        (simulation.blocks()[k].fixed() || simulation.blocks()[k].supported()))
      for (const Vector3& corner : simulation.blocks()[k].solid().mesh().points)
        lowest = std::max(lowest, corner.dot(down));
  return lowest == -infinite ? infinite : lowest;
}

}  // namespace

void FallRecord::note(const Simulation& simulation) {
  const Vector3 down = down_of(simulation);
  if (down.isZero(0.0)) return;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    if (!may_move(simulation, k) || simulation.blocks()[k].incremental() != nullptr) continue;
    if (!(displacement_of(simulation, k).dot(down) > fallen_share * simulation.blocks()[k].size())) continue;
    const int block = static_cast<int>(k);
    if (std::any_of(falls.begin(), falls.end(), [&](const BlockFall& fall) { return fall.block == block; }))
      continue;
    falls.push_back({block, simulation.time()});
  }
}

FallRecord merged(const std::vector<FallRecord>& of_ranks) {
  std::map<int, double> first;
  for (const FallRecord& record : of_ranks)
    for (const BlockFall& fall : record.falls) {
      double& time = first.try_emplace(fall.block, fall.time).first->second;
      time = std::min(time, fall.time);
    }
  FallRecord all;
  for (const auto& [block, time] : first) all.falls.push_back({block, time});
  std::stable_sort(all.falls.begin(), all.falls.end(),
                   [](const BlockFall& a, const BlockFall& b) { return a.time < b.time; });
  return all;
}

MotionVerdict verdict_of(const Simulation& simulation, const FallRecord& record) {
  MotionVerdict verdict;
  const Vector3 down = down_of(simulation);
  const double gravity = simulation.system().settings().largest_gravity();
  const double lowest = lowest_of_held(simulation, down);
  for (const BlockFall& fall : record.falls) {
    if (!may_move(simulation, at(fall.block))) continue;
    const Vector3 displacement = displacement_of(simulation, at(fall.block));
    const double drop = displacement.dot(down);
    verdict.fallen.push_back({fall.block, fall.time, drop, displacement.norm(),
                              (displacement - drop * down).norm(),
                              centroid_place(simulation, at(fall.block)).dot(down) > lowest});
  }
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    if (!may_move(simulation, k)) continue;
    ++verdict.all;
    const BlockModel& block = simulation.blocks()[k];
    const BlockState& state = simulation.states()[k];
    const double size = block.size();
    if (mean_motion(block, state.position - block.initial_state().position) > displaced_share * size)
      ++verdict.displaced;
    const double speed = mean_motion(block, state.velocity);
    if (!(speed > resting_share * std::sqrt(gravity * size))) continue;
    ++verdict.moving;
    if (speed <= verdict.speed) continue;
    verdict.speed = speed;
    verdict.fastest = static_cast<int>(k);
  }
  return verdict;
}

MotionVerdict merged(const std::vector<MotionVerdict>& of_ranks) {
  MotionVerdict all;
  for (const MotionVerdict& part : of_ranks) {
    all.fallen.insert(all.fallen.end(), part.fallen.begin(), part.fallen.end());
    all.all += part.all;
    all.displaced += part.displaced;
    all.moving += part.moving;
    if (part.speed <= all.speed) continue;
    all.speed = part.speed;
    all.fastest = part.fastest;
  }
  std::sort(all.fallen.begin(), all.fallen.end(), [](const auto& a, const auto& b) {
    return std::pair(a.time, a.block) < std::pair(b.time, b.block);
  });
  return all;
}

std::string describe(const MotionVerdict& verdict, const Simulation& simulation) {
  constexpr std::size_t most_named = 5;
  const auto name = [&](int block) { return simulation.blocks()[at(block)].name(); };
  std::string text = verdict.at_rest()
                         ? "at rest"
                         : fmt::format("{} of {} blocks move, block {} fastest: {:.3g} m/s", verdict.moving,
                                       verdict.all, name(verdict.fastest), verdict.speed);
  const std::size_t fallen = verdict.fallen.size();
  if (fallen > 0)
    text += fmt::format("; {} of {} blocks {} fallen: ", fallen, verdict.all, fallen == 1 ? "has" : "have");
  for (std::size_t k = 0; k < std::min(fallen, most_named); ++k) {
    const MotionVerdict::Fallen& of = verdict.fallen[k];
    text +=
        fmt::format("{}{} at {:.4g} s, {:.3g} m down", k == 0 ? "" : ", ", name(of.block), of.time, of.drop);
  }
  if (fallen > most_named) text += fmt::format(" and {} more", fallen - most_named);
  const auto left = std::count_if(verdict.fallen.begin(), verdict.fallen.end(),
                                  [](const MotionVerdict::Fallen& of) { return of.left; });
  if (left > 0) text += fmt::format("; {} below all blocks that are held", left);
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
