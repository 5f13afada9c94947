#include "solver/shared/shared_island_sums.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {

SharedIslandSums::SharedIslandSums(const BlockShare& share, const std::vector<int>& bodies,
                                   std::vector<int> starts, std::vector<bool> owns_pair)
    : share_(share), bodies_(bodies), starts_(std::move(starts)), owns_pair_(std::move(owns_pair)) {
  for (const int block : bodies_) owns_body_.push_back(share.owns(block));
}

std::vector<double> SharedIslandSums::sum(const std::vector<double>& values) const {
  return sum_of_ranks(share_.ranks(), values);
}

std::vector<double> SharedIslandSums::largest(const std::vector<double>& values) const {
  return max_of_ranks(share_.ranks(), values);
}

Eigen::VectorXd SharedIslandSums::dot(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                      const Eigen::VectorXd& y) const {
  std::vector<double> sums(static_cast<std::size_t>(columns.cols()), 0.0);
  Eigen::Map<Eigen::VectorXd> sum(sums.data(), columns.cols());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const int size = starts_[k + 1] - starts_[k];
    if (owns_body_[k]) sum += columns.middleRows(starts_[k], size).transpose() * y.segment(starts_[k], size);
  }
  sums = sum_of_ranks(share_.ranks(), sums);
  return Eigen::Map<Eigen::VectorXd>(sums.data(), columns.cols());
}

int SharedIslandSums::place_of(int block) const {
  const auto found = std::lower_bound(bodies_.begin(), bodies_.end(), block);
  return found == bodies_.end() || *found != block ? -1 : static_cast<int>(found - bodies_.begin());
}

void SharedIslandSums::update_neighbours(std::vector<Eigen::VectorXd>& values) const {
  share_.to_ghosts(
      [&](int block) -> const Eigen::VectorXd* {
        const int place = place_of(block);
        return place < 0 ? nullptr : &values[at(place)];
      },
      [&](int block, Eigen::VectorXd value) {
        if (const int place = place_of(block); place >= 0) values[at(place)] = std::move(value);
      });
}

void SharedIslandSums::update_neighbours(Eigen::VectorXd& x) const {
  std::vector<Eigen::VectorXd> values;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    values.emplace_back(x.segment(starts_[k], starts_[k + 1] - starts_[k]));
  update_neighbours(values);
  for (std::size_t k = 0; k < bodies_.size(); ++k) x.segment(starts_[k], values[k].size()) = values[k];
}

}  // namespace ashlar
