#include "solver/shared/island_ranks.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {

IslandRanks::IslandRanks(const BlockShare& share, const std::vector<int>& bodies, std::vector<int> starts,
                         std::vector<bool> owns_pair)
    : share_(&share), bodies_(bodies), starts_(std::move(starts)), owns_pair_(std::move(owns_pair)) {
  for (const int block : bodies_) owns_body_.push_back(share.owns(block));
}

const IslandRanks& IslandRanks::one_rank() {
  static const IslandRanks one;
  return one;
}

double IslandRanks::sum(double value) const {
  return shared() ? sum_of_ranks(share_->ranks(), value) : value;
}

std::vector<double> IslandRanks::sum(const std::vector<double>& values) const {
  return shared() ? sum_of_ranks(share_->ranks(), values) : values;
}

double IslandRanks::largest(double value) const {
  return shared() ? max_of_ranks(share_->ranks(), value) : value;
}

std::vector<double> IslandRanks::largest(const std::vector<double>& values) const {
  return shared() ? max_of_ranks(share_->ranks(), values) : values;
}

bool IslandRanks::any(bool value) const {
  return shared() ? any_rank(share_->ranks(), value) : value;
}

double IslandRanks::dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
  return shared() ? dot(Eigen::Ref<const Eigen::MatrixXd>(x), y)[0] : x.dot(y);
}

Eigen::VectorXd IslandRanks::dot(const Eigen::Ref<const Eigen::MatrixXd>& columns,
                                 const Eigen::VectorXd& y) const {
  if (!shared()) return columns.transpose() * y;
  std::vector<double> sums(static_cast<std::size_t>(columns.cols()), 0.0);
  Eigen::Map<Eigen::VectorXd> sum(sums.data(), columns.cols());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const int size = starts_[k + 1] - starts_[k];
    if (owns_body_[k]) sum += columns.middleRows(starts_[k], size).transpose() * y.segment(starts_[k], size);
  }
  sums = sum_of_ranks(share_->ranks(), sums);
  return Eigen::Map<Eigen::VectorXd>(sums.data(), columns.cols());
}

int IslandRanks::place_of(int block) const {
  const auto found = std::lower_bound(bodies_.begin(), bodies_.end(), block);
  return found == bodies_.end() || *found != block ? -1 : static_cast<int>(found - bodies_.begin());
}

void IslandRanks::update_ghosts(std::vector<Eigen::VectorXd>& values) const {
  if (!shared()) return;
  share_->to_ghosts(
      [&](int block) -> const Eigen::VectorXd* {
        const int place = place_of(block);
        return place < 0 ? nullptr : &values[at(place)];
      },
      [&](int block, Eigen::VectorXd value) {
        if (const int place = place_of(block); place >= 0) values[at(place)] = std::move(value);
      });
}

StateComparison compare_states(const IslandRanks& ranks, const std::vector<ContactState>& states,
                               const std::vector<std::vector<ContactState>>& seen) {
  if (seen.empty()) return {false, false};
  if (!ranks.shared())
    return {states == seen.back(), std::find(seen.begin(), seen.end(), states) != seen.end()};
  std::vector<double> differ;
  for (const std::vector<ContactState>& earlier : seen) differ.push_back(states == earlier ? 0.0 : 1.0);
  differ = ranks.largest(differ);
  return {differ.back() == 0.0, std::find(differ.begin(), differ.end(), 0.0) != differ.end()};
}

void IslandRanks::update_ghosts(Eigen::VectorXd& x) const {
  if (!shared()) return;
  std::vector<Eigen::VectorXd> values;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    values.emplace_back(x.segment(starts_[k], starts_[k + 1] - starts_[k]));
  update_ghosts(values);
  for (std::size_t k = 0; k < bodies_.size(); ++k) x.segment(starts_[k], values[k].size()) = values[k];
}

}  // namespace ashlar
