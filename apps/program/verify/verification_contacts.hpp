// Scenes with contacts and measurements for verification cases.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/verify/verification.hpp"
#include "apps/program/verify/verification_blocks.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

/// A scene built block by block, with one joint law for all blocks.
class ContactScene {
 public:
  /// @param placement of all blocks, motions and gravity: arguments of add() are in the scene's own axes, results of
  /// the simulation are rotated and translated
  explicit ContactScene(Placement placement = {}) : placement_(std::move(placement)) {}

  /// Read again in every step, so that a joint can be weakened during the run.
  std::shared_ptr<JointLaw> law = std::make_shared<JointLaw>(JointLaw{1e9, 1e9, 0.0, 0.0, 0.0, true});
  SimulationSettings settings;

  /// @return the block's index
  int add(BlockDefinition block, const InitialMotion& motion = {});
  /// A block that never moves. @return its index
  int add_fixed(Polyhedron solid);
  /// Bonds two blocks over their common faces with the default stiffness of scenes. @param a,b a < b
  void tie(int a, int b) { ties_.push_back({a, b}); }
  /// The same for all moving blocks so far that have common faces; no contacts are searched between others.
  void tie_all();
  /// The scene built so far; it is empty afterwards.
  /// @throws std::invalid_argument if blocks to be tied have no common face
  [[nodiscard]] Simulation build();

 private:
  std::vector<BlockModel> blocks_;
  std::vector<InitialMotion> motions_;
  std::vector<PairKey> ties_;
  bool all_tied_ = false;
  Placement placement_;
};

/// A bar along x of 0.1 x 0.1, of steel without lateral strain, whose sides and ends move only along x. @param from,to m
[[nodiscard]] BlockDefinition bar_along_x(double from, double to, int order);

/// Two equal bars of 1 m that meet at x = 0 at 1 m/s, without gravity. A wave of stress rho c v/2 runs through each at
/// c = sqrt(E/rho) and returns as release after 2 L/c = 4e-4 s. Until then the contact force is F = A rho c v/2, and they
/// exchange their velocities. A bar is a chain of tied pieces, so that the wave front can be resolved: the first pieces
/// are the left one. @param pieces of each bar
[[nodiscard]] ContactScene meeting_bars(int pieces, int order);

/// Momentum along x of the first blocks, kg m/s.
[[nodiscard]] double momentum_along_x(const Simulation& simulation, int blocks);

/// Applies the automatic settings of scenes in statics: contact by multipliers.
/// @param size of the smallest block, m; @param young_modulus Pa; @param friction tan(phi)
void choose_as_for_statics(ContactScene& scene, double size, double young_modulus, double friction);

/// Rotation about the y axis that lowers the side of positive x. @param degrees slope of a horizontal face after
/// rotation
[[nodiscard]] Eigen::Matrix3d slope(double degrees);

/// Convex hull of some points as a solid.
[[nodiscard]] Polyhedron hull_of(const std::vector<Vector3>& points);

/// tan of an angle in degrees.
[[nodiscard]] double tangent_of(double degrees);

/// Takes one step that does not pass a time. @throws std::runtime_error if it cannot be taken
void take_step(Simulation& simulation, double end_time);

/// Takes steps up to a time. @throws std::runtime_error if one cannot be taken
void run_until(Simulation& simulation, double time);

/// Iterates a static analysis under the loads at a time until it ends.
[[nodiscard]] StaticStatus find_equilibrium(Simulation& simulation, double time = 1.0);

/// 1 if a static analysis ends with this status, else 0, to be compared with 1.
[[nodiscard]] VerificationCheck check_status(std::string what, Simulation& simulation, StaticStatus expected);

/// Largest residual of the energies in one step, or total gain of re-detected contacts, relative to the largest
/// energy of the run.
[[nodiscard]] VerificationCheck check_energy(std::string what, const Simulation& simulation);

/// Place of a block's centroid.
[[nodiscard]] Vector3 centroid(const Simulation& simulation, int block);

}  // namespace ashlar
