// The step of a block without contacts, with factors that equal blocks share.
//
// The tangent of linear elasticity in the turning frame is R (w K + rho m I) R'. One dense factor of w K + rho m I
// serves all blocks of a kind in any rotation, as long as the step length is the same.
#pragma once

#include <Eigen/Cholesky>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "solver/step/island/island.hpp"

namespace ashlar {

/// Factors kept from step to step.
class LoneBodyFactors {
 public:
  struct Entry {
    std::shared_ptr<const BlockParts> parts;  ///< keeps its address from being reused
    Eigen::LLT<Eigen::MatrixXd> factor;
    bool used = true;
  };
  /// Factor of  stiffness_weight K + mass I  in the unknowns of a block that cannot turn. Counts as a solve.
  [[nodiscard]] const Eigen::LLT<Eigen::MatrixXd>& find(const BlockModel& block, double stiffness_weight,
                                                        double mass);
  /// Drops factors that have not been used since the last call.
  void drop_unused();
  [[nodiscard]] const FactorCounts& counts() const { return counts_; }

 private:
  std::map<std::tuple<const BlockParts*, double, double>, Entry> entries_;
  FactorCounts counts_;
};

/// Solves the step of one block without contacts. @param body its result is written
/// @return empty if the block cannot share factors, or if Newton's iteration does not converge in a few systems: use
/// solve_island then
[[nodiscard]] std::optional<IslandResult> solve_lone_body(BodyStep& body, const TimeScheme& scheme,
                                                          const SimulationSettings& settings,
                                                          LoneBodyFactors& factors);

}  // namespace ashlar
