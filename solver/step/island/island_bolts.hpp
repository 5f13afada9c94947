// The bolts of one island within a step: their responses at a guess of the changes, and their part of the equations
// (island_equations.hpp).
#pragma once

#include <map>
#include <vector>

#include "solver/bolts/step_bolt.hpp"
#include "solver/linear/block_matrix.hpp"

namespace ashlar {

struct BodyStep;
struct Island;

/// All vectors are by bolt of the island.
class IslandBolts {
 public:
  /// @param place of each block of the step among the island's bodies; -1: none
  IslandBolts(const Island& island, std::vector<BodyStep>& bodies, const std::vector<int>& place);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] const StepBolt& bolt(std::size_t k) const;
  /// Places of the blocks of a bolt among the island's bodies; -1: fixed.
  [[nodiscard]] const std::vector<int>& places(std::size_t k) const { return places_[k]; }
  [[nodiscard]] const std::vector<StepBoltResponse>& responses() const { return responses_; }
  [[nodiscard]] std::vector<StepBoltResponse> set_aside() { return std::move(responses_); }
  void take_back(std::vector<StepBoltResponse> responses) { responses_ = std::move(responses); }

  void respond(bool averaged, int threads);
  /// Updates rows where this changes the deformation. @param tolerance m. @return true if any was
  [[nodiscard]] bool follow(double tolerance);
  /// Adds the tangents at the last responses to a matrix of the island. No effect before the first.
  void add_tangents(BlockMatrix& matrix) const;
  /// Adds products of the tangents and a change, with their sign. @param changes,forces of the unknowns, by body
  void add_products(const std::vector<Eigen::VectorXd>& changes, std::vector<Eigen::VectorXd>& forces) const;

  /// Changes of the blocks of a bolt at the present guess.
  [[nodiscard]] std::vector<const Eigen::VectorXd*> changes(std::size_t k) const;
  /// The same from changes by body; blocks that are none have no change.
  [[nodiscard]] std::vector<const Eigen::VectorXd*> changes(
      std::size_t k, const std::vector<Eigen::VectorXd>& of_bodies) const;

 private:
  std::vector<BodyStep>* bodies_;
  std::vector<const StepBolt*> bolts_;
  std::vector<int> island_bodies_;
  std::vector<std::vector<int>> places_;
  std::map<std::size_t, StepBolt> followed_;
  std::vector<StepBoltResponse> responses_;
};

}  // namespace ashlar
