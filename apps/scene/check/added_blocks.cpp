#include "apps/scene/check/added_blocks.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "apps/scene/check/initial_overlap.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

/// Some blocks with their present points.
struct PlacedBlocks {
  std::vector<int> blocks;
  std::vector<std::vector<Vector3>> points;
  std::vector<Box> boxes;

  void add(const Simulation& simulation, int block) {
    const BlockModel& model = simulation.blocks()[at(block)];
    const Eigen::MatrixX3d places =
        model.basis().values(model.solid().mesh().points) * simulation.states()[at(block)].position;
    std::vector<Vector3>& placed = points.emplace_back();
    for (Eigen::Index k = 0; k < places.rows(); ++k) placed.emplace_back(places.row(k));
    boxes.push_back(box_of(placed));
    blocks.push_back(block);
  }
  [[nodiscard]] Polyhedron solid(const Simulation& simulation, int index) const {
    return simulation.blocks()[at(blocks[at(index)])].solid().with_points(points[at(index)]);
  }
};

struct AddedOverlap {
  double beyond = 0.0;  ///< m, of what is allowed
  PairKey blocks = {-1, -1};
  std::string fault;  ///< empty: all fit
};

/// The overlap farthest beyond what is allowed, of pairs that this process makes.
AddedOverlap overlap_here(const Simulation& simulation, const std::vector<bool>& was_absent) {
  const BlockSystem& system = simulation.system();
  PlacedBlocks added, others;
  for (int k = 0; k < system.count(); ++k)
    if (system.here(k) && was_absent[at(k)]) added.add(simulation, k);
  AddedOverlap most;
  if (added.blocks.empty()) return most;
  for (int k = 0; k < system.count(); ++k)
    if (system.here(k) && !was_absent[at(k)]) others.add(simulation, k);
  const DepthSettings& depth = system.settings().depth;
  for (const auto& [i, j] : meeting_boxes(added.boxes, others.boxes)) {
    const int a = added.blocks[at(i)], b = others.blocks[at(j)];
    const PairKey pair = {std::min(a, b), std::max(a, b)};
    if (simulation.blocks()[at(a)].fixed() && simulation.blocks()[at(b)].fixed()) continue;
    if (!system.owns_pair(pair[0], pair[1])) continue;
    const double placed = history_of(simulation.histories(), pair).overlap;
    const double allowed =
        placed + (depth.allowed_depth > 0.0 ? depth.allowed_depth
                                            : depth.unknown_depth_share * system.smaller_size({a, b}));
    const OverlapDepth overlap = overlap_depth(added.solid(simulation, i), others.solid(simulation, j));
    if (overlap.depth - allowed <= most.beyond) continue;
    most = {overlap.depth - allowed, pair,
            fmt::format("the stage adds block {} where block {} is now: they overlap by {}{:.3g} m, "
                        "allowed is {:.3g} m",
                        simulation.blocks()[at(a)].name(), simulation.blocks()[at(b)].name(),
                        overlap.exact ? "" : "at least ", overlap.depth, allowed)};
  }
  return most;
}

}  // namespace

std::optional<std::string> overlap_of_added(const Simulation& simulation,
                                            const std::vector<bool>& was_absent) {
  AddedOverlap most;
  for (AddedOverlap& other : values_of_run(simulation.system(), overlap_here(simulation, was_absent)))
    if (most.fault.empty() || other.beyond > most.beyond ||
        (other.beyond == most.beyond && other.blocks < most.blocks))
      most = std::move(other);
  if (most.fault.empty()) return std::nullopt;
  return std::move(most.fault);
}

}  // namespace ashlar
