#include "apps/results/tables/measure.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <numbers>
#include <set>

#include "apps/results/tables/original_blocks.hpp"
#include "apps/scene/check/water_checks.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

int index_of(const Scene& scene, const std::string& name) {
  const auto block = std::find_if(scene.block.begin(), scene.block.end(),
                                  [&](const SceneBlock& candidate) { return candidate.name == name; });
  return static_cast<int>(block - scene.block.begin());
}

/// Gradient of the motion at a point, for a block of the total formulation.
Eigen::Matrix3d gradient_at(const BlockModel& block, const BlockState& state, const Vector3& point) {
  return state.position.transpose() * block.basis().gradients(point);
}

Vector3 place_of(const BlockModel& block, const BlockState& state, const Vector3& point) {
  return state.position.transpose() * block.basis().values(point);
}

}  // namespace

std::vector<Measure> measures_of(const Scene& scene, const std::vector<BlockModel>& blocks) {
  std::vector<Measure> measures;
  std::shared_ptr<const std::vector<int>> parts;
  if (!scene.crack.empty()) {
    parts = std::make_shared<const std::vector<int>>(original_blocks(scene, blocks));
    measures.reserve(scene.measure.size() + 1);
  }
  for (const SceneMeasure& given : scene.measure) {
    if (!given.bolt.empty()) {
      measures.push_back({given.name, Measure::Kind::bolt, 0, Vector3::Zero(), -1, given.bolt});
      continue;
    }
    if (given.drift) {
      measures.push_back({.name = given.name, .kind = Measure::Kind::drift});
      measures.back().levels = std::make_shared<DriftLevels>(drift_levels(scene, *given.drift, blocks));
      continue;
    }
    if (given.crack) {
      measures.push_back({.name = given.name, .kind = Measure::Kind::crack});
      measures.back().joints = std::make_shared<JointPolygons>(joint_polygons(scene, *given.crack, blocks));
      continue;
    }
    if (given.block.empty()) {
      measures.push_back({given.name, Measure::Kind::pair, index_of(scene, given.pair[0]), Vector3::Zero(),
                          index_of(scene, given.pair[1])});
      continue;
    }
    const int block = index_of(scene, given.block);
    if (given.point && parts)
      measures.push_back(
          {given.name, Measure::Kind::point, part_at(blocks, *parts, block, *given.point), *given.point, -1});
    else if (given.point)
      measures.push_back({given.name, Measure::Kind::point, block, *given.point, -1});
    else
      measures.push_back({given.name, Measure::Kind::block, block, blocks[at(block)].basis().centroid(), -1});
  }
  if (parts) measures.push_back({.name = "energy", .kind = Measure::Kind::fracture});
  for (Measure& measure : measures) {
    measure.parts = parts;
    measure.origin = scene.origin;
    measure.up = up_of(scene);
  }
  return measures;
}

ResultNeeds needs_of(const std::vector<Measure>& measures) {
  std::set<int> blocks;
  std::set<PairKey> pairs;
  for (const Measure& measure : measures) {
    if (measure.levels != nullptr) {
      for (const auto& level : measure.levels->places)
        for (const DriftLevels::Place& place : level) blocks.insert(place.block);
    } else if (measure.joints != nullptr) {
      for (const JointPolygons::Polygon& polygon : measure.joints->polygons)
        blocks.insert(polygon.blocks.begin(), polygon.blocks.end());
    } else if (measure.kind != Measure::Kind::bolt && measure.kind != Measure::Kind::fracture) {
      blocks.insert(measure.block);
    }
    if (measure.kind != Measure::Kind::pair) continue;
    blocks.insert(measure.other);
    pairs.insert({std::min(measure.block, measure.other), std::max(measure.block, measure.other)});
  }
  return {false, {blocks.begin(), blocks.end()}, {pairs.begin(), pairs.end()}};
}

PointMotion measured_motion(const Simulation& simulation, const Measure& measure) {
  if (simulation.system().present(measure.block)) {
    PointMotion motion = simulation.blocks()[at(measure.block)].motion_of(
        simulation.states()[at(measure.block)], measure.point);
    motion.place += measure.origin;
    return motion;
  }
  const Vector3 nowhere = Vector3::Constant(not_measured);
  return {nowhere, nowhere, nowhere, Eigen::Matrix3d::Constant(not_measured)};
}

Vector3 measured_turn(const Simulation& simulation, const Measure& measure) {
  if (!simulation.system().present(measure.block)) return Vector3::Constant(not_measured);
  const Eigen::Matrix3d gradient = gradient_at(simulation.blocks()[at(measure.block)],
                                               simulation.states()[at(measure.block)], measure.point);
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return rotation_vector(parts.matrixU() * parts.matrixV().transpose()) * 180.0 / std::numbers::pi;
}

Vector3 slip_of(const Simulation& simulation, const PairRecord& pair, std::size_t index) {
  const ContactPoint& point = pair.points[index];
  const BlockModel& a = simulation.blocks()[at(pair.a)];
  const BlockModel& b = simulation.blocks()[at(pair.b)];
  if (a.incremental() != nullptr || b.incremental() != nullptr) return Vector3::Zero();
  const BlockState& state = simulation.states()[at(pair.a)];
  // The two points coincided at the start of the step: distance between them at the initial placement, and their
  // displacements since then.
  const Vector3 displacement =
      gradient_at(a, state, point.material_a) * (point.material_b - point.material_a) +
      place_of(a, state, point.material_a) - place_of(b, simulation.states()[at(pair.b)], point.material_b);
  return displacement - point.normal.dot(displacement) * point.normal;
}

BoltMeasure measured_bolt(const Simulation& simulation, const Measure& measure) {
  const std::vector<Bolt>& bolts = simulation.system().bolts();
  const auto bolt =
      std::find_if(bolts.begin(), bolts.end(), [&](const Bolt& known) { return known.name == measure.bolt; });
  if (bolt == bolts.end() || !simulation.bolts()[static_cast<std::size_t>(bolt - bolts.begin())].installed())
    return {not_measured, not_measured, BoltCondition::absent};
  const BoltState& state = simulation.bolts()[static_cast<std::size_t>(bolt - bolts.begin())];
  return {largest_axial_force(state), largest_shear_force(state), condition_of(*bolt, state)};
}

PairMeasure measured_pair(const Simulation& simulation, const Measure& measure) {
  const auto [low, high] = std::minmax(measure.block, measure.other);
  const auto is_of_pair = [&, a = low, b = high](const PairRecord& pair) {
    if (!measure.parts) return pair.a == a && pair.b == b;
    const auto [first, second] = std::minmax((*measure.parts)[at(pair.a)], (*measure.parts)[at(pair.b)]);
    return first == a && second == b;
  };
  PairMeasure result{0.0, 0.0, not_measured, not_measured, 0.0};
  Vector3 shear = Vector3::Zero();
  double area = 0.0, gap = 0.0, slip = 0.0;
  bool total = true;
  for (const PairRecord& record : simulation.contacts()) {
    if (!is_of_pair(record)) continue;
    // Forces on the parts of one block of both.
    const double side = !measure.parts || (*measure.parts)[at(record.a)] == low ? 1.0 : -1.0;
    for (std::size_t k = 0; k < record.points.size(); ++k) {
      const ContactPoint& point = record.points[k];
      const PointResponse& response = record.responses[k];
      result.normal_force += response.force[0];
      shear += side * (response.force[1] * point.tangent_1 + response.force[2] * point.tangent_2);
      area += point.area;
      gap += point.area * record.gaps[k];
      if (response.state != ContactState::open) result.area += point.area;
      slip += point.area * slip_of(simulation, record, k).norm();
    }
    for (const int block : {record.a, record.b})
      total = total && simulation.blocks()[at(block)].incremental() == nullptr;
  }
  result.shear_force = shear.norm();
  if (!(area > 0.0)) return result;
  result.opening = gap / area;
  if (total) result.slip = slip / area;
  return result;
}

}  // namespace ashlar
