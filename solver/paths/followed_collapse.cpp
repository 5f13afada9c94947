#include "solver/paths/followed_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/paths/followed_blocks.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

/// Steps that are followed: blocks go some sizes of the smallest one.
constexpr int most_steps = 100;
/// Programmes of a step until its length is within reach.
constexpr int most_lengths = 6;
/// Largest gap of points, and the motion of a step in which two blocks cannot meet undetected, in sizes of the smallest
/// block.
constexpr double reach_share = 0.2, step_share = 0.4 * reach_share;
/// Motion of blocks at rest, in those of a step.
constexpr double rest_share = 1e-4;

/// Blocks at one placement.
class CollapsePath {
 public:
  CollapsePath(const PlacedScene& scene, double smallest)
      : scene_(scene),
        blocks_(scene, reach_share * smallest),
        length_(step_share * smallest),
        placement_(blocks_.as_placed()) {}

  Collapse follow(double far) {
    for (int n = 0; n < most_steps; ++n) {
      const auto moved = step();
      if (!moved || *moved < rest_share * length_) {
        path_.end = moved ? CollapseEnd::rests : CollapseEnd::undecided;
        break;
      }
      note_displacements();
      if (*std::max_element(path_.displacements.begin(), path_.displacements.end()) >= far) {
        path_.end = CollapseEnd::goes_far;
        break;
      }
    }
    return std::move(path_);
  }

 private:
  /// Moves the blocks. @return m, the largest motion of any place; empty: unknown
  std::optional<double> step() {
    const RigidModel model = blocks_.model_of(placement_);
    ConeProgram program = program_of(model, scene_.threads);
    ConeQuestion question;
    question.load = model.steady;
    question.gap = 1e-9;
    double scale = last_scale_;  // displacement over acceleration, m
    for (int n = 0; n < most_lengths; ++n) {
      question.shift.clear();
      for (const RigidPoint& point : model.points)
        question.shift.push_back(std::clamp(point.contact.gap / scale, 0.0, largest_shift));
      const ConeAnswer answer = program.solve(question);
      ++path_.programmes;
      if (answer.status != ConeStatus::solved) return std::nullopt;
      std::vector<BodyVelocity> way = answer.velocity;
      for (BodyVelocity& v : way) v *= scale;
      const double farthest = blocks_.largest_way(model, way);
      const bool last = n + 1 == most_lengths;
      if (farthest > length_ || (farthest < 0.3 * length_ && scale < longest_scale() && !last)) {
        if (last) return std::nullopt;
        scale = std::min(longest_scale(),
                         scale * std::clamp(0.8 * length_ / std::max(farthest, 1e-300), 1e-4, 1e4));
        continue;
      }
      last_scale_ = scale;
      blocks_.move(model, way, placement_);
      return farthest;
    }
    return std::nullopt;
  }

  /// Accelerations of 1e-4 of their unit move blocks by a step.
  [[nodiscard]] double longest_scale() const { return 1e4 * length_; }

  void note_displacements() {
    path_.displacements.assign(placement_.states.size(), 0.0);
    for (std::size_t k = 0; k < placement_.states.size(); ++k) {
      const BlockModel& block = scene_.system.blocks()[k];
      if (block.fixed() || !scene_.system.present(static_cast<int>(k))) continue;
      const Eigen::MatrixX3d way = placement_.states[k].position - scene_.states[k].position;
      path_.displacements[k] =
          Vector3(way.transpose() * block.basis().values(block.basis().centroid())).norm() /
          block_size(block);
    }
  }

  static constexpr double largest_shift = 1e3;

  const PlacedScene& scene_;
  FollowedBlocks blocks_;
  double length_;  ///< m, of a step
  FollowedPlace placement_;
  double last_scale_ = 1e-2 * length_;
  Collapse path_;
};

}  // namespace

Collapse follow_collapse(const PlacedScene& scene, double far) {
  double smallest = 0.0;
  for (std::size_t k = 0; k < scene.system.blocks().size(); ++k) {
    const BlockModel& block = scene.system.blocks()[k];
    if (block.fixed() || !scene.system.present(static_cast<int>(k))) continue;
    const double size = block_size(block);
    smallest = smallest > 0.0 ? std::min(smallest, size) : size;
  }
  return smallest > 0.0 ? CollapsePath(scene, smallest).follow(far) : Collapse{CollapseEnd::rests, {}, 0};
}

}  // namespace ashlar
