// The factor on strengths or loads beyond which rigid blocks no longer stand (limit analysis). Seconds where an elastic
// analysis takes minutes.
//
// Joints that slide do not open as much as their friction angle asks for (or by their dilation angle), and such joints
// have two limits (notes/limit_analysis.md):
//   associated  the largest factor for which forces in balance exist at all. It is found by cone programmes, with forces
//               below it and a motion above it that prove it. Nothing stands above it. Where blocks wedge each other it
//               counts on forces that nothing may have put there.
//   released    the least factor for which a motion was found that starts from rest without contact forces and obeys
//               Coulomb's law (released_motion.hpp). A motion that is found is one, whatever led to it. That there is
//               none below is a result of search: from motions at larger factors, from motion without friction, and
//               from each body alone. It is the one to sign.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/statics/limit_motion.hpp"
#include "solver/statics/limit_trial.hpp"
#include "solver/statics/rigid_model.hpp"
#include "solver/statics/single_bodies.hpp"

namespace ashlar {

struct LimitAnswer {
  LimitBracket associated;
  LimitBracket released;
  /// Blocks that move at released.lower while all others are held: pressure of others keeps them, as found.
  std::vector<int> kept_by_others;
  bool interrupted = false;
  std::vector<LimitTrial> trials;  ///< in order, without motions and forces
};

class LimitAnalysis {
 public:
  using Chosen = std::function<bool(int, int)>;

  /// @param reduced whether the joint of two blocks is one of those whose strength is divided. @param threads >= 1
  LimitAnalysis(RigidModel model, const Chosen& reduced, int threads);
  /// @param reduced the same, by point of the model
  LimitAnalysis(RigidModel model, std::vector<bool> reduced, int threads);

  [[nodiscard]] const RigidModel& model() const { return model_; }

  /// Forces within the strengths that balance the loads, or the motion that proves that there are none.
  [[nodiscard]] LimitTrial associated(const LimitFactors& factors);
  /// A motion from rest and from no contact forces that obeys Coulomb's law, if one is found.
  /// @param tolerance of the factor: how near to the limit it is to tell
  /// @param known a motion under other factors, which is followed first; null: none
  /// @param balanced forces in balance are known to exist, and are not looked for
  [[nodiscard]] LimitTrial released(const LimitFactors& factors, double tolerance = 1e-3,
                                    const LimitTrial* known = nullptr, bool balanced = false);

  /// The largest factor of the loads that are multiplied for which forces in balance exist, by one programme.
  /// @param most that is looked for, > 0. @return 0: it was not found
  [[nodiscard]] double most_that_stands(double most);
  /// Blocks that move while all others are held, as far as it was found.
  [[nodiscard]] std::vector<int> moving_alone(const LimitFactors& factors, double tolerance);

  /// The factor by which strengths of the chosen joints may be divided. @param goes_on asked before each trial
  [[nodiscard]] LimitAnswer strength_factor(const LimitSearch& search, const std::function<bool()>& goes_on);
  /// The factor by which loads may be multiplied, the others as they are.
  [[nodiscard]] LimitAnswer load_factor(const LimitSearch& search, const std::function<bool()>& goes_on);

  /// The motion of a trial that moves; of an associated one the motion without dilation, if one is found.
  [[nodiscard]] LimitMotion motion_of(const LimitTrial& trial);

 private:
  void set_factors(const LimitFactors& factors);
  [[nodiscard]] std::vector<BodyVelocity> load(double factor) const;
  [[nodiscard]] LimitTrial balanced_by(ConeProgram& program, const LimitFactors& factors) const;
  [[nodiscard]] std::vector<double> dilation() const;
  [[nodiscard]] std::vector<BodyVelocity> without_friction(const LimitFactors& factors, LimitTrial& trial);
  [[nodiscard]] double estimate(const LimitTrial& trial) const;
  [[nodiscard]] SingleBodies& single();

  RigidModel model_;
  std::vector<bool> reduced_;  ///< by point
  ConeProgram
      bound_;  ///< with the twisting resistance of uniform pressure: what stands has to stand in it too
  ConeProgram program_;                 ///< with forces in the corners
  std::optional<SingleBodies> single_;  ///< once it was asked for
};

}  // namespace ashlar
