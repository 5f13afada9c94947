#include "solver/contact/reference_order.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {

std::vector<PlacedVolume> places_of(const std::vector<BlockModel>& blocks) {
  std::vector<PlacedVolume> places;
  places.reserve(blocks.size());
  for (const BlockModel& block : blocks) places.push_back({block.basis().centroid(), block.basis().volume()});
  return places;
}

ReferenceOrder::ReferenceOrder(const std::vector<PlacedVolume>& blocks, const Vector3& gravity) {
  Vector3 middle = Vector3::Zero();
  double volume = 0.0;
  for (const PlacedVolume& block : blocks) {
    middle += block.volume * block.centroid;
    volume += block.volume;
  }
  middle /= volume;
  const Vector3 up = -gravity.normalized();
  double farthest = 0.0;
  for (const PlacedVolume& block : blocks) {
    const Vector3 from_middle = block.centroid - middle;
    heights_.push_back(up.dot(from_middle));
    distances_.push_back(from_middle.norm());
    farthest = std::max({farthest, distances_.back(), correctly_rounded::cbrt(block.volume)});
  }
  constexpr double rounding = 1e-9;
  rounding_ = rounding * farthest;
}

bool ReferenceOrder::is_before(int a, int b) const {
  const double higher = heights_[at(a)] - heights_[at(b)];
  if (std::abs(higher) > rounding_) return higher > 0.0;
  const double farther = distances_[at(a)] - distances_[at(b)];
  return std::abs(farther) > rounding_ ? farther > 0.0 : a > b;
}

}  // namespace ashlar
