#include "solver/limit/pressure_friction.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Passes, and the relative change of a coefficient at which they end: well below the tolerance of a factor.
constexpr int most_passes = 20;
constexpr double converged = 1e-4;
/// Divisions of the triangles of a joint in four, for its pressure.
constexpr int divisions = 3;
/// Iterations for that, the relative error of its resultant, and the least share of a step.
constexpr int most_pressure_iterations = 100;
constexpr double same_resultant = 1e-8, least_step_share = 1e-6;

bool varies(const RigidPoint& point) {
  return !point.bar && point.law.friction_varies();
}

/// A part of a joint: its place along the tangents of the joint, from a point of it.
struct JointPart {
  Eigen::Vector2d place;  ///< m
  double area;            ///< m^2
};
/// Two faces in contact.
struct FacesInContact {
  std::vector<JointPart> parts;
  Vector3 origin;
  Eigen::Matrix<double, 2, 3> tangents;
  double normal = 0.0;                               ///< N
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  ///< N m, of it along both tangents
  JointLaw law;

  [[nodiscard]] Eigen::Vector2d place_of(const Vector3& at) const { return tangents * (at - origin); }
};
using FaceKey = std::tuple<PairKey, int, int>;
FaceKey faces_of(const RigidPoint& point) {
  return {key_of(point.blocks), point.contact.face_a, point.contact.face_b};
}

/// Divides a triangle so many times in four.
void add_parts(FacesInContact& faces, const std::array<Eigen::Vector2d, 3>& corner, int times) {
  if (times == 0) {
    const Eigen::Vector2d a = corner[1] - corner[0], b = corner[2] - corner[0];
    faces.parts.push_back(
        {(corner[0] + corner[1] + corner[2]) / 3.0, 0.5 * std::abs(a[0] * b[1] - a[1] * b[0])});
    return;
  }
  const Eigen::Vector2d ab = 0.5 * (corner[0] + corner[1]), bc = 0.5 * (corner[1] + corner[2]),
                        ca = 0.5 * (corner[2] + corner[0]);
  for (const auto& part :
       {std::array{corner[0], ab, ca}, {ab, corner[1], bc}, {ca, bc, corner[2]}, {ab, bc, ca}})
    add_parts(faces, part, times - 1);
}

/// Joints whose friction varies, with the forces of an answer.
std::map<FaceKey, FacesInContact> loaded_faces(const RigidModel& model,
                                               const std::vector<Eigen::Vector3d>& force) {
  std::map<FaceKey, FacesInContact> joints;
  for (const RigidPoint& area : model.areas) {
    if (!varies(area)) continue;
    const auto [joint, is_new] = joints.try_emplace(faces_of(area));
    FacesInContact& faces = joint->second;
    if (is_new) {
      faces.origin = area.place;
      faces.tangents = area.frame.bottomRows<2>();
      faces.law = area.law;
    }
    const auto& corner = area.part->corners;
    add_parts(faces, {faces.place_of(corner[0]), faces.place_of(corner[1]), faces.place_of(corner[2])},
              divisions);
  }
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const double normal = force[k][0] * model.units.force();
    const auto joint = joints.find(faces_of(model.points[k]));
    if (!varies(model.points[k]) || joint == joints.end() || !(normal > 0.0)) continue;
    joint->second.normal += normal;
    joint->second.moment += normal * joint->second.place_of(model.points[k].place);
  }
  return joints;
}

/// Pressure that is linear where it is not zero, with the resultant of a joint: Newton's method for the least of the convex
/// function sum A max(0, a + b . x)^2 / 2 - N a - M . b. @return by part, Pa; empty: the resultant is too near an edge
std::vector<double> linear_pressure(const FacesInContact& faces) {
  double area = 0.0;
  for (const JointPart& part : faces.parts) area += part.area;
  const double length = std::sqrt(area), mean = faces.normal / area;
  const Eigen::Vector3d wanted(1.0, faces.moment[0] / faces.normal / length,
                               faces.moment[1] / faces.normal / length);
  Eigen::Vector3d plane(1.0, 0.0, 0.0);
  const auto at = [&](const JointPart& part) {
    return Eigen::Vector3d(1.0, part.place[0] / length, part.place[1] / length);
  };
  const auto value = [&](const Eigen::Vector3d& of) {
    double sum = -wanted.dot(of);
    for (const JointPart& part : faces.parts) {
      const double pressure = std::max(0.0, of.dot(at(part)));
      sum += 0.5 * part.area / area * pressure * pressure;
    }
    return sum;
  };
  for (int n = 0; n < most_pressure_iterations; ++n) {
    Eigen::Vector3d gradient = -wanted;
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (const JointPart& part : faces.parts) {
      const Eigen::Vector3d place = at(part);
      const double pressure = plane.dot(place);
      if (!(pressure > 0.0)) continue;
      gradient += part.area / area * pressure * place;
      slope += part.area / area * place * place.transpose();
    }
    if (gradient.norm() < same_resultant) {
      std::vector<double> pressure;
      for (const JointPart& part : faces.parts) pressure.push_back(mean * std::max(0.0, plane.dot(at(part))));
      return pressure;
    }
    const Eigen::Vector3d step = -slope.completeOrthogonalDecomposition().solve(gradient);
    double share = 1.0;
    for (const double before = value(plane);
         share > least_step_share && !(value(plane + share * step) < before); share *= 0.5) {
    }
    plane += share * step;
  }
  return {};
}

/// Force of friction that a joint resists, N.
double resisted(const FacesInContact& faces) {
  const std::vector<double> pressure = linear_pressure(faces);
  if (pressure.empty()) return least_friction(faces.law, faces.normal);
  double sum = 0.0;
  for (std::size_t k = 0; k < pressure.size(); ++k) {
    if (!(pressure[k] > 0.0)) continue;
    const double area = faces.parts[k].area;
    sum += friction_of_part(faces.law, area, pressure[k] * area);
  }
  return sum;
}

/// Friction under the forces of an answer.
PairFriction friction_under(const RigidModel& model, const std::vector<Eigen::Vector3d>& force) {
  std::map<PairKey, std::array<double, 2>> sums;  // of friction forces and normal forces
  for (const auto& [key, faces] : loaded_faces(model, force)) {
    if (!(faces.normal > 0.0)) continue;
    auto& [friction, pressing] = sums[std::get<0>(key)];
    friction += resisted(faces);
    pressing += faces.normal;
  }
  PairFriction result;
  for (const auto& [pair, sum] : sums) result[pair] = sum[0] / sum[1];
  return result;
}

std::vector<Eigen::Vector3d> forces_of(const RigidModel& model, const LimitFactors& factors,
                                       const std::vector<bool>& reduced) {
  ConeProgram program = program_of(model, 1, FrictionAt::uniform_pressure);
  for (std::size_t k = 0; k < reduced.size(); ++k)
    if (reduced[k]) program.set_strength(k, strength_of(model, model.points[k], factors.strength));
  ConeQuestion asked;
  asked.load = model.steady;
  for (std::size_t b = 0; b < asked.load.size(); ++b) asked.load[b] += factors.load * model.multiplied[b];
  return program.solve(asked).force;
}

}  // namespace

bool has_pressure_friction(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(), varies);
}

double set_pressure_friction(RigidModel& model, const LimitFactors& factors,
                             const std::vector<bool>& reduced) {
  const PairFriction before = pressure_friction(model);
  for (int pass = 0; pass < most_passes; ++pass) {
    const PairFriction last = pressure_friction(model);
    const PairFriction friction = friction_under(model, forces_of(model, factors, reduced));
    set_pressure_friction(model, friction);
    double change = 0.0;
    for (const auto& [pair, value] : friction)
      change = std::max(change, std::abs(value / last.at(pair) - 1.0));
    if (change < converged) break;
  }
  double change = 0.0;
  for (const auto& [pair, value] : pressure_friction(model))
    change = std::max(change, std::abs(value / before.at(pair) - 1.0));
  return change;
}

PairFriction pressure_friction(const RigidModel& model) {
  PairFriction friction;
  for (const RigidPoint& point : model.points)
    if (varies(point)) friction[key_of(point.blocks)] = point.law.friction;
  return friction;
}

void set_pressure_friction(RigidModel& model, const PairFriction& friction) {
  for (RigidPoint& point : model.points) {
    if (!varies(point)) continue;
    const auto found = friction.find(key_of(point.blocks));
    if (found != friction.end()) set_mean_friction(point.law, found->second);
  }
}

}  // namespace ashlar
