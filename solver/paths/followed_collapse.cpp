#include "solver/paths/followed_collapse.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/paths/followed_blocks.hpp"

namespace ashlar {
namespace {

/// Steps that are followed: blocks go some sizes of the smallest one.
constexpr int most_steps = 100;
/// Programmes of a step until its length is within reach.
constexpr int most_lengths = 6;
/// The motion of a step in which two blocks cannot meet undetected, in sizes of the smallest block.
constexpr double step_share = 0.4 * largest_reach_share;
/// Motion of blocks at rest, in those of a step.
constexpr double rest_share = 1e-4;
/// Motion of a step that is repeated as too short, and the one that the next trial aims at, of the longest one: a larger
/// aim has more trials that go too far.
constexpr double short_motion = 0.3, aimed_motion = 0.8;
/// Displacement over acceleration, in motions of a step: at first, and at most, where accelerations of 1e-4 of their unit
/// move blocks by a step; ratio of successive ones at most.
constexpr double first_scale = 1e-2, longest_scale = 1e4, most_scale_ratio = 1e4;
/// Gap of programmes relative to the loads (cone_program.hpp): larger ones blur motion near rest.
constexpr double gap_of_collapse = 1e-9;

/// Blocks at one placement.
class CollapsePath {
 public:
  CollapsePath(const PlacedScene& scene, double smallest)
      : scene_(scene),
        blocks_(scene, largest_reach_share * smallest),
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
    question.gap = gap_of_collapse;
    double scale = last_scale_;  // displacement over acceleration, m
    for (int n = 0; n < most_lengths; ++n) {
      question.shift.clear();
      for (const RigidPoint& point : model.points)
        question.shift.push_back(std::clamp(point.contact.gap / scale, 0.0, largest_shift));
      const ConeAnswer answer = program.solve(question);
      ++path_.programmes;
      if (answer.status != ConeStatus::solved) return std::nullopt;
      std::vector<BodyVelocity> motion = answer.velocity;
      for (BodyVelocity& v : motion) v *= scale;
      const double farthest = blocks_.largest_travel(model, motion);
      const double longest = longest_scale * length_;
      const bool last = n + 1 == most_lengths;
      if (farthest > length_ || (farthest < short_motion * length_ && scale < longest && !last)) {
        if (last) return std::nullopt;
        scale = std::min(longest,
                         scale * std::clamp(aimed_motion * length_ / std::max(farthest, least_displacement),
                                            1.0 / most_scale_ratio, most_scale_ratio));
        continue;
      }
      last_scale_ = scale;
      blocks_.move(model, motion, placement_);
      return farthest;
    }
    return std::nullopt;
  }

  void note_displacements() {
    path_.displacements.assign(placement_.states.size(), 0.0);
    for (std::size_t k = 0; k < placement_.states.size(); ++k) {
      const BlockModel& block = scene_.system.blocks()[k];
      if (block.fixed() || !scene_.system.present(static_cast<int>(k))) continue;
      const Eigen::MatrixX3d displacement = placement_.states[k].position - scene_.states[k].position;
      path_.displacements[k] =
          Vector3(displacement.transpose() * block.basis().values(block.basis().centroid())).norm() /
          block.size();
    }
  }

  const PlacedScene& scene_;
  FollowedBlocks blocks_;
  double length_;  ///< m, of a step
  FollowedPlace placement_;
  double last_scale_ = first_scale * length_;
  Collapse path_;
};

}  // namespace

Collapse follow_collapse(const PlacedScene& scene, double far) {
  double smallest = 0.0;
  for (std::size_t k = 0; k < scene.system.blocks().size(); ++k) {
    const BlockModel& block = scene.system.blocks()[k];
    if (block.fixed() || !scene.system.present(static_cast<int>(k))) continue;
    const double size = block.size();
    smallest = smallest > 0.0 ? std::min(smallest, size) : size;
  }
  return smallest > 0.0 ? CollapsePath(scene, smallest).follow(far) : Collapse{CollapseEnd::rests, {}, 0};
}

}  // namespace ashlar
