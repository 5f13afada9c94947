#include "solver/statics/support_movement.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/statics/followed_blocks.hpp"
#include "solver/statics/thrust.hpp"
#include "solver/statics/yielding_support.hpp"

namespace ashlar {
namespace {

/// Characteristic lengths of a path (notes/limit_analysis.md).
struct PathLengths {
  PathLengths(double smallest_block, double contact_distance)
      : reach(std::clamp(contact_distance, 0.05 * smallest_block, 0.2 * smallest_block)) {}

  double reach;                        ///< m, largest gap of detected points
  double farthest = 0.5 * reach;       ///< m, largest displacement of a block in a step: two blocks cannot
                                       ///< meet undetected
  double longest_step = 0.25 * reach;  ///< m, of the support
  double closed = 1e-4 * reach;        ///< m, motion below which closing of gaps ends
};
constexpr int most_closings = 30;
constexpr int most_unknown_steps = 10;  ///< undetermined steps within the tolerance
/// Programmes of a path: ends a path that halves its step indefinitely.
constexpr int most_programmes = 50000;

enum class StepEnd { equilibrium, jammed, unbalanced, far, undetermined };

/// Gaps relative to a length, by point of a model, limited to a thousand: programmes lose digits by shifts of very
/// different sizes. Forces across larger gaps are detected when gaps are closed.
std::vector<double> gaps_over(const RigidModel& model, double length) {
  constexpr double farthest = 1e3;
  std::vector<double> gaps;
  gaps.reserve(model.points.size());
  for (const RigidPoint& point : model.points) gaps.push_back(std::min(point.contact.gap / length, farthest));
  return gaps;
}

std::vector<BodyVelocity> times(double factor, std::vector<BodyVelocity> way) {
  for (BodyVelocity& v : way) v *= factor;
  return way;
}

/// True if forces of all points in reach cannot balance the loads: the squared motion by Gauss's principle exceeds
/// the gap between its primal and dual values.
bool moves(ConeProgram& program, const std::vector<BodyVelocity>& load) {
  constexpr double certain = 10.0;
  ConeQuestion question;
  question.load = load;
  const ConeAnswer answer = program.solve(question);
  double square = 0.0;
  for (const BodyVelocity& v : answer.velocity) square += v.squaredNorm();
  return answer.status == ConeStatus::solved && square > certain * answer.gap;
}

/// Path of a support in one direction.
class Path {
 public:
  /// @param sign 1: along its coordinate, -1: against it
  Path(const FollowedBlocks& blocks, const SupportWay& way, int support, double sign,
       const PathLengths& lengths, int threads)
      : blocks_(blocks),
        way_(way),
        support_(support),
        sign_(sign),
        lengths_(lengths),
        threads_(threads),
        placement_(blocks.as_placed()) {}

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
    if (const auto ahead = predict(std::min(search.tolerance, lengths_.longest_step)))
      path_.places.push_back({moved(), ahead->thrust});
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

  /// Moves from equilibrium to equilibrium until the search ends.
  void take_steps(const MovementSearch& search) {
    path_.end = MovementEnd::reaches_limit;
    double step = lengths_.longest_step;
    int unknown = 0;
    while (search.limit > moved()) {
      if (!search.goes_on()) {
        path_.end = MovementEnd::interrupted;
        return;
      }
      step = std::min(step, search.limit - moved());
      const StepEnd end = path_.programmes < most_programmes ? advance(step) : StepEnd::undetermined;
      if (end == StepEnd::equilibrium) {
        path_.upper.reset();
        path_.end = MovementEnd::reaches_limit;
        step = std::min(lengths_.longest_step, next_step(step, 2.0));
        continue;
      }
      note_end(end, step, search.tolerance);
      const bool narrow = step <= search.tolerance;
      const bool known = narrow && path_.upper && *path_.upper - moved() <= 2.0 * search.tolerance;
      // Rounding differs beside an undetermined place.
      if (known || (narrow && ++unknown > most_unknown_steps) || path_.programmes >= most_programmes) {
        if (!path_.upper) path_.end = MovementEnd::not_determined;
        return;
      }
      step = narrow ? 0.5 * step : std::max(next_step(step, 0.5), 0.5 * search.tolerance);
    }
  }

  /// Records an end. Too large a motion is conclusive only if the step is within the tolerance, the other ends always
  /// are.
  void note_end(StepEnd end, double step, double tolerance) {
    if (end == StepEnd::undetermined || (end == StepEnd::far && step > tolerance)) return;
    path_.upper = moved() + step;
    path_.end = end == StepEnd::jammed ? MovementEnd::jams : MovementEnd::collapses;
  }

  /// Length in proportion to the displacement of blocks in the last step. @param most factor
  [[nodiscard]] double next_step(double step, double most) const {
    constexpr double margin = 0.8, least = 0.1;
    return step * std::clamp(margin * lengths_.farthest / std::max(last_way_, 1e-300), least, most);
  }

  /// Continues from an equilibrium.
  void settle_at(FollowedPlace placement) {
    placement_ = std::move(placement);
    model_ = blocks_.model_of(placement_);
    program_.emplace(program_at(*model_, placement_.moved));
  }

  /// @param q of the support, m
  [[nodiscard]] ConeProgram program_at(const RigidModel& model, double q) const {
    const SupportVelocity velocity = [this, q](const RigidPoint& point) { return way_.velocity(point, q); };
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
    velocity_ = answer.velocity;
    return Prediction{answer.velocity, -sign_ * answer.factor * model_->units.force()};
  }

  /// The motion of a step by the directions at its middle: hinges stay in place to third order of the rotation, while
  /// they would drift along their joints otherwise. @param way m, by the directions at its start
  std::vector<BodyVelocity> half_way(double step, std::vector<BodyVelocity> way) {
    const RigidModel mid = midway(*model_, *program_, way);
    ConeProgram program = program_at(mid, placement_.moved + 0.5 * sign_ * step);
    ConeQuestion question = question_of_support(mid, sign_);
    question.shift = gaps_over(*model_, step);
    const ConeAnswer answer = program.solve(question);
    ++path_.programmes;
    // If there is none, the first directions are used, and remaining gaps are closed later.
    if (!is_balanced(answer) || boundless(question, answer)) return way;
    return times(step, answer.velocity);
  }

  StepEnd advance(double step) {
    const std::optional<Prediction> ahead = predict(step);
    last_way_ = 0.0;
    if (!ahead) return failed_;
    const std::vector<BodyVelocity> way = half_way(step, times(step, ahead->velocity));
    const double farthest = last_way_ = blocks_.largest_way(*model_, way);
    if (!(farthest <= lengths_.farthest)) return StepEnd::far;
    FollowedPlace next = placement_;
    note_slip(*model_, *program_, way, force_, next);
    blocks_.move(*model_, way, next);
    blocks_.place_support(support_, way_, placement_.moved + sign_ * step, next);
    const StepEnd end = close(next, lengths_.farthest - farthest);
    if (end != StepEnd::equilibrium) return end;
    path_.places.push_back({moved(), ahead->thrust});
    settle_at(std::move(next));
    return end;
  }

  /// Repeats (close) until nothing moves. @param way m, allowed displacement of blocks
  StepEnd close(FollowedPlace& placement, double way) {
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
        return moves(program, model.steady) ? StepEnd::unbalanced : StepEnd::undetermined;
      const std::vector<BodyVelocity> motion = times(scale, answer.velocity);
      const double farthest = blocks_.largest_way(model, motion);
      way -= farthest;
      if (!(way >= 0.0)) return StepEnd::far;
      note_slip(model, program, motion, answer.force, placement);
      blocks_.move(model, motion, placement);
      if (farthest <= lengths_.closed) return StepEnd::equilibrium;
    }
    return StepEnd::undetermined;
  }

  /// Adds the slip in a motion of joints that transmit force. @param way m
  static void note_slip(const RigidModel& model, const ConeProgram& program,
                        const std::vector<BodyVelocity>& way, const std::vector<Eigen::Vector3d>& force,
                        FollowedPlace& placement) {
    constexpr double bears = 1e-3;  // of the largest force
    double largest = 0.0;
    for (const Eigen::Vector3d& f : force) largest = std::max(largest, f[0]);
    std::map<PairKey, double> slid;
    for (std::size_t n = 0; n < program.pairs().size(); ++n) {
      for (std::size_t k = program.pairs()[n].begin; k < program.pairs()[n].end; ++k) {
        if (!(force[k][0] > bears * largest)) continue;
        double& most = slid[key_of(model.points[k].blocks)];
        most = std::max(most, program.relative(n, k, way).tail<2>().norm());
      }
    }
    for (const auto& [blocks, slip] : slid) placement.slip[blocks] += slip;
  }

  void note_joints(const RigidModel& first) {
    constexpr double turned = 1e-4;  // rad
    std::map<PairKey, JointResultant> bearing;
    if (force_.size() == model_->points.size()) {
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
      const auto found = bearing.find(blocks);
      MovedJoint joint{blocks, found != bearing.end() ? found->second.place : place,
                       Eigen::AngleAxisd(relative).angle(),
                       slip != placement_.slip.end() ? slip->second : 0.0, found != bearing.end()};
      if (joint.rotation > turned || joint.slip > lengths_.closed) path_.joints.push_back(joint);
    }
  }

  /// Records the placement of blocks, and the moving ones.
  void finish() {
    path_.lower = moved();
    for (const BlockState& state : placement_.states) path_.positions.push_back(state.position);
    if (!model_ || velocity_.size() < model_->bodies.size()) return;
    constexpr double moves_along = 0.01;  // of the fastest
    const double largest = blocks_.largest_way(*model_, velocity_);
    std::set<int> moving;
    for (std::size_t b = 0; b < model_->bodies.size(); ++b) {
      std::vector<BodyVelocity> alone(model_->bodies.size(), BodyVelocity::Zero());
      alone[b] = velocity_[b];
      if (blocks_.largest_way(*model_, alone) > moves_along * largest)
        moving.insert(model_->bodies[b].blocks.begin(), model_->bodies[b].blocks.end());
    }
    path_.moving.assign(moving.begin(), moving.end());
  }

  const FollowedBlocks& blocks_;
  const SupportWay& way_;
  int support_;
  double sign_;
  PathLengths lengths_;
  int threads_;
  FollowedPlace placement_;
  std::optional<RigidModel> model_;     ///< at the placement
  std::optional<ConeProgram> program_;  ///< of it, with the support
  std::vector<Eigen::Vector3d> force_;  ///< of the last prediction, by point
  std::vector<BodyVelocity> velocity_;  ///< of the last prediction
  double last_way_ = 0.0;               ///< m, displacement of blocks by it
  StepEnd failed_ = StepEnd::undetermined;
  SupportPath path_;
};

}  // namespace

double extent_of(const RigidModel& model) {
  Eigen::AlignedBox3d box;
  for (const RigidPoint& point : model.points) box.extend(point.place);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<int> block_held_in_part(const RigidModel& model) {
  for (const RigidBody& body : model.bodies)
    if (body.freedom < 6) return body.blocks.front();
  return std::nullopt;
}

bool is_loaded(const RigidModel& model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.steady[b].norm() + model.multiplied[b].norm() > 0.0) return true;
  return false;
}

SupportMovement support_movement(const PlacedScene& scene, int support, const MovementSearch& search) {
  RunState placed;
  placed.states = scene.states;
  for (const auto& [blocks, history] : scene.histories) placed.pairs[blocks].overlap = history.overlap;
  const RigidModel model = rigid_model(scene.system, placed, scene.end_time, {});
  const std::vector<Bolt>& bolts = scene.system.bolts();
  if (std::any_of(bolts.begin(), bolts.end(), [](const Bolt& bolt) { return bolt.installed; }))
    throw std::invalid_argument("bolts and props do not follow movements of supports");
  if (block_held_in_part(model)) throw std::invalid_argument("supports hold a block in part");
  if (!is_loaded(model)) throw std::invalid_argument("no load acts");
  const SupportWay way(model, support, scene.system.settings().gravity_at(scene.end_time), search.direction);
  const PathLengths lengths(smallest_size(scene.system, model), scene.system.settings().contact_distance);
  const FollowedBlocks blocks(scene, lengths.reach);
  SupportMovement movement{support, way.direction(), {}, {}};
  movement.away = !search.direction && way.direction();
  movement.left_out_strength = std::any_of(
      model.points.begin(), model.points.end(),
      [](const RigidPoint& point) { return point.law.cohesion > 0.0 || point.law.tensile_strength > 0.0; });
  movement.out = Path(blocks, way, support, 1.0, lengths, scene.threads).follow(search);
  movement.in = Path(blocks, way, support, -1.0, lengths, scene.threads).follow(search);
  return movement;
}

const char* to_string(MovementEnd end) {
  switch (end) {
    case MovementEnd::collapses:
      return "collapses";
    case MovementEnd::jams:
      return "jams";
    case MovementEnd::reaches_limit:
      return "reaches-limit";
    case MovementEnd::not_balanced:
      return "not-balanced";
    case MovementEnd::not_determined:
      return "not-determined";
    case MovementEnd::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace ashlar
