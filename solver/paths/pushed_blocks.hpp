// Rigid blocks under loads that grow together, from one equilibrium to the next one (pushover.hpp).
#pragma once

#include <optional>
#include <vector>

#include "solver/paths/followed_blocks.hpp"
#include "solver/paths/pushover.hpp"
#include "solver/paths/support_path.hpp"

namespace ashlar {

/// An equilibrium of pushed blocks.
struct PushedPlace {
  FollowedPlace placement;
  RigidModel model;                    ///< there; its multiplied loads are the pushed ones
  std::optional<ConeProgram> program;  ///< of the model
  double multiplier = 0.0;
  std::vector<BodyVelocity> velocity;  ///< mechanism, by body, about 1 for the place that moves farthest
  std::vector<Eigen::Vector3d> force;  ///< by point of the model, in its units and frames
};

/// Why there is no further place.
enum class PushFailure {
  jammed,        ///< any multiplier is balanced
  unbalanced,    ///< at the start: the blocks do not stand without the push
  far,           ///< blocks move too far to be followed
  undetermined,  ///< the programme did not reach its tolerances
};

class PushedBlocks {
 public:
  /// @param search direction and multiplied. @param scene must outlive this
  /// @throws std::invalid_argument as pushover
  PushedBlocks(const PlacedScene& scene, const PushoverSearch& search, const PathLengths& lengths);

  /// The blocks as placed, with their gaps closed. Empty: see failure()
  [[nodiscard]] std::optional<PushedPlace> start();
  /// The place after a step. @param from is unchanged but for its programme's workspace
  /// @param length m, about the displacement of the block that moves farthest. Empty: see failure()
  [[nodiscard]] std::optional<PushedPlace> advanced(PushedPlace& from, double length);
  /// A placement in equilibrium. @param travel m, allowed displacement of blocks. @param opened m, largest gap that a step has
  /// opened at a point under pressure. Empty: see failure()
  [[nodiscard]] std::optional<PushedPlace> equilibrium_from(FollowedPlace placement, double travel,
                                                            double opened = 0.0);

  /// True if no multiplier up to a few times the given size balances the blocks where the last step has led, which has
  /// failed as undetermined.
  [[nodiscard]] bool falls_at_failure(double size);

  [[nodiscard]] PushFailure failure() const { return failure_; }
  /// m, displacement of blocks in the last step, and by closing its gaps.
  [[nodiscard]] double last_travel() const { return last_travel_; }
  [[nodiscard]] int programmes() const { return programmes_; }
  [[nodiscard]] const FollowedBlocks& blocks() const { return blocks_; }

 private:
  [[nodiscard]] RigidModel model_of(const FollowedPlace& placement) const;
  /// Solves (push). @param gaps_of the model at the start of the step. @param length m
  [[nodiscard]] std::optional<ConeAnswer> pushed(ConeProgram& program, const RigidModel& model,
                                                 const RigidModel& gaps_of, double length);
  /// The same, with c such that blocks move by about the length.
  [[nodiscard]] std::optional<ConeAnswer> pushed_by(PushedPlace& from, double length);

  Vector3 direction_;             ///< unit
  std::vector<bool> multiplied_;  ///< by block; empty: forces in proportion to mass
  double gravity_;                ///< m/s^2
  PathLengths lengths_;
  int threads_;
  FollowedBlocks blocks_;
  double rate_ = 1.0;  ///< c: F1 . u per way of the block that moves farthest, in units of the model
  double most_ = unbounded_over_loads;  ///< multiplier that counts as unbounded
  double last_travel_ = 0.0;
  std::optional<PushedPlace>
      failed_;  ///< where the last step has led, if its programme has not reached its tolerances
  PushFailure failure_ = PushFailure::undetermined;
  int programmes_ = 0;
};

/// Replaces the multiplied loads by forces in proportion to mass. @param acceleration m/s^2
void push_masses(RigidModel& model, const Vector3& acceleration);

/// Velocity of a place of a block, per unit of the velocity's. Zero of a fixed block. @param place m
[[nodiscard]] Vector3 velocity_at(const RigidModel& model, const std::vector<BodyVelocity>& velocity,
                                  int block, const Vector3& place);

}  // namespace ashlar
