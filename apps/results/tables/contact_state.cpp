#include "apps/results/tables/contact_state.hpp"

#include <algorithm>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Sums over the closed points of a pair.
struct JointForces {
  double strength = 0.0;             ///< N, most shear force
  Vector3 centre = Vector3::Zero();  ///< m
  Vector3 shear = Vector3::Zero();   ///< N, resultant on the first block
  Vector3 moment = Vector3::Zero();  ///< N m, about the centre
  double moment_strength = 0.0;      ///< N m, most moment

  [[nodiscard]] bool at_limit() const {
    return shear.norm() >= joint_limit_share * strength ||
           (moment_strength > 0.0 && moment.norm() >= joint_limit_share * moment_strength);
  }
};

Vector3 shear_of(const ContactPoint& point, const PointResponse& response) {
  return response.force[1] * point.tangent_1 + response.force[2] * point.tangent_2;
}

JointForces forces_of(const Simulation& simulation, const PairRecord& record) {
  const JointLaw law = simulation.system().law(record.a, record.b);
  std::vector<double> strengths(record.points.size(), 0.0);
  JointForces forces;
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    const PointResponse& response = record.responses[k];
    if (response.state == ContactState::open) continue;
    strengths[k] = response.force.tail<2>().norm();
    if (response.state == ContactState::locked) {
      const PointLaw of_point = point_law(law, record.points[k].area, true);
      strengths[k] = std::max(strengths[k], of_point.shear_strength(response.force[0]));
    }
    forces.strength += strengths[k];
    forces.centre += strengths[k] * record.points[k].place_a;
    forces.shear += shear_of(record.points[k], response);
  }
  if (!(forces.strength > 0.0)) return forces;
  forces.centre /= forces.strength;
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    if (record.responses[k].state == ContactState::open) continue;
    const Vector3 arm = record.points[k].place_a - forces.centre;
    forces.moment += arm.cross(shear_of(record.points[k], record.responses[k]));
    forces.moment_strength += strengths[k] * arm.norm();
  }
  return forces;
}

/// Slip of a point in the last step, m.
double slip_in_step(const Simulation& simulation, const PairRecord& record, const ContactPoint& point) {
  const auto place = [&](int block, const Vector3& material) {
    const BlockModel& model = simulation.blocks()[at(block)];
    return Vector3(simulation.states()[at(block)].position.transpose() * model.basis().values(material));
  };
  const Vector3 moved =
      place(record.a, point.material_a) - point.place_a - (place(record.b, point.material_b) - point.place_b);
  return (moved - point.normal.dot(moved) * point.normal).norm();
}

/// False for blocks whose material coordinates change.
bool follows_points(const Simulation& simulation, const PairRecord& record) {
  return simulation.blocks()[at(record.a)].incremental() == nullptr &&
         simulation.blocks()[at(record.b)].incremental() == nullptr;
}

}  // namespace

std::vector<ContactState> shown_states(const Simulation& simulation, const PairRecord& record) {
  std::vector<ContactState> states;
  bool any_slides = false;
  for (const PointResponse& response : record.responses) {
    states.push_back(response.state);
    any_slides = any_slides || response.state == ContactState::sliding;
  }
  if (!any_slides || !follows_points(simulation, record) || forces_of(simulation, record).at_limit())
    return states;
  const double still =
      still_slip_rate * simulation.report().step *
      std::min(simulation.blocks()[at(record.a)].size(), simulation.blocks()[at(record.b)].size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k] == ContactState::sliding && !(slip_in_step(simulation, record, record.points[k]) > still))
      states[k] = ContactState::locked;
  }
  return states;
}

ShownContacts contact_counts(const Simulation& simulation) {
  const ShownContacts* of_all = simulation.shown_contacts();
  return of_all != nullptr ? *of_all : own_contact_counts(simulation);
}

ShownContacts own_contact_counts(const Simulation& simulation) {
  ShownContacts counts;
  for (const PairRecord& record : simulation.contacts()) {
    if (!simulation.system().owns_pair(record.a, record.b)) continue;
    for (const ContactState state : shown_states(simulation, record))
      ++(state == ContactState::open     ? counts.open
         : state == ContactState::locked ? counts.locked
                                         : counts.sliding);
  }
  return counts;
}

}  // namespace ashlar
