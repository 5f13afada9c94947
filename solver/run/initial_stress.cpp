#include "solver/run/initial_stress.hpp"

#include <algorithm>
#include <optional>

#include "geometry/index.hpp"
#include "solver/step/step_contacts.hpp"

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
void load_point(const PointLaw& law, const ContactPoint& point, const Vector3& force, bool per_area,
                PointMemory& memory, SpringEnergy& energy) {
  const double normal = point.normal.dot(force);
  if (!(normal > 0.0)) return;
  const Vector3 shear = force - normal * point.normal;
  memory.in_level = true;
  memory.state = ContactState::locked;
  if (law.augmented) {
    const double scale = per_area ? point.area : 1.0;
    memory.normal_multiplier = normal / scale;
    memory.shear_multiplier = shear / scale;
    return;
  }
  memory.dilation = memory.level_dilation = normal / law.normal_stiffness;
  memory.compression = memory.dilation - point.gap;
  memory.slip = memory.level_slip = -shear / law.shear_stiffness;
  energy.normal += 0.5 * normal * memory.dilation;
  energy.shear += 0.5 * shear.squaredNorm() / law.shear_stiffness;
}

}  // namespace

std::map<PairKey, ContactMemory> contacts_under_stress(const BlockSystem& system, RunState& state) {
  std::map<PairKey, ContactMemory> result;
  StepContacts contacts(system);
  const std::vector<FoundContacts> found = contacts.detect(system, state, 0.0);
  for (const ContactPair& pair : contacts.pairs(system, state, found, PairUse::statics)) {
    if (pair.tied()) continue;
    std::vector<PointMemory> memory = pair.memory();
    SpringEnergy energy;
    bool any = false;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      const ContactPoint& point = pair.points()[k];
      const auto stress = stress_at(system.blocks()[at(pair.a())], system.blocks()[at(pair.b())], point);
      if (!stress) continue;
      any = true;
      load_point(pair.laws()[k], point, -point.area * (*stress * point.normal),
                 system.settings().area_springs, memory[k], energy);
    }
    if (!any) continue;
    ContactMemory& of_pair = result[{pair.a(), pair.b()}];
    of_pair.store(pair.points(), std::move(memory), pair.depth_found(), energy);
  }
  return result;
}

}  // namespace ashlar
