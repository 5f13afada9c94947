// Scenes with contacts and what verification cases measure in them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/verify/verification.hpp"
#include "apps/verify/verification_blocks.hpp"

namespace ashlar {

/// Blocks that are put together one by one, with one joint law for all of them.
class ContactScene {
 public:
  /// @param placement of all blocks, motions and gravity: what is given to add() is in the scene's own axes,
  /// what is read in the simulation is turned and moved
  explicit ContactScene(Placement placement = {}) : placement_(std::move(placement)) {}

  /// Read anew in every step, so that a joint can be made weaker on the way.
  std::shared_ptr<JointLaw> law = std::make_shared<JointLaw>(JointLaw{1e9, 1e9, 0.0, 0.0, 0.0, true});
  SimulationSettings settings;

  /// @return the block's index
  int add(BlockDefinition block, const InitialMotion& motion = {});
  /// A block that never moves. @return its index
  int add_fixed(Polyhedron solid);
  /// Bonds two blocks over their common faces, as stiffly as scenes do without being told. @param a,b a < b
  void tie(int a, int b) { ties_.push_back({a, b}); }
  /// The same of all moving blocks so far that have common faces; between others no contacts are looked for.
  void tie_all();
  /// The scene as far as it was put together; it is empty afterwards.
  /// @throws std::invalid_argument if blocks are to be tied that have no common face
  [[nodiscard]] Simulation build();

 private:
  std::vector<BlockModel> blocks_;
  std::vector<InitialMotion> motions_;
  std::vector<std::array<int, 2>> ties_;
  bool all_tied_ = false;
  Placement placement_;
};

/// What scenes get that leave all numbers to the program in statics: contact held by multipliers.
/// @param size of the smallest block, m; @param young_modulus Pa; @param friction tan(phi)
void choose_as_for_statics(ContactScene& scene, double size, double young_modulus, double friction);

/// Rotation about the y axis that lowers the side of positive x. @param degrees of the slope that a level
/// face becomes
[[nodiscard]] Eigen::Matrix3d slope(double degrees);

/// Convex hull of some points as a solid.
[[nodiscard]] Polyhedron hull_of(const std::vector<Vector3>& points);

/// tan of an angle in degrees.
[[nodiscard]] double tangent_of(double degrees);

/// Takes one step, not beyond a time. @throws std::runtime_error if it cannot be taken
void take_step(Simulation& simulation, double end_time);

/// Takes steps up to a time. @throws std::runtime_error if one cannot be taken
void run_until(Simulation& simulation, double time);

/// Iterations of a static analysis under the loads at a time until it ends.
[[nodiscard]] StaticStatus find_equilibrium(Simulation& simulation, double time = 1.0);

/// 1 if a static analysis ends with this status, else 0, to be compared with 1.
[[nodiscard]] VerificationCheck check_status(std::string what, Simulation& simulation, StaticStatus expected);

/// Largest residual of the energies in one step, or all that contacts gained by being found anew, over the
/// largest energy of the run.
[[nodiscard]] VerificationCheck check_energy(std::string what, const Simulation& simulation);

/// Where a block's centroid is.
[[nodiscard]] Vector3 centroid(const Simulation& simulation, int block);

}  // namespace ashlar
