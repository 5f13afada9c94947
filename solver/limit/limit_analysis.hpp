// Limit analysis: the factor on strengths or loads beyond which rigid blocks no longer stand. It needs seconds where
// an elastic analysis needs minutes.
//
// Sliding joints open by less than their friction angle requires (by their dilation angle), and such joints have two
// limits (notes/limit_analysis.md):
//   associated  the largest factor for which forces in balance exist. It is found by cone programmes and proved by
//     forces below it and a motion above it. Nothing stands above it. For blocks that wedge each other it relies on
//     forces that may not be present.
//   released    the least factor for which a motion was found that starts from rest without contact forces and
//     obeys Coulomb's law (released_motion.hpp). A motion that is found proves itself. That there is none below is
//     the result of a search only: from motions at larger factors, from motion without friction, and from each body
//     alone. It is the one for design.
// Joints that crush have parts (crushing_joints.hpp): a trial stands by forces at their centroids and moves by velocities
// at their corners. Where neither is so, parts are divided.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/limit/crushing_joints.hpp"
#include "solver/limit/limit_motion.hpp"
#include "solver/limit/limit_trial.hpp"
#include "solver/limit/pulled_joints.hpp"
#include "solver/limit/rigid_model.hpp"
#include "solver/limit/single_bodies.hpp"

namespace ashlar {

struct LimitAnswer {
  LimitBracket associated;
  LimitBracket released;
  /// Blocks that move at released.lower while all others are held, as far as found: pressure of others supports them.
  std::vector<int> kept_by_others;
  bool interrupted = false;
  std::vector<LimitTrial> trials;  ///< in order, without motions and forces
};

class LimitAnalysis {
 public:
  using Chosen = std::function<bool(int, int)>;

  /// @param reduced true for joints of two blocks whose strength is divided. @param threads >= 1
  LimitAnalysis(RigidModel model, const Chosen& reduced, int threads);
  /// @param reduced the same, by point of the model
  LimitAnalysis(RigidModel model, std::vector<bool> reduced, int threads);

  [[nodiscard]] const RigidModel& model() const { return model_; }
  /// True for joints whose strength is divided, by point of the model.
  [[nodiscard]] const std::vector<bool>& reduced() const { return reduced_; }
  /// Uses the parts of joints that crush as they are, on the safe side.
  void keep_parts() { divides_ = false; }

  /// Computes forces within the strengths that balance the loads, or the motion that proves that there are none.
  [[nodiscard]] LimitTrial associated(const LimitFactors& factors);
  /// Searches for a motion from rest without contact forces that obeys Coulomb's law.
  /// @param tolerance of the factor: distance from the limit within which the result is needed
  /// @param known a motion under other factors, tried first; null: none
  /// @param balanced true if forces in balance are known to exist: they are not computed
  [[nodiscard]] LimitTrial released(const LimitFactors& factors, double tolerance = 1e-3,
                                    const LimitTrial* known = nullptr, bool balanced = false);

  /// The largest factor of the multiplied loads for which forces in balance exist, by one programme.
  /// @param most upper bound of the search, > 0. @return 0: not found
  [[nodiscard]] double most_that_stands(double most);
  /// Blocks found to move while all others are held.
  [[nodiscard]] std::vector<int> moving_alone(const LimitFactors& factors, double tolerance);

  /// Motion at a factor below the associated limit that was found otherwise, by that limit: accelerations by body. Empty:
  /// none
  using OtherMotion = std::function<std::optional<LimitTrial>(const LimitBracket& associated)>;

  /// The factor by which strengths of the chosen joints may be divided. @param may_continue called before each trial;
  /// false ends the search. @param other called once, before released motions are searched; empty: none
  [[nodiscard]] LimitAnswer strength_factor(const LimitSearch& search,
                                            const std::function<bool()>& may_continue,
                                            const OtherMotion& other = {});
  /// The factor by which the chosen loads may be multiplied, with the others unchanged.
  [[nodiscard]] LimitAnswer load_factor(const LimitSearch& search, const std::function<bool()>& may_continue,
                                        const OtherMotion& other = {});

  /// The motion of a trial that moves; for an associated one the motion without dilation, if one is found.
  [[nodiscard]] LimitMotion motion_of(const LimitTrial& trial);

 private:
  /// @param use of joints with tensile strength; empty: as chosen for the last trial that stands
  void set_factors(const LimitFactors& factors, std::optional<JointUse> use = std::nullopt);
  [[nodiscard]] LimitTrial balanced(const LimitFactors& factors);
  /// Chooses the use of joints by forces within all of them. @return true if it has changed
  bool choose_uses(const LimitFactors& factors, const std::vector<Eigen::Vector3d>& force);
  [[nodiscard]] double most_balanced(const ConeQuestion& question);
  [[nodiscard]] std::vector<BodyVelocity> load(double factor) const;
  [[nodiscard]] ConeProgram& program(FrictionAt friction) {
    return friction == FrictionAt::corners ? program_ : bound_;
  }
  [[nodiscard]] LimitTrial balanced_by(ConeProgram& program, const LimitFactors& factors) const;
  [[nodiscard]] LimitTrial decided(FrictionAt friction, const LimitFactors& factors);
  [[nodiscard]] ConeProgram above(FrictionAt friction, const LimitFactors& factors) const;
  bool divide(FrictionAt friction, const ConeProgram& above, const std::vector<BodyVelocity>& velocity);
  [[nodiscard]] double most_that_stands(FrictionAt friction, double most);
  [[nodiscard]] std::vector<double> dilation() const;
  [[nodiscard]] std::vector<BodyVelocity> without_friction(const LimitFactors& factors, LimitTrial& trial);
  [[nodiscard]] double estimate(const LimitTrial& trial) const;
  [[nodiscard]] SingleBodies& single();

  RigidModel model_;
  std::vector<bool> reduced_;  ///< by point
  PulledJoints pulled_;
  int threads_;
  bool divides_;       ///< parts of joints that crush
  CornerModel above_;  ///< with pressure at corners of parts; empty: not made yet
  ConeProgram bound_;  ///< with the twisting resistance of uniform pressure: what stands must stand here too
  ConeProgram program_;                 ///< with forces in the corners
  std::optional<SingleBodies> single_;  ///< computed at the first use
};

}  // namespace ashlar
