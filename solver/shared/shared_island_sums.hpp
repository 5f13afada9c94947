// The sums of an island that several ranks share.
#pragma once

#include "solver/ranks/block_share.hpp"
#include "solver/step/island/island_sums.hpp"

namespace ashlar {

/// Collective for the ranks of the run.
class SharedIslandSums final : public IslandSums {
 public:
  /// @param share must outlive this. @param bodies block indices of the island, increasing
  /// @param starts first equation of each body, and the number of equations. @param owns_pair by pair of the island
  SharedIslandSums(const BlockShare& share, const std::vector<int>& bodies, std::vector<int> starts,
                   std::vector<bool> owns_pair);

  using IslandSums::dot;
  using IslandSums::largest;
  using IslandSums::sum;
  [[nodiscard]] bool shared() const override { return true; }
  [[nodiscard]] bool owns_body(std::size_t place) const override { return owns_body_[place]; }
  [[nodiscard]] bool owns_pair(std::size_t pair) const override { return owns_pair_[pair]; }
  [[nodiscard]] std::vector<double> sum(const std::vector<double>& values) const override;
  [[nodiscard]] std::vector<double> largest(const std::vector<double>& values) const override;
  /// By one message.
  [[nodiscard]] Eigen::VectorXd dot(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                    const Eigen::VectorXd& y) const override;
  void update_neighbours(Eigen::VectorXd& x) const override;
  void update_neighbours(std::vector<Eigen::VectorXd>& values) const override;

 private:
  /// Place of a block among the bodies; -1: not one of them.
  [[nodiscard]] int place_of(int block) const;

  const BlockShare& share_;
  std::vector<int> bodies_;
  std::vector<int> starts_;
  std::vector<bool> owns_body_;
  std::vector<bool> owns_pair_;
};

}  // namespace ashlar
