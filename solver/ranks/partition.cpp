#include "solver/ranks/partition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"
#include "solver/ranks/rank_values.hpp"

namespace ashlar {
namespace {

/// A block in a message between ranks.
struct PlacedWeight {
  int block;
  double weight;
  double x, y, z;
};

using PointsOfPart = std::vector<int>;

/// Number of leading points whose weight is nearest to a target; the smaller of two equally near.
std::size_t nearest_cut(const PointsOfPart& points, const std::vector<double>& weights, double target) {
  double before = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double after = before + weights[at(points[k])];
    if (after >= target) return target - before <= after - target ? k : k + 1;
    before = after;
  }
  return points.size();
}

void bisect(PointsOfPart points, const std::vector<Eigen::Vector3d>& centroids,
            const std::vector<double>& weights, int first_part, int parts, std::vector<int>& result) {
  if (parts == 1 || points.empty()) {
    for (const int point : points) result[at(point)] = first_part;
    return;
  }
  Eigen::AlignedBox3d box;
  double weight = 0.0;
  for (const int point : points) {
    box.extend(centroids[at(point)]);
    weight += weights[at(point)];
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  std::sort(points.begin(), points.end(), [&](int a, int b) {
    return std::pair(centroids[at(a)][axis], a) < std::pair(centroids[at(b)][axis], b);
  });
  const int lower = parts / 2;
  const std::size_t cut = nearest_cut(points, weights, weight * lower / parts);
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(cut);
  bisect({points.begin(), middle}, centroids, weights, first_part, lower, result);
  bisect({middle, points.end()}, centroids, weights, first_part + lower, parts - lower, result);
}

}  // namespace

double weight_of_block(int unknowns, int contact_points) {
  return unknowns + 0.5 * contact_points;
}

std::vector<int> bisected(const std::vector<Eigen::Vector3d>& centroids, const std::vector<double>& weights,
                          int parts) {
  if (parts < 1) throw std::invalid_argument("bisected: no parts");
  if (centroids.size() != weights.size()) throw std::invalid_argument("bisected: weights are not by point");
  std::vector<int> result(centroids.size(), -1);
  PointsOfPart points(centroids.size());
  std::iota(points.begin(), points.end(), 0);
  bisect(std::move(points), centroids, weights, 0, parts, result);
  return result;
}

std::vector<int> partition_by_place(Ranks& ranks, const std::vector<PartitionBlock>& own, int blocks) {
  std::vector<PlacedWeight> told;
  told.reserve(own.size());
  for (const PartitionBlock& block : own)
    told.push_back({block.block, block.weight, block.centroid.x(), block.centroid.y(), block.centroid.z()});
  std::vector<PlacedWeight> all;
  for (const Bytes& given : ranks.gather(bytes_of_values<PlacedWeight>(told))) {
    const auto of_rank = values_of_bytes<PlacedWeight>(given);
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  }
  // By block: the result does not depend on who knew it.
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.block < b.block; });
  std::vector<Eigen::Vector3d> centroids;
  std::vector<double> weights;
  for (const PlacedWeight& placed : all) {
    centroids.emplace_back(placed.x, placed.y, placed.z);
    weights.push_back(placed.weight);
  }
  const std::vector<int> part = bisected(centroids, weights, ranks.count());
  std::vector<int> owners(at(blocks), -1);
  for (std::size_t k = 0; k < all.size(); ++k) owners[at(all[k].block)] = part[k];
  return owners;
}

std::vector<int> with_names_of(const std::vector<int>& present, const std::vector<int>& part,
                               const std::vector<double>& weights, int parts) {
  std::map<std::pair<int, int>, double> common;
  for (std::size_t k = 0; k < part.size(); ++k)
    if (part[k] >= 0 && present[k] >= 0) common[{part[k], present[k]}] += weights[k];
  std::vector<std::tuple<double, int, int>> matches;
  matches.reserve(common.size());
  for (const auto& [names, weight] : common) matches.emplace_back(-weight, names.first, names.second);
  std::sort(matches.begin(), matches.end());
  std::vector<int> name(at(parts), -1);
  std::vector<bool> used(at(parts), false);
  for (const auto& [weight, own_part, rank] : matches) {
    if (name[at(own_part)] >= 0 || used[at(rank)]) continue;
    name[at(own_part)] = rank;
    used[at(rank)] = true;
  }
  int next = 0;
  for (int& own_name : name) {
    if (own_name >= 0) continue;
    while (used[at(next)]) ++next;
    own_name = next++;
  }
  std::vector<int> renamed = part;
  for (int& own_part : renamed)
    if (own_part >= 0) own_part = name[at(own_part)];
  return renamed;
}

double imbalance_of(const std::vector<int>& owners, const std::vector<double>& weights, int ranks) {
  std::vector<double> sums(at(ranks), 0.0);
  for (std::size_t k = 0; k < owners.size(); ++k)
    if (owners[k] >= 0) sums[at(owners[k])] += weights[k];
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  return all > 0.0 ? *std::max_element(sums.begin(), sums.end()) * ranks / all - 1.0 : 0.0;
}

}  // namespace ashlar
