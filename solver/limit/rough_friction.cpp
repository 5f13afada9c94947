#include "solver/limit/rough_friction.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Passes, and the relative change of a coefficient at which they end: well below the tolerance of a factor.
constexpr int most_passes = 20;
constexpr double converged = 1e-4;

bool is_rough(const RigidPoint& point) {
  return !point.bar && point.law.roughness.given();
}

void set_friction(RigidPoint& point, double friction) {
  point.law.friction = friction;
  // The residual strength of a joint that does not wear is its strength.
  if (point.law.residual && !point.law.roughness.wears()) point.law.residual->friction = friction;
}

/// Area of the joints of each pair, and how many points bear its pressure.
struct PairArea {
  double area = 0.0;
  double points = 0.0;
};
std::map<PairKey, PairArea> areas_of(const RigidModel& model) {
  std::map<PairKey, PairArea> areas;
  for (const RigidPoint& point : model.areas) areas[key_of(point.blocks)].area += point.area;
  // Parts beside the corners transmit cohesion and tension alone.
  for (const RigidPoint& point : model.points)
    if (is_rough(point) && point.area == 0.0) areas[key_of(point.blocks)].points += 1.0;
  return areas;
}

/// Friction under the forces of an answer.
PairFriction friction_under(const RigidModel& model, const std::vector<Eigen::Vector3d>& force) {
  std::map<PairKey, std::array<double, 2>> sums;  // of friction forces and normal forces
  const std::map<PairKey, PairArea> areas = areas_of(model);
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const RigidPoint& point = model.points[k];
    const double normal = force[k][0] * model.units.force();
    if (!is_rough(point) || point.area > 0.0 || !(normal > 0.0)) continue;
    const PairArea& whole = areas.at(key_of(point.blocks));
    Roughness roughness = point.law.roughness;
    roughness.share = 1.0;
    const PointRoughness rough = point_roughness(roughness, whole.area / whole.points, 0.0);
    auto& [friction, pressing] = sums[key_of(point.blocks)];
    friction += point.law.roughness.share *
                (rough.given() ? rough_bound(rough, normal).value : roughness.worn * normal);
    pressing += normal;
  }
  PairFriction result;
  for (const auto& [pair, sum] : sums) result[pair] = sum[0] / sum[1];
  return result;
}

std::vector<Eigen::Vector3d> forces_of(const RigidModel& model, const LimitFactors& factors) {
  ConeProgram program = program_of(model, 1, FrictionAt::uniform_pressure);
  for (std::size_t k = 0; k < model.points.size(); ++k)
    program.set_strength(
        k, strength_of(model, model.points[k], is_rough(model.points[k]) ? factors.strength : 1.0));
  ConeQuestion asked;
  asked.load = model.steady;
  for (std::size_t b = 0; b < asked.load.size(); ++b) asked.load[b] += factors.load * model.multiplied[b];
  return program.solve(asked).force;
}

}  // namespace

bool has_rough_joints(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(), is_rough);
}

double set_rough_friction(RigidModel& model, const LimitFactors& factors) {
  const PairFriction before = rough_friction(model);
  for (int pass = 0; pass < most_passes; ++pass) {
    const PairFriction last = rough_friction(model);
    const PairFriction friction = friction_under(model, forces_of(model, factors));
    set_rough_friction(model, friction);
    double change = 0.0;
    for (const auto& [pair, value] : friction)
      change = std::max(change, std::abs(value / last.at(pair) - 1.0));
    if (change < converged) break;
  }
  double change = 0.0;
  for (const auto& [pair, value] : rough_friction(model))
    change = std::max(change, std::abs(value / before.at(pair) - 1.0));
  return change;
}

PairFriction rough_friction(const RigidModel& model) {
  PairFriction friction;
  for (const RigidPoint& point : model.points)
    if (is_rough(point)) friction[key_of(point.blocks)] = point.law.friction;
  return friction;
}

void set_rough_friction(RigidModel& model, const PairFriction& friction) {
  for (RigidPoint& point : model.points) {
    if (!is_rough(point)) continue;
    const auto found = friction.find(key_of(point.blocks));
    if (found != friction.end()) set_friction(point, found->second);
  }
}

}  // namespace ashlar
