#include "solver/paths/support_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/exact/axis_rotation.hpp"
#include "geometry/index.hpp"
#include "solver/paths/thrust.hpp"

namespace ashlar {
namespace {

constexpr int most_closings = 30;
constexpr int most_unknown_steps = 10;  ///< undetermined steps within the tolerance
/// Programmes of a path: ends a path that halves its step indefinitely.
constexpr int most_programmes = 50000;
/// Reach in sizes of the smallest block, at least: smaller contact distances would need too many steps.
constexpr double least_reach_share = 0.05;
/// Displacement of blocks that the next step aims at, of the largest one allowed, and the least length of a step over the
/// last one: a larger aim has more steps that go too far, a smaller one more steps.
constexpr double aimed_displacement = 0.8, least_growth = 0.1;
/// Ratio of steps from which forces of the last placement are sought: smaller ones repeat the same rounding errors.
constexpr double longer_probe = 4.0;
/// Share of its friction with which the joint that slides first moves: nearer to 1 the order of slip is undetermined again
/// (notes/limit_analysis.md).
constexpr double friction_of_first = 0.5;
/// Rotation of a joint that is reported, rad: less is that of rounding.
constexpr double least_joint_rotation = 1e-4;

enum class StepEnd { equilibrium, jammed, unbalanced, far, undetermined };

/// Path of a support in one direction.
class Path {
 public:
  explicit Path(const SupportStart& start)
      : blocks_(start.blocks),
        movement_law_(start.movement_law),
        support_(start.support),
        sign_(start.sign),
        lengths_(start.lengths),
        threads_(start.threads),
        slides_first_(start.slides_first),
        placement_(blocks_.as_placed()) {}

  SupportPath follow(const MovementSearch& search) {
    // Blocks may be apart by less than the contact distance: these gaps are closed first.
    const StepEnd start = close(placement_, lengths_.reach);
    if (start != StepEnd::equilibrium) {
      path_.end = start == StepEnd::undetermined ? MovementEnd::not_determined : MovementEnd::not_balanced;
      finish();
      return std::move(path_);
    }
    settle_at(placement_);
    const RigidModel first = *model_;
    take_steps(search);
    note_last_place(std::min(search.tolerance, lengths_.longest_step));
    note_joints(first);
    finish();
    return std::move(path_);
  }

 private:
  struct Prediction {
    std::vector<BodyVelocity> velocity;  ///< of bodies, then of the support, per m of the step
    double thrust;                       ///< N
  };

  [[nodiscard]] double moved() const { return std::abs(placement_.moved); }

  /// Records the thrust and the forces of the last placement. Rounding may leave those of a short step undetermined: longer
  /// ones are tried. @param step m
  void note_last_place(double step) {
    std::optional<Prediction> ahead = predict(step);
    while (!ahead && failed_ == StepEnd::undetermined && step < lengths_.longest_step) {
      step = std::min(longer_probe * step, lengths_.longest_step);
      ahead = predict(step);
    }
    if (ahead)
      path_.places.push_back({moved(), ahead->thrust});
    else
      force_.clear();  // of an earlier placement
  }

  /// Moves from equilibrium to equilibrium until the search ends.
  void take_steps(const MovementSearch& search) {
    path_.end = MovementEnd::reaches_limit;
    double step = lengths_.longest_step;
    int unknown = 0;
    while (search.limit > moved()) {
      if (!search.may_continue()) {
        path_.end = MovementEnd::interrupted;
        return;
      }
      step = std::min(step, search.limit - moved());
      const StepEnd end = path_.programmes < most_programmes ? advance(step) : StepEnd::undetermined;
      if (end == StepEnd::equilibrium) {
        path_.upper.reset();
        path_.end = MovementEnd::reaches_limit;
        step = std::min(lengths_.longest_step, lengths_.next_step(step, last_travel_, 2.0));
        continue;
      }
      note_end(end, step, search.tolerance);
      const bool narrow = step <= search.tolerance;
      const bool bracketed = narrow && path_.upper && *path_.upper - moved() <= 2.0 * search.tolerance;
      // Rounding differs beside an undetermined place.
      if (bracketed || (narrow && ++unknown > most_unknown_steps) || path_.programmes >= most_programmes) {
        if (!path_.upper) path_.end = MovementEnd::not_determined;
        return;
      }
      step =
          narrow ? 0.5 * step : std::max(lengths_.next_step(step, last_travel_, 0.5), 0.5 * search.tolerance);
    }
  }

  /// Records an end. Too large a motion is conclusive only if the step is within the tolerance, the other ends always
  /// are.
  void note_end(StepEnd end, double step, double tolerance) {
    if (end == StepEnd::undetermined || (end == StepEnd::far && step > tolerance)) return;
    path_.upper = moved() + step;
    path_.end = end == StepEnd::jammed ? MovementEnd::jams : MovementEnd::collapses;
  }

  /// The model whose motion is that of a step: of an equal one, the joint that slides first has less friction.
  [[nodiscard]] RigidModel yielding(RigidModel model) const {
    for (RigidPoint& point : model.points)
      if (key_of(point.blocks) == slides_first_) point.law.friction *= friction_of_first;
    return model;
  }

  /// Continues from an equilibrium.
  void settle_at(FollowedPlace placement) {
    placement_ = std::move(placement);
    model_ = blocks_.model_of(placement_);
    program_.emplace(program_at(*model_, placement_.moved));
  }

  /// @param q of the support, m
  [[nodiscard]] ConeProgram program_at(const RigidModel& model, double q) const {
    const SupportVelocity velocity = [this, q](const RigidPoint& point) {
      return movement_law_.velocity(point, q);
    };
    return program_with_support(model, support_, velocity, threads_);
  }

  /// Solves (step). @return empty: the support cannot move against the structure, or the reason is in `failed_`
  std::optional<Prediction> predict(double step) {
    ConeQuestion question = question_of_support(*model_, sign_);
    question.shift = gaps_over(*model_, step);
    const ConeAnswer answer = program_->solve(question);
    ++path_.programmes;
    failed_ = !is_balanced(answer)          ? StepEnd::undetermined
              : boundless(question, answer) ? StepEnd::jammed
                                            : StepEnd::equilibrium;
    if (failed_ != StepEnd::equilibrium) return std::nullopt;
    force_ = answer.force;
    velocity_ =
        slides_first_ ? velocity_of_step(*model_, 0.0, step).value_or(answer.velocity) : answer.velocity;
    return Prediction{velocity_, -sign_ * answer.factor * model_->units.force()};
  }

  /// Motion per m of a step by a model that is `ahead` of the placement, m. Empty: it has none
  std::optional<std::vector<BodyVelocity>> velocity_of_step(const RigidModel& model, double ahead,
                                                            double step) {
    ConeProgram program = program_at(yielding(model), placement_.moved + ahead);
    ConeQuestion question = question_of_support(model, sign_);
    question.shift = gaps_over(*model_, step);
    ConeAnswer answer = program.solve(question);
    ++path_.programmes;
    if (!is_balanced(answer) || boundless(question, answer)) return std::nullopt;
    return std::move(answer.velocity);
  }

  /// The motion of a step by the directions at its middle: hinges stay in place to third order of the rotation, while
  /// they would drift along their joints otherwise. @param travel m, by the directions at its start
  std::vector<BodyVelocity> half_travel(double step, const std::vector<BodyVelocity>& travel) {
    const RigidModel mid = midway(*model_, *program_, travel);
    // If there is none, the first directions are used, and remaining gaps are closed later.
    const auto velocity = velocity_of_step(mid, 0.5 * sign_ * step, step);
    return velocity ? times(step, *velocity) : travel;
  }

  StepEnd advance(double step) {
    const std::optional<Prediction> ahead = predict(step);
    last_travel_ = 0.0;
    if (!ahead) return failed_;
    const std::vector<BodyVelocity> travel = half_travel(step, times(step, ahead->velocity));
    const double farthest = last_travel_ = blocks_.largest_travel(*model_, travel);
    if (!(farthest <= lengths_.farthest)) return StepEnd::far;
    FollowedPlace next = placement_;
    note_slip(*model_, *program_, travel, force_, next);
    blocks_.move(*model_, travel, next);
    blocks_.place_support(support_, movement_law_, placement_.moved + sign_ * step, next);
    const StepEnd end = close(next, lengths_.farthest - farthest);
    if (end != StepEnd::equilibrium) return end;
    path_.places.push_back({moved(), ahead->thrust});
    settle_at(std::move(next));
    return end;
  }

  /// Repeats (close) until nothing moves. @param travel m, allowed displacement of blocks
  StepEnd close(FollowedPlace& placement, double travel) {
    for (int n = 0; n < most_closings; ++n) {
      const RigidModel model = blocks_.model_of(placement);
      ConeProgram program = program_of(model, threads_);
      double scale = lengths_.closed;
      for (const RigidPoint& point : model.points) scale = std::max(scale, std::abs(point.contact.gap));
      ConeQuestion question;
      question.load = model.steady;
      question.shift = gaps_over(model, scale);
      question.balanced = true;
      const ConeAnswer answer = program.solve(question);
      ++path_.programmes;
      if (!is_balanced(answer))
        return cannot_balance(program, model.steady) ? StepEnd::unbalanced : StepEnd::undetermined;
      const std::vector<BodyVelocity> motion = times(scale, answer.velocity);
      const double farthest = blocks_.largest_travel(model, motion);
      travel -= farthest;
      if (!(travel >= 0.0)) return StepEnd::far;
      note_slip(model, program, motion, answer.force, placement);
      blocks_.move(model, motion, placement);
      if (farthest <= lengths_.closed) return StepEnd::equilibrium;
    }
    return StepEnd::undetermined;
  }

  /// Adds the slip in a motion of joints that transmit force. @param travel m
  static void note_slip(const RigidModel& model, const ConeProgram& program,
                        const std::vector<BodyVelocity>& travel, const std::vector<Eigen::Vector3d>& force,
                        FollowedPlace& placement) {
    double largest = 0.0;
    for (const Eigen::Vector3d& f : force) largest = std::max(largest, f[0]);
    std::map<PairKey, double> slid;
    for (std::size_t n = 0; n < program.pairs().size(); ++n) {
      for (std::size_t k = program.pairs()[n].begin; k < program.pairs()[n].end; ++k) {
        if (!(force[k][0] > point_bears * largest)) continue;
        double& most = slid[key_of(model.points[k].blocks)];
        most = std::max(most, program.relative(n, k, travel).tail<2>().norm());
      }
    }
    for (const auto& [blocks, slip] : slid) placement.slip[blocks] += slip;
  }

  void note_joints(const RigidModel& first) {
    std::map<PairKey, JointResultant> bearing;
    if (force_.size() == model_->points.size()) {
      path_.contacts = contact_records(*model_, in_newtons(*model_, force_));
      for (const JointResultant& joint : joint_resultants(*model_, forces_of(*model_, force_)))
        bearing.emplace(key_of(joint.blocks), joint);
    }
    std::map<PairKey, Vector3> places;
    for (const RigidModel* model : {&first, static_cast<const RigidModel*>(&*model_)})
      for (const RigidPoint& point : model->points) places[key_of(point.blocks)] = point.place;
    for (const auto& [blocks, place] : places) {
      const Eigen::Matrix3d relative =
          placement_.turn[at(blocks[0])].transpose() * placement_.turn[at(blocks[1])];
      const auto slip = placement_.slip.find(blocks);
      const auto resultant = bearing.find(blocks);
      MovedJoint joint{blocks, resultant != bearing.end() ? resultant->second.place : place,
                       rotation_vector(relative).norm(), slip != placement_.slip.end() ? slip->second : 0.0,
                       resultant != bearing.end()};
      if (joint.rotation > least_joint_rotation || joint.slip > lengths_.closed)
        path_.joints.push_back(joint);
    }
  }

  /// Records the placement of blocks, and the moving ones.
  void finish() {
    path_.lower = moved();
    for (const BlockState& state : placement_.states) path_.positions.push_back(state.position);
    if (!model_ || velocity_.size() < model_->bodies.size()) return;
    path_.moving = blocks_.moving_blocks(*model_, velocity_);
  }

  const FollowedBlocks& blocks_;
  const MovementLaw& movement_law_;
  int support_;
  double sign_;
  PathLengths lengths_;
  int threads_;
  std::optional<PairKey> slides_first_;
  FollowedPlace placement_;
  std::optional<RigidModel> model_;     ///< at the placement
  std::optional<ConeProgram> program_;  ///< of it, with the support
  std::vector<Eigen::Vector3d> force_;  ///< of the last prediction, by point
  std::vector<BodyVelocity> velocity_;  ///< of the last prediction
  double last_travel_ = 0.0;            ///< m, displacement of blocks by it
  StepEnd failed_ = StepEnd::undetermined;
  SupportPath path_;
};

}  // namespace

PathLengths::PathLengths(double smallest_block, double contact_distance)
    : reach(std::clamp(contact_distance, least_reach_share * smallest_block,
                       largest_reach_share * smallest_block)) {}

double PathLengths::next_step(double step, double moved, double most) const {
  return step *
         std::clamp(aimed_displacement * farthest / std::max(moved, least_displacement), least_growth, most);
}

SupportPath path_of(const SupportStart& start, const MovementSearch& search) {
  return Path(start).follow(search);
}

}  // namespace ashlar
