// Rigid blocks on elastic joints followed along a path of loads and strengths, with Coulomb friction that does not
// dilate: what a slow test of the structure would show.
//
// Friction of blocks that wedge each other has several equilibria for the same loads. Which one holds depends on the
// forces that joints have, and these on the path. It is
//   load      the blocks come to rest under their first loads, from joints without force; then the multiplied loads grow
//   strength  the blocks come to rest under all loads with joints that neither slide nor tear; then strengths fall
// Forces of one state are the start of the next one. A state is at rest if the forces of its joints balance its loads.
// Blocks that yield by more than the allowed displacement, counted from the start of the path, do not stand, wherever
// they would come to rest. Places of joints are those of the model throughout: the allowed displacement is small.
//
// Between two states blocks move slowly, without inertia (spring_step.hpp): steps of increasing length, until rest or
// beyond the allowed displacement.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "solver/limit/limit_trial.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/paths/spring_step.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// Allowed displacement over BlockModel::size(), if none is given.
inline constexpr double allowed_displacement_share = 0.01;

/// Displacements from which on blocks are not at rest where they are placed, by body, m; infinite: a body without blocks.
[[nodiscard]] std::vector<double> displacements_of_rest(const BlockSystem& system, const RigidModel& model);

/// Forces of joints, and the way from the start of the path.
struct PathState {
  std::vector<Eigen::Vector3d> force;  ///< by point, in units of the model
  std::vector<BodyVelocity> moved;     ///< by body, m
  double displacement = 0.0;           ///< m, the largest of any body, at its joints or centre of gravity
};

struct PathTrial {
  LimitOutcome outcome = LimitOutcome::unknown;
  PathState end;
  std::vector<BodyVelocity> travel;  ///< of the last step, for a trial that moves
  std::vector<SpringState> states;   ///< by point
  int iterations = 0;
};

class LoadPath {
 public:
  /// @param model with springs (RigidPointKind::springs). @param reduced true for joints of two blocks whose strength is
  /// divided. @param allowed displacement by body, m, > 0; infinite: any
  LoadPath(RigidModel model, const std::function<bool(int, int)>& reduced, std::vector<double> allowed);

  [[nodiscard]] const RigidModel& model() const { return model_; }
  /// True for joints whose strength is divided, by point of the model.
  [[nodiscard]] const std::vector<bool>& reduced() const { return reduced_; }

  /// Joints without force but for the pretension of bars.
  [[nodiscard]] PathState unloaded() const;
  /// From one state to rest under other factors, or to motion.
  /// @param cap Pa, > 0, compressive strength of all joints, whose own one is not used
  [[nodiscard]] PathTrial to(const PathState& start, const LimitFactors& factors,
                             double cap = std::numeric_limits<double>::infinity());

  /// Pa, the largest pressure at a point. @return 0: nothing is pressed
  [[nodiscard]] double largest_pressure(const PathState& state) const;
  /// Blocks of the joint with the largest force at points under at least a pressure, Pa; {-1, -1}: none.
  [[nodiscard]] PairKey most_pressed(const PathState& state, double pressure) const;

  /// Pairs of blocks whose joint transmits at least a hundredth of the largest force of a joint at `rest`, and slides or
  /// opens at all its points in `trial`.
  [[nodiscard]] std::vector<PairKey> yielding_joints(const PathState& rest, const PathTrial& trial) const;

  /// The motion of a trial that moves, as a trial of limit analysis of this model: its accelerations from the forces at
  /// the end, or if there are none its slow motion.
  [[nodiscard]] LimitTrial motion_of(const PathTrial& trial, const LimitFactors& factors);
  /// The programme of the model, with the strengths of the last trial.
  [[nodiscard]] const ConeProgram& program() const { return program_; }

 private:
  void set_strengths(double factor, double cap);
  [[nodiscard]] std::vector<BodyVelocity> load(double factor) const;
  /// Sets the displacement of a state. @return the largest share of what is allowed
  double note_displacement(PathState& state) const;

  RigidModel model_;
  std::vector<bool> reduced_;    ///< by point
  std::vector<double> allowed_;  ///< by body
  ConeProgram program_;
  SpringStep step_;
};

}  // namespace ashlar
