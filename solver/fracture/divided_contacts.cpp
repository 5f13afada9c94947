#include "solver/fracture/divided_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/index.hpp"
#include "solver/step/detect/step_contacts.hpp"

namespace ashlar {
namespace {

/// Sine of the largest angle between a part's face and the face of the whole that it lies in: rounding is far below, edges
/// between faces are far above.
constexpr double same_plane = 1e-6;

using Entry = ContactMemory::Entry;

/// A contact point of a part.
struct PlaceOnPart {
  std::size_t part;
  int face;
};

/// Finds the part and its face at places on the surface of the whole block.
class PartFinder {
 public:
  PartFinder(const Polyhedron& whole, const std::vector<const BlockModel*>& parts) : whole_(whole) {
    for (const BlockModel* part : parts) finders_.emplace_back(part->solid());
  }

  /// @param face of the whole block
  [[nodiscard]] PlaceOnPart at_place(const Vector3& place, int face) const {
    PlaceOnPart result{0, face};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < finders_.size(); ++k) {
      const double squared_distance = finders_[k].find_any(place).squared_distance;
      if (squared_distance < least) least = squared_distance, result.part = k;
    }
    result.face = face_of(result.part, place, face);
    return result;
  }

 private:
  /// The face of a part in a face of the whole, of several the one with the nearest corner.
  [[nodiscard]] int face_of(std::size_t part, const Vector3& place, int face) const {
    const Polyhedron& solid = finders_[part].solid();
    const Vector3& normal = whole_.faces().at(at(face)).normal;
    int found = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < solid.faces().size(); ++k) {
      const PolyhedronFace& one = solid.faces()[k];
      if (one.normal.cross(normal).norm() > same_plane || one.normal.dot(normal) < 0.0) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const int corner : one.loops.front())
        nearest = std::min(nearest, (solid.mesh().points[at(corner)] - place).norm());
      const double height = std::abs(normal.dot(place - solid.mesh().points[at(one.loops.front().front())]));
      // In the plane first: faces of other planes are farther than any corner in it.
      const double distance = nearest + height / same_plane;
      if (distance < least) least = distance, found = static_cast<int>(k);
    }
    return found;
  }

  const Polyhedron& whole_;
  std::vector<ClosestPointFinder> finders_;
};

/// The point with its blocks in the other order.
Entry exchanged(Entry entry) {
  std::swap(entry.material_a, entry.material_b);
  std::swap(entry.face_a, entry.face_b);
  entry.normal = -entry.normal;
  for (Vector3* of_a : {&entry.memory.slip, &entry.memory.level_slip, &entry.memory.shear_multiplier})
    *of_a = -*of_a;
  return entry;
}

/// A share of a history's amounts, with some of its points.
PairHistory share_of(const PairHistory& whole, std::vector<Entry> entries, double share) {
  PairHistory part;
  const ContactMemory& memory = whole.memory;
  part.memory = ContactMemory(std::move(entries), {}, memory.deepest(),
                              {share * memory.held().normal, share * memory.held().shear}, memory.bulge());
  part.work = share * whole.work;
  part.spent = share * whole.spent;
  part.bonded = share * whole.bonded;
  part.broken = share * whole.broken;
  part.depth = whole.depth;
  part.overlap = whole.overlap;
  return part;
}

/// @param normal force of a point, compression positive, N
double limited(const PointLaw& law, double normal) {
  return std::max(normal, -law.tension);
}

/// Sets the springs of a point so that they have a force. @param force on a, N. @param energy is added to
void stretch(const PointLaw& law, const ContactPoint& point, const Vector3& force, PointMemory& memory,
             SpringEnergy& energy) {
  const double normal = limited(law, point.normal.dot(force));
  Vector3 shear = force - point.normal.dot(force) * point.normal;
  const double resisted = law.shear_strength(normal);
  if (const double length = shear.norm(); length > resisted) shear *= resisted / length;
  memory.intact = true;
  memory.in_level = true;
  memory.state = ContactState::locked;
  const NormalSpring spring = law.normal_spring();
  memory.dilation = memory.level_dilation = spring.closure(normal);
  memory.compression = memory.dilation - point.gap;
  memory.slip = memory.level_slip = -shear / law.shear_stiffness;
  energy.normal += spring.energy(memory.dilation);
  energy.shear += 0.5 * shear.squaredNorm() / law.shear_stiffness;
}

}  // namespace

void divide_histories(const PartNumbers& divided, const Polyhedron& whole,
                      const std::vector<const BlockModel*>& parts, PairHistories& histories) {
  const PartFinder finder(whole, parts);
  PairHistories of_parts;
  for (const auto& [blocks, history] : histories) {
    if (blocks[0] != divided.block && blocks[1] != divided.block) continue;
    const bool is_a = blocks[0] == divided.block;
    const int other = is_a ? blocks[1] : blocks[0];
    std::vector<std::vector<Entry>> entries(parts.size());
    std::vector<double> areas(parts.size(), 0.0);
    double sum = 0.0;
    for (Entry entry : history.memory.entries()) {
      int& face = is_a ? entry.face_a : entry.face_b;
      const PlaceOnPart place = finder.at_place(is_a ? entry.material_a : entry.material_b, face);
      face = place.face;
      areas[place.part] += entry.area;
      sum += entry.area;
      entries[place.part].push_back(std::move(entry));
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const int number = divided.numbers[k];
      const bool first = number < other;
      if (first != is_a)
        for (Entry& entry : entries[k]) entry = exchanged(std::move(entry));
      const double share = sum > 0.0 ? areas[k] / sum : (k == 0 ? 1.0 : 0.0);
      const PairKey pair = first ? PairKey{number, other} : PairKey{other, number};
      of_parts.emplace(pair, share_of(history, std::move(entries[k]), share));
    }
  }
  std::erase_if(histories, [&](const auto& pair) {
    return pair.first[0] == divided.block || pair.first[1] == divided.block;
  });
  for (auto& [blocks, history] : of_parts) histories.emplace(blocks, std::move(history));
  drop_empty(histories);
}

std::map<PairKey, ContactMemory> crack_joints(const BlockSystem& system,
                                              const std::vector<BlockState>& states, const BlockModel& whole,
                                              const BlockState& state) {
  RunState parts;
  parts.states = states;
  parts.sleep.rests.resize(states.size());
  parts.spin_debts.assign(states.size(), 0.0);
  StepContacts contacts(system);
  const std::vector<FoundContacts> found = contacts.detect(system, parts, 0.0);
  std::map<PairKey, ContactMemory> joints;
  for (const ContactPair& pair : contacts.pairs(system, parts, found, PairUse::statics)) {
    std::vector<PointMemory> memory = pair.memory();
    SpringEnergy energy;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      const ContactPoint& point = pair.points()[k];
      const Eigen::Matrix3d stress = whole.stress(state, point.material_a);
      stretch(pair.laws()[k], point, -point.area * (stress * point.normal), memory[k], energy);
    }
    joints[{pair.a(), pair.b()}].store(pair.points(), std::move(memory), pair.depth_found(), energy);
  }
  return joints;
}

}  // namespace ashlar
