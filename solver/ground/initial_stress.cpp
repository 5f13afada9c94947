#include "solver/ground/initial_stress.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/detect/step_contacts.hpp"

namespace ashlar {
namespace {

/// Mean stress of two blocks at a point; empty if neither has any.
std::optional<Eigen::Matrix3d> stress_at(const BlockModel& a, const BlockModel& b,
                                         const ContactPoint& point) {
  const StressField& of_a = a.initial_stress();
  const StressField& of_b = b.initial_stress();
  if (of_a && of_b) return 0.5 * (of_a(point.place_a) + of_b(point.place_b));
  if (of_a) return of_a(point.place_a);
  if (of_b) return of_b(point.place_b);
  return std::nullopt;
}

/// @param force on a, N. @param per_area true: multipliers are remembered per area. @param energy is added to
/// @return the force that the point begins with
Vector3 load_point(const PointLaw& law, const ContactPoint& point, const Vector3& force, bool per_area,
                   PointMemory& memory, SpringEnergy& energy) {
  const double normal = point.normal.dot(force);
  if (!(normal > 0.0)) return Vector3::Zero();
  const Vector3 shear = force - normal * point.normal;
  memory.in_level = true;
  memory.state = ContactState::locked;
  if (law.augmented) {
    const double scale = per_area ? point.area : 1.0;
    memory.normal_multiplier = normal / scale;
    memory.shear_multiplier = shear / scale;
    return force;
  }
  const NormalSpring spring = law.normal_spring();
  memory.dilation = memory.level_dilation = spring.closure(normal);
  memory.compression = memory.dilation - point.gap;
  memory.slip = memory.level_slip = -shear / law.shear_stiffness;
  energy.normal += spring.energy(memory.dilation);
  energy.shear += 0.5 * shear.squaredNorm() / law.shear_stiffness;
  return force;
}

/// Sums of the forces on each block.
class BlockForces {
 public:
  BlockForces(const BlockSystem& system, double time)
      : sum_(static_cast<std::size_t>(system.count()), Vector3::Zero()), size_(sum_.size(), 0.0) {
    for (int k = 0; k < system.count(); ++k) {
      const BlockModel& block = system.blocks()[at(k)];
      if (block.fixed()) continue;
      const Vector3 own = block.external_force(system.settings().gravity_at(time), time).row(0).transpose();
      add(k, std::sqrt(block.basis().volume()) * own);
    }
  }
  void add(int block, const Vector3& force) {
    sum_[at(block)] += force;
    size_[at(block)] += force.norm();
  }
  [[nodiscard]] std::optional<StressImbalance> worst(const BlockSystem& system) const {
    std::optional<StressImbalance> result;
    for (int k = 0; k < system.count(); ++k) {
      if (!system.moving()[at(k)] || !system.owns(k) || system.is_tied(k)) continue;
      if (size_[at(k)] == 0.0) continue;
      // Supports give what is missing along the axes that they hold.
      Vector3 missing = sum_[at(k)];
      for (int axis = 0; axis < 3; ++axis)
        if (!system.blocks()[at(k)].space().free_along(axis)) missing[axis] = 0.0;
      const double share = missing.norm() / size_[at(k)];
      if (!result || share > result->share) result = StressImbalance{k, missing.norm(), share};
    }
    return result;
  }

 private:
  std::vector<Vector3> sum_;  ///< (#blocks), N
  std::vector<double> size_;  ///< (#blocks), sum of their sizes, N
};

}  // namespace

namespace {

/// Loads the points of pairs. @param forces are added to
std::map<PairKey, ContactMemory> loaded_contacts(const BlockSystem& system,
                                                 const std::vector<ContactPair>& pairs, BlockForces& forces) {
  std::map<PairKey, ContactMemory> contacts;
  for (const ContactPair& pair : pairs) {
    if (pair.tied()) continue;
    std::vector<PointMemory> memory = pair.memory();
    SpringEnergy energy;
    bool any = false;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      const ContactPoint& point = pair.points()[k];
      const auto stress = stress_at(system.blocks()[at(pair.a())], system.blocks()[at(pair.b())], point);
      if (!stress) continue;
      any = true;
      const Vector3 force = load_point(pair.laws()[k], point, -point.area * (*stress * point.normal),
                                       system.settings().area_springs, memory[k], energy);
      forces.add(pair.a(), force);
      forces.add(pair.b(), -force);
    }
    if (!any) continue;
    contacts[{pair.a(), pair.b()}].store(pair.points(), std::move(memory), pair.depth_found(), energy);
  }
  return contacts;
}

/// The largest share of all processes, of equal ones that of the lowest block. Collective.
std::optional<StressImbalance> worst_of_run(const BlockSystem& system, std::optional<StressImbalance> here) {
  std::optional<StressImbalance> worst;
  for (const auto& of_process : values_of_run(system, here)) {
    if (!of_process) continue;
    if (!worst || of_process->share > worst->share ||
        (of_process->share == worst->share && of_process->block < worst->block))
      worst = of_process;
  }
  return worst;
}

}  // namespace

StressedContacts contacts_under_stress(const BlockSystem& system, RunState& state) {
  StressedContacts result;
  BlockForces forces(system, state.time());
  StepContacts contacts(system);
  const std::vector<FoundContacts> found = contacts.detect(system, state, 0.0);
  const std::vector<ContactPair> pairs = contacts.pairs(system, state, found, PairUse::statics);
  const auto load = [&] { result.contacts = loaded_contacts(system, pairs, forces); };
  // Stresses may have no value somewhere.
  system.exchange().on_all(load);
  result.worst = worst_of_run(system, forces.worst(system));
  return result;
}

}  // namespace ashlar
