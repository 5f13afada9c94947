#include "apps/run/contact_resolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Corners = std::array<Vector3, 3>;

/// @param point in the plane of the triangle
bool contains(const Corners& corners, const Vector3& point) {
  constexpr double rounding = 1e-9;
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 side = corners[(k + 1) % 3] - corners[k];
    if (!(side.cross(point - corners[k]).dot(normal) >= -rounding * normal.squaredNorm())) return false;
  }
  return true;
}

/// Sub-faces of a block that may curve, by face. They are triangles.
class SubFaces {
 public:
  SubFaces(const Simulation& simulation, int block)
      : surface_(simulation.finder().surfaces()[at(block)].surface()),
        model_(simulation.blocks()[at(block)]),
        state_(simulation.states()[at(block)]) {
    for (std::size_t k = 0; k < surface_.cells.size(); ++k) of_face_[surface_.cells[k].face].push_back(k);
  }

  /// Adds those of a face that have a point. @param point reference coordinates, m
  void collect(int face, const Vector3& point, std::set<std::size_t>& cells) const {
    const auto found = of_face_.find(face);
    if (found == of_face_.end()) return;
    for (const std::size_t cell : found->second)
      if (contains(corners_of(cell), point)) cells.insert(cell);
  }

  /// Distance of the curved face from a sub-face, m (ChordError::distance).
  [[nodiscard]] double chord_error(std::size_t cell) const {
    const auto [a, b, c] = corners_of(cell);
    const std::vector<PointMotion> motions =
        model_.motions_of(state_, {a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0});
    const Vector3 normal =
        (motions[1].place - motions[0].place).cross(motions[2].place - motions[0].place).stableNormalized();
    double largest = 0.0;
    for (const PointMotion& motion : motions)
      largest = std::max(largest, std::abs(normal.dot(motion.place - motions[0].place)));
    return largest;
  }

 private:
  [[nodiscard]] Corners corners_of(std::size_t cell) const {
    const std::vector<int>& corners = surface_.cells[cell].corners;
    return {surface_.points[at(corners[0])], surface_.points[at(corners[1])],
            surface_.points[at(corners[2])]};
  }

  const SubFaceSurface& surface_;
  const BlockModel& model_;
  const BlockState& state_;
  std::map<int, std::vector<std::size_t>> of_face_;
};

bool presses(const PairRecord& record, std::size_t point) {
  return record.responses[point].force[0] > 0.0;
}

}  // namespace

std::optional<ChordError> largest_chord_error(const Simulation& simulation) {
  if (simulation.shared_blocks() != nullptr) return std::nullopt;
  std::optional<ChordError> largest;
  std::map<int, SubFaces> surfaces;
  for (const PairRecord& record : simulation.contacts()) {
    const double smaller =
        std::min(simulation.blocks()[at(record.a)].size(), simulation.blocks()[at(record.b)].size());
    for (const bool of_a : {true, false}) {
      const int block = of_a ? record.a : record.b;
      if (!simulation.finder().surfaces()[at(block)].curves()) continue;
      const SubFaces& faces = surfaces.try_emplace(block, simulation, block).first->second;
      std::set<std::size_t> cells;
      for (std::size_t k = 0; k < record.points.size(); ++k) {
        const ContactPoint& point = record.points[k];
        if (!presses(record, k)) continue;
        faces.collect(of_a ? point.face_a : point.face_b, of_a ? point.material_a : point.material_b, cells);
      }
      for (const std::size_t cell : cells) {
        const double distance = faces.chord_error(cell);
        if (largest && !(distance / smaller > largest->share)) continue;
        largest = ChordError{distance, distance / smaller, block, of_a ? record.b : record.a};
      }
    }
  }
  return largest;
}

std::optional<SmallContact> unresolved_contact(const Simulation& simulation, int block) {
  const BlockModel& model = simulation.blocks()[at(block)];
  const double resolved = model.size() / model.order();
  SmallContact patch;
  double largest = 0.0;  // mean pressure, Pa
  for (const PairRecord& record : simulation.contacts()) {
    if (record.a != block && record.b != block) continue;
    double area = 0.0, force = 0.0;
    for (std::size_t k = 0; k < record.points.size(); ++k) {
      if (!presses(record, k)) continue;
      area += record.points[k].area;
      force += record.responses[k].force[0];
    }
    if (!(area > 0.0) || !(force / area > largest)) continue;
    largest = force / area;
    patch = SmallContact{record.a == block ? record.b : record.a, 2.0 * std::sqrt(area / std::numbers::pi),
                         resolved};
  }
  if (patch.other < 0 || !(patch.width < resolved)) return std::nullopt;
  return patch;
}

}  // namespace ashlar
