#include "apps/scene/check/warnings/turned_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "apps/scene/model/support_history.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "mechanics/material/elasticity.hpp"

namespace ashlar {
namespace {

/// Points of a block held by a support, and their motion.
struct SupportedPoints {
  std::vector<Vector3> points;  ///< m, placed
  std::array<bool, 3> components;
  std::optional<RecordedMotion> motion;  ///< none: at rest
};

std::vector<SupportedPoints> supported_points(const SceneBlock& block, const Polyhedron& solid) {
  std::vector<SupportedPoints> supports;
  for (const SceneFix& fix : block.fix) {
    SupportedPoints support{{}, fix.components, {}};
    if (const Vector3* point = std::get_if<Vector3>(&fix.where)) {
      support.points.push_back(*point);
    } else {
      const ScenePlane& plane = std::get<ScenePlane>(fix.where);
      for (const int face : faces_in_plane(solid, {plane.point, plane.normal})) {
        for (const auto& loop : solid.faces()[static_cast<std::size_t>(face)].loops) {
          for (const int corner : loop)
            support.points.push_back(solid.mesh().points[static_cast<std::size_t>(corner)]);
        }
      }
    }
    if (!fix.history.empty()) support.motion.emplace(support_history(fix));
    supports.push_back(std::move(support));
  }
  return supports;
}

/// The affine map of least gradient closest to the motion of the supported points in their fixed components, without
/// its translation: a common translation of all of them has no gradient. If they are coplanar and fixed in all
/// components, the normal of the plane rotates with it.
class SupportedFrame {
 public:
  explicit SupportedFrame(std::vector<SupportedPoints> supports) : supports_(std::move(supports)) {
    for (std::size_t axis = 0; axis < 3; ++axis) find_responses(axis);
    for (const SupportedPoints& support : supports_)
      held_alike_ = held_alike_ && support.components == std::array{true, true, true};
  }

  /// Rotation angle of the points, rad.
  [[nodiscard]] double turn_at(double time) const {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
    for (std::size_t n = 0; n < supports_.size(); ++n) {
      if (!supports_[n].motion) continue;
      const Vector3 displacement = supports_[n].motion->displacement(time);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        gradient.row(axis) += displacement[axis] * responses_[static_cast<std::size_t>(axis)][n].transpose();
    }
    if (held_alike_) turn_normal(gradient);
    return rotation_vector(polar_decomposition(gradient).rotation).norm();
  }

 private:
  /// Row of the gradient for a unit displacement of each support along an axis.
  void find_responses(std::size_t axis) {
    std::vector<Vector3> points;
    std::vector<std::size_t> owners;
    for (std::size_t n = 0; n < supports_.size(); ++n) {
      if (!supports_[n].components[axis]) continue;
      points.insert(points.end(), supports_[n].points.begin(), supports_[n].points.end());
      owners.insert(owners.end(), supports_[n].points.size(), n);
    }
    responses_[axis].assign(supports_.size(), Vector3::Zero());
    if (points.empty()) return;
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixX3d places(count, 3);
    for (Eigen::Index k = 0; k < count; ++k) places.row(k) = points[static_cast<std::size_t>(k)];
    places.rowwise() -= places.colwise().mean().eval();
    scatter_ = places.transpose() * places;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solution;
    solution.setThreshold(support_rank_tolerance);
    solution.compute(places);
    for (std::size_t n = 0; n < supports_.size(); ++n) {
      Eigen::VectorXd values(count);
      for (Eigen::Index k = 0; k < count; ++k)
        values[k] = owners[static_cast<std::size_t>(k)] == n ? 1.0 : 0.0;
      values.array() -= values.mean();
      responses_[axis][n] = solution.solve(values);
    }
  }

  void turn_normal(Eigen::Matrix3d& gradient) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter_);
    const Vector3& spread = axes.eigenvalues();
    const double flat = support_rank_tolerance * spread[2];
    if (!(spread[0] <= flat && spread[1] > flat)) return;
    const Vector3 normal = axes.eigenvectors().col(0), first = axes.eigenvectors().col(1);
    const Vector3 second = normal.cross(first);
    const Vector3 turned = (gradient * first).cross(gradient * second).normalized();
    gradient += (turned - gradient * normal) * normal.transpose();
  }

  std::vector<SupportedPoints> supports_;
  std::array<std::vector<Vector3>, 3> responses_;
  Eigen::Matrix3d scatter_ = Eigen::Matrix3d::Zero();  ///< of the points held along the last axis
  bool held_alike_ = true;                             ///< all of them in all components
};

}  // namespace

void warn_of_turned_support(const Scene& scene, std::size_t index, const BlockModel& block,
                            Diagnostics& diagnostics) {
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental) return;
  if (!block.driven() || block.space().can_turn() || block.material().elasticity != Elasticity::linear)
    return;
  const SceneBlock& given = scene.block[index];
  const SupportedFrame frame(supported_points(given, block.solid()));
  double most = 0.0;
  std::size_t widest = 0;
  for (std::size_t n = 0; n < given.fix.size(); ++n) {
    for (const SceneFix::Motion& row : given.fix[n].history) {
      const double turn = frame.turn_at(std::clamp(row.time, 0.0, scene.analysis.end_time));
      if (turn > most) widest = n;
      most = std::max(most, turn);
    }
  }
  if (most <= largest_ordinary_turn) return;
  const char* key = history_key(given.fix[widest]);
  diagnostics.warning(
      scene.places.value(fmt::format("block.{}.fix.{}.{}", index, widest, key)),
      fmt::format("{} turns block \"{}\" by {:.3g} rad, which strains it: elasticity "
                  "\"linear\" does not turn with a block that is held, \"st-venant-kirchhoff\" does",
                  key, block.name(), most));
}

}  // namespace ashlar
