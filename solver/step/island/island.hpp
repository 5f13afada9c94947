// Islands: sets of blocks that touch each other. Each is solved on its own by an open-close iteration
// (open_close.hpp).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/bolts/step_bolt.hpp"
#include "solver/contact/contact_pair.hpp"
#include "solver/linear/block_matrix.hpp"
#include "solver/settings.hpp"
#include "solver/step/island/time_scheme.hpp"

namespace ashlar {

/// Outcome of an open-close iteration.
enum class IslandStatus {
  converged,
  not_converged,          ///< not even the fallback balanced the forces: cut the step
  not_positive_definite,  ///< the system could not be factorised: cut the step
};

/// One moving block within a step. Vectors are in the block's unknowns, also those of a rigid one (rigid_body.hpp).
struct BodyStep {
  const BlockModel* model = nullptr;
  const BlockState* state = nullptr;  ///< at the start of the step
  Eigen::VectorXd free_change;        ///< change without forces, see time_scheme.hpp
  Eigen::VectorXd external_force;     ///< evaluated where the integrator requires it
  double roundoff_force = 0.0;        ///< size of the rounding errors of the internal force
  Eigen::VectorXd change;             ///< D, the result
  double largest_force = 0.0;         ///< norm of the largest force that acts on it
  double residual = 0.0;              ///< norm of its residual, N; 0: within its tolerance
  ElasticResponse elastic;            ///< evaluated where the integrator requires it
  Eigen::MatrixX3d prescribed;        ///< displacement of moving supports, (p, 3); empty: none
  /// For damping by stiffness: elastic force at the start of the step in the frame that turns with the block, (p, 3)
  Eigen::MatrixX3d start_force;

  const Eigen::MatrixXd* dashpots = nullptr;  ///< of quiet faces in motion; null: none
  Eigen::VectorXd carried_velocity;           ///< velocity at which they act if nothing changes

  /// For a rigid block: velocity fields at the middle of its motion, (unknowns, 6); with TimeScheme::impulsive at its
  /// position. See follow_rigid()
  Eigen::MatrixXd fields;

  /// Replaces the change of a rigid block by the closest rigid one and updates its fields. No effect on other blocks.
  void follow_rigid(const TimeScheme& scheme);
  /// Projects a force on the unknowns to the block's equations, (model->freedom()).
  [[nodiscard]] Eigen::VectorXd in_equations(const Eigen::VectorXd& force) const {
    return model->rigid() ? Eigen::VectorXd(fields.transpose() * force) : force;
  }
  /// Change of the unknowns by a solution of the equations.
  [[nodiscard]] Eigen::VectorXd of_unknowns(const Eigen::VectorXd& solution) const {
    return model->rigid() ? Eigen::VectorXd(fields * solution) : solution;
  }
  /// Change of the position's coefficients at the present `change`. @return (p, 3)
  [[nodiscard]] Eigen::MatrixX3d motion() const;
  /// Remembers the elastic force at the start of the step.
  void note_start_force();
  /// `elastic.force` and the force of damping by stiffness, (p, 3).
  [[nodiscard]] Eigen::MatrixX3d internal_force(const TimeScheme& scheme) const;
  /// Force of the block on its dashpots; empty: there are none.
  [[nodiscard]] Eigen::VectorXd dashpot_force(const TimeScheme& scheme) const;
};

/// A bolt's forces over a step and their work, J.
struct BoltResult {
  StepBoltResponse response;
  double work;             ///< on all blocks
  double prescribed_work;  ///< part of it on moving supports
};

/// Result of one island.
struct IslandResult {
  IslandStatus status = IslandStatus::converged;
  int iterations = 0;                       ///< evaluated guesses
  int fallbacks = 0;                        ///< times the fallback was needed
  std::vector<PairResponse> responses;      ///< of the island's pairs, at the end of the step
  std::vector<std::vector<PointLaw>> laws;  ///< of their points: broken joints, multipliers
  std::vector<BoltResult> bolts;            ///< of the island's bolts
  /// Pairs whose rows were updated, by index. The responses belong to them.
  std::vector<std::pair<int, ContactPair>> followed;
  /// If not converged: blocks of the pair whose points have changed state most often; -1: none did
  BlockPair alternating = {-1, -1};
};

/// Factor that later steps may use, by the data that it is rebuilt from.
struct KeptFactor {
  std::vector<int> key;  ///< IslandSolvers::find
  std::vector<int> sizes;
  std::vector<std::array<int, 2>> pairs;
  std::vector<double> values;  ///< of the factorised matrix
  double inertia = 0.0;
};

/// Factorisations that are kept from step to step, by the blocks and pairs of an island.
class IslandSolvers {
 public:
  struct Entry {
    std::vector<int> sizes;
    std::vector<std::array<int, 2>> pairs;
    BlockMatrix matrix;
    std::unique_ptr<LinearSolver> factor;
    bool used = true;
    double inertia = 0.0;  ///< TimeScheme::inertia of the factor; 0: not usable in another step
  };
  explicit IslandSolvers(LinearMethod method) : method_(method) {}

  /// The solver of an island. @param key role, block indices, then pairs
  [[nodiscard]] Entry& find(const std::vector<int>& key, const std::vector<int>& sizes,
                            const std::vector<std::array<int, 2>>& pairs);
  /// Drops the solvers of islands that have not come up since the last call.
  void drop_unused();
  [[nodiscard]] FactorCounts counts() const;
  /// Factors that later steps may use: results depend on them.
  [[nodiscard]] std::vector<KeptFactor> kept() const;
  /// Rebuilds kept factors and drops all others and all counts.
  /// @throws std::invalid_argument unless they are factors of such matrices
  void restore(const std::vector<KeptFactor>& kept);

 private:
  LinearMethod method_;
  std::map<std::vector<int>, Entry> entries_;
  FactorCounts dropped_;
};

/// An island: indices into the step's bodies and pairs.
struct Island {
  std::vector<int> bodies;                  ///< increasing block indices
  std::vector<int> pairs;                   ///< indices of contact pairs
  std::vector<const StepBolt*> bolts = {};  ///< of the step
};

/// Islands of moving blocks; fixed blocks join nothing. @param moving (#blocks)
/// @param bolts must outlive the islands
[[nodiscard]] std::vector<Island> find_islands(const std::vector<bool>& moving,
                                               const std::vector<ContactPair>& pairs,
                                               const std::vector<StepBolt>& bolts = {});

/// @throws std::logic_error unless each moving block is in one island, in order, and each pair of contacts or
/// ties in that of its moving blocks
void validate(const std::vector<Island>& islands, const std::vector<bool>& moving,
              const std::vector<ContactPair>& pairs);

/// Purpose of a system; each keeps its own factor.
enum class SystemRole { step, stop };
/// The solver of an island's system.
[[nodiscard]] IslandSolvers::Entry& solver_of(const Island& island, const std::vector<BodyStep>& bodies,
                                              const std::vector<ContactPair>& pairs, SystemRole role,
                                              IslandSolvers& solvers);

/// Solves one island for the changes of its bodies' unknowns.
/// @param bodies (#blocks), those of the island are read and their results written
[[nodiscard]] IslandResult solve_island(const Island& island, std::vector<BodyStep>& bodies,
                                        const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                                        const SimulationSettings& settings, IslandSolvers& solvers);
/// As above with a given solver: islands may be solved at the same time.
[[nodiscard]] IslandResult solve_island(const Island& island, std::vector<BodyStep>& bodies,
                                        const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                                        const SimulationSettings& settings, IslandSolvers::Entry& solver);

}  // namespace ashlar
