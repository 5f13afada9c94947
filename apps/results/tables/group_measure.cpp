#include "apps/results/tables/group_measure.hpp"

#include <algorithm>

#include "apps/results/tables/original_blocks.hpp"
#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/level_blocks.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "mechanics/contact/common_faces.hpp"

namespace ashlar {
namespace {

/// Mean displacement of the blocks of a level that are present, m; nan if there is none.
Vector3 mean_displacement(const Simulation& simulation, const std::vector<DriftLevels::Place>& places) {
  Vector3 sum = Vector3::Zero();
  double weight = 0.0;
  for (const auto& [block, point, share] : places) {
    if (!simulation.system().present(block)) continue;
    const BlockModel& model = simulation.blocks()[at(block)];
    sum += share * model.motion_of(simulation.states()[at(block)], point).displacement;
    weight += share;
  }
  return weight > 0.0 ? Vector3(sum / weight) : Vector3(Vector3::Constant(not_measured));
}

/// The joints of a scene's [[measure]].
class Selection {
 public:
  Selection(const Scene& scene, const SceneCrack& crack)
      : scene_(scene), crack_(crack), joints_(scene, crack.joints) {}

  /// @param a,b blocks of the scene; the same: a crack in it
  [[nodiscard]] bool contains(std::size_t a, std::size_t b) const {
    if (a == b) return crack_.to.empty() && means_block(scene_, crack_.joints, a);
    if (!joints_.contains(a, b)) return false;
    if (crack_.to.empty()) return true;
    // A block named in both lists is on one side only.
    return (means_block(scene_, crack_.to, a) && joined_to(b, a)) ||
           (means_block(scene_, crack_.to, b) && joined_to(a, b));
  }

 private:
  /// True if the joint is named by its first side, or by its cut.
  [[nodiscard]] bool joined_to(std::size_t one, std::size_t other) const {
    return means_block(scene_, crack_.joints, one) || !means_block(scene_, crack_.joints, other);
  }

  const Scene& scene_;
  const SceneCrack& crack_;
  JointSelection joints_;
};

/// Gap (negative: depth) and slip at a corner, m.
struct Parting {
  double gap;
  double slip;
};

Parting parting_at(const Simulation& simulation, const JointPolygons::Polygon& polygon,
                   const Vector3& corner) {
  const auto model = [&](std::size_t side) -> const BlockModel& {
    return simulation.blocks()[at(polygon.blocks.at(side))];
  };
  const auto state = [&](std::size_t side) -> const BlockState& {
    return simulation.states()[at(polygon.blocks.at(side))];
  };
  const Vector3 apart =
      model(1).motion_of(state(1), corner).place - model(0).motion_of(state(0), corner).place;
  const Eigen::Matrix3d gradient = state(0).position.transpose() * model(0).basis().gradients(corner);
  const Vector3 normal = gradient.inverse().transpose().eval() * polygon.normal;
  const double gap = normal.dot(apart) / normal.norm();
  return {gap, (apart - gap / normal.norm() * normal).norm()};
}

/// Sums over polygons.
struct Widths {
  double area = 0.0, open_area = 0.0, moment = 0.0;  ///< m^2, m^2, m^3
  double largest_opening = 0.0, largest_slip = 0.0;  ///< m
};

void add(const Simulation& simulation, const JointPolygons::Polygon& polygon, Widths& widths) {
  std::vector<Parting> parted;
  for (const Vector3& corner : polygon.corners) {
    parted.push_back(parting_at(simulation, polygon, corner));
    widths.largest_opening = std::max(widths.largest_opening, parted.back().gap);
    widths.largest_slip = std::max(widths.largest_slip, parted.back().slip);
  }
  double area = 0.0, gap = 0.0, opening = 0.0;
  const std::vector<Vector3>& c = polygon.corners;
  for (std::size_t k = 2; k < c.size(); ++k) {
    const double part = 0.5 * (c[k - 1] - c[0]).cross(c[k] - c[0]).norm();
    area += part;
    for (const std::size_t corner : {std::size_t{0}, k - 1, k}) {
      gap += part / 3.0 * parted[corner].gap;
      opening += part / 3.0 * std::max(0.0, parted[corner].gap);
    }
  }
  widths.area += area;
  widths.moment += opening;
  if (gap > 0.0) widths.open_area += area;
}

}  // namespace

DriftLevels drift_levels(const Scene& scene, const SceneDrift& drift, const std::vector<BlockModel>& blocks) {
  DriftLevels levels;
  levels.up = up_of(scene);
  levels.distance = drift.heights[1] - drift.heights[0];
  for (std::size_t end = 0; end < 2; ++end) {
    std::vector<DriftLevels::Place>& places = levels.places.at(end);
    double mass = 0.0;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const BlockModel& block = blocks[k];
      if (!means_block(scene, drift.blocks, k) ||
          !reaches_level(block.solid().mesh().points, levels.up, drift.heights.at(end)))
        continue;
      const double share = block.fixed() ? 0.0 : block.mass();
      places.push_back({static_cast<int>(k),
                        point_at_level(block.basis().centroid(), levels.up, drift.heights.at(end)), share});
      mass += share;
    }
    for (DriftLevels::Place& place : places)
      if (!(mass > 0.0)) place.weight = blocks[at(place.block)].basis().volume();
  }
  return levels;
}

Vector3 measured_drift(const Simulation& simulation, const DriftLevels& levels) {
  const Vector3 moved =
      mean_displacement(simulation, levels.places[1]) - mean_displacement(simulation, levels.places[0]);
  return (moved - levels.up.dot(moved) * levels.up) / levels.distance;
}

JointPolygons joint_polygons(const Scene& scene, const SceneCrack& crack,
                             const std::vector<BlockModel>& blocks) {
  const Selection selection(scene, crack);
  const std::vector<int> originals = original_blocks(scene, blocks);
  JointPolygons joints;
  std::vector<Box> boxes;
  boxes.reserve(blocks.size());
  for (const BlockModel& block : blocks)
    boxes.push_back(box_of(block.solid().mesh().points).grown(allowed_offset(block.solid())));
  for (const std::array<int, 2>& pair : meeting_boxes(boxes)) {
    if (!selection.contains(at(originals[at(pair[0])]), at(originals[at(pair[1])]))) continue;
    for (const CommonPolygon& common :
         common_polygons(blocks[at(pair[0])].solid(), blocks[at(pair[1])].solid())) {
      JointPolygons::Polygon polygon{pair, common.frame.w, {}};
      for (const Eigen::Vector2d& corner : common.corners) polygon.corners.push_back(common.point(corner));
      joints.polygons.push_back(std::move(polygon));
    }
  }
  return joints;
}

CrackWidths measured_cracks(const Simulation& simulation, const JointPolygons& joints) {
  Widths widths;
  for (const JointPolygons::Polygon& polygon : joints.polygons)
    if (simulation.system().present(polygon.blocks[0]) && simulation.system().present(polygon.blocks[1]))
      add(simulation, polygon, widths);
  if (!(widths.area > 0.0)) return {not_measured, not_measured, not_measured, 0.0};
  return {widths.largest_opening, widths.moment / widths.area, widths.largest_slip, widths.open_area};
}

}  // namespace ashlar
