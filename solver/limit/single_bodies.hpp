// Motion of each body while all others are held: possible starts of collective motion, and blocks supported by others
// only.
#pragma once

#include <memory>
#include <vector>

#include "solver/limit/limit_trial.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

class LimitAnalysis;

class SingleBodies {
 public:
  /// @param reduced by point, true if its strength is divided
  SingleBodies(const RigidModel& model, const std::vector<bool>& reduced);
  ~SingleBodies();
  SingleBodies(SingleBodies&&) noexcept;
  SingleBodies& operator=(SingleBodies&&) noexcept;
  SingleBodies(const SingleBodies&) = delete;
  SingleBodies& operator=(const SingleBodies&) = delete;

  /// @param tolerance of the factor. @return by body, zero if it stands or its motion is unknown
  [[nodiscard]] std::vector<BodyVelocity> motions(const LimitFactors& factors, double tolerance);
  /// The same as a few sets of bodies without mutual contact, the fastest first.
  [[nodiscard]] std::vector<std::vector<BodyVelocity>> sets(const LimitFactors& factors, double tolerance);

 private:
  std::vector<double> mass_;                            ///< by body
  std::vector<std::vector<int>> neighbours_;            ///< bodies, by body
  std::vector<std::unique_ptr<LimitAnalysis>> single_;  ///< by body
  std::vector<LimitFactors> stands_;  ///< by body, the largest strength factor at which it stood, and its
                                      ///< load factor
};

}  // namespace ashlar
