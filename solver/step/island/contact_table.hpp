// Laws of an island's contact points in one array, in the order of pairs, for the loops over all points of a guess.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mechanics/contact/laws/point_force.hpp"

namespace ashlar {

/// A copy of the laws of the points, without what the frequent law does not have.
class ContactTable {
 public:
  /// @param laws by pair. @param mean true: forces are means over the step, of which no law is frequent
  void set(const std::vector<std::vector<PointLaw>>& laws, bool mean);

  /// Laws of a pair's points; empty: one of them is not frequent.
  [[nodiscard]] std::span<const FrequentLaw> frequent(std::size_t pair) const {
    return {laws_.data() + pairs_[pair].first_law, pairs_[pair + 1].first_law - pairs_[pair].first_law};
  }
  /// First point of a pair among all points of the island; with the number of pairs: the number of points.
  [[nodiscard]] std::size_t first_point(std::size_t pair) const { return pairs_[pair].first_point; }
  /// Largest stiffness of a spring of a pair with its dashpot, N/m; 0 without points.
  [[nodiscard]] double stiffness(std::size_t pair) const { return pairs_[pair].stiffness; }

 private:
  struct Pair {
    std::size_t first_law = 0;
    std::size_t first_point = 0;
    double stiffness = 0.0;
  };
  std::vector<FrequentLaw> laws_;  ///< of pairs with frequent laws only
  std::vector<Pair> pairs_;        ///< the last one is an end
};

}  // namespace ashlar
