// The step of a block that touches nothing, with factors that equal blocks share.
//
// The tangent of linear elasticity in the turning frame is R (w K + rho m I) R', so that one dense factor of
// w K + rho m I serves every block of a kind, however it has turned; it stays while the step's length does.
#pragma once

#include <Eigen/Cholesky>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "solver/step/island.hpp"

namespace ashlar {

/// Factors kept from step to step.
class LoneBodyFactors {
 public:
  struct Entry {
    std::shared_ptr<const BlockParts> parts;  ///< keeps its address from being given to another
    Eigen::LLT<Eigen::MatrixXd> factor;
    bool used = true;
  };
  /// The factor of  stiffness_weight K + mass I,  in the unknowns of a block that cannot turn. Counts as a
  /// solve.
  [[nodiscard]] const Eigen::LLT<Eigen::MatrixXd>& find(const BlockModel& block, double stiffness_weight,
                                                        double mass);
  /// Forgets factors that did not come up since the last call.
  void drop_unused();
  [[nodiscard]] const FactorCounts& counts() const { return counts_; }

 private:
  std::map<std::tuple<const BlockParts*, double, double>, Entry> entries_;
  FactorCounts counts_;
};

/// Solves the step of one block without contacts. @param body its result is written
/// @return nothing if the block is not of a kind that shares factors, or Newton's iteration does not settle
/// in a few systems: it is then for solve_island
[[nodiscard]] std::optional<IslandResult> solve_lone_body(BodyStep& body, const TimeScheme& scheme,
                                                          const SimulationSettings& settings,
                                                          LoneBodyFactors& factors);

}  // namespace ashlar
