// The part of one rank in the equations of an island that several ranks share.
//
// The rank has its own bodies of the island and their neighbours, which may be ghosts. Residuals of own bodies are
// complete, those of ghosts are not and are never used: norms, sums and work count own bodies and own pairs, and are
// summed over ranks. Changes of ghosts come from their owners after each solution. So all ranks see the same numbers and
// take the same decisions. An island of one rank, the default, has no other bodies, and pays nothing.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/contact/contact_points.hpp"
#include "solver/ranks/block_share.hpp"

namespace ashlar {

/// Functions are collective for the ranks that share an island.
class IslandRanks {
 public:
  /// An island of one rank.
  IslandRanks() = default;
  /// @param share must outlive this. @param bodies block indices of the island, increasing
  /// @param starts first equation of each body, and the number of equations. @param owns_pair by pair of the island
  IslandRanks(const BlockShare& share, const std::vector<int>& bodies, std::vector<int> starts,
              std::vector<bool> owns_pair);
  [[nodiscard]] static const IslandRanks& one_rank();

  [[nodiscard]] bool shared() const { return share_ != nullptr; }
  [[nodiscard]] bool owns_body(std::size_t place) const { return share_ == nullptr || owns_body_[place]; }
  [[nodiscard]] bool owns_pair(std::size_t pair) const { return share_ == nullptr || owns_pair_[pair]; }

  // The same on all ranks, from those of each.
  [[nodiscard]] double sum(double value) const;
  [[nodiscard]] std::vector<double> sum(const std::vector<double>& values) const;
  [[nodiscard]] double largest(double value) const;
  [[nodiscard]] std::vector<double> largest(const std::vector<double>& values) const;
  [[nodiscard]] bool any(bool value) const;
  /// Inner product of vectors in the island's equations.
  [[nodiscard]] double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const;
  /// Of columns (equations, n) with a vector, by one message. @return (n)
  [[nodiscard]] Eigen::VectorXd dot(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                    const Eigen::VectorXd& y) const;

  /// Sets the parts of ghosts to those of their owners. @param x in the island's equations
  void update_ghosts(Eigen::VectorXd& x) const;
  /// @param values by body
  void update_ghosts(std::vector<Eigen::VectorXd>& values) const;

 private:
  /// Place of a block among the bodies; -1: not one of them.
  [[nodiscard]] int place_of(int block) const;

  const BlockShare* share_ = nullptr;
  std::vector<int> bodies_;
  std::vector<int> starts_;
  std::vector<bool> owns_body_;
  std::vector<bool> owns_pair_;
};

/// Contact states of a guess compared with those of earlier ones, on all ranks.
struct StateComparison {
  bool as_before;  ///< as in the last guess
  bool repeated;   ///< as in any
};
[[nodiscard]] StateComparison compare_states(const IslandRanks& ranks,
                                             const std::vector<ContactState>& states,
                                             const std::vector<std::vector<ContactState>>& seen);

}  // namespace ashlar
