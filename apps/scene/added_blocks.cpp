#include "apps/scene/added_blocks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/scene/initial_overlap.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Blocks in their places, with what pairs of them are made of.
struct PlacedSolids {
  std::vector<int> blocks;
  std::vector<Polyhedron> solids;
  std::vector<Box> boxes;

  void add(const Simulation& simulation, int block) {
    const BlockModel& model = simulation.blocks()[at(block)];
    const BlockState& state = simulation.states()[at(block)];
    std::vector<Vector3> points;
    for (const Vector3& point : model.solid().mesh().points)
      points.push_back(model.motion_of(state, point).place);
    boxes.push_back(box_of(points));
    solids.push_back(model.solid().with_points(std::move(points)));
    blocks.push_back(block);
  }
};

}  // namespace

std::optional<std::string> overlap_of_added(const Simulation& simulation,
                                            const std::vector<bool>& was_absent) {
  PlacedSolids added, others;
  for (int k = 0; k < simulation.system().count(); ++k)
    if (simulation.system().present(k)) (was_absent[at(k)] ? added : others).add(simulation, k);
  std::optional<std::string> fault;
  double most = 0.0;
  for (const auto& [i, j] : meeting_boxes(added.boxes, others.boxes)) {
    const BlockModel& a = simulation.blocks()[at(added.blocks[at(i)])];
    const BlockModel& b = simulation.blocks()[at(others.blocks[at(j)])];
    if (a.fixed() && b.fixed()) continue;
    const Polyhedron &solid_a = added.solids[at(i)], &solid_b = others.solids[at(j)];
    const double allowed = allowed_share_of_added * std::cbrt(std::min(solid_a.volume(), solid_b.volume()));
    const OverlapDepth overlap = overlap_depth(solid_a, solid_b);
    if (overlap.depth - allowed <= most) continue;
    most = overlap.depth - allowed;
    fault = fmt::format(
        "the stage adds block {} where block {} is now: they overlap by {}{:.3g} m, allowed "
        "is {:.3g} m",
        a.name(), b.name(), overlap.exact ? "" : "at least ", overlap.depth, allowed);
  }
  return fault;
}

}  // namespace ashlar
