#include "apps/scene/model/level_blocks.hpp"

#include <algorithm>

namespace ashlar {

bool reaches_level(const std::vector<Vector3>& corners, const Vector3& up, double height) {
  const auto [low, high] =
      std::minmax_element(corners.begin(), corners.end(),
                          [&](const Vector3& a, const Vector3& b) { return up.dot(a) < up.dot(b); });
  return low != corners.end() && up.dot(*low) <= height && height <= up.dot(*high);
}

Vector3 point_at_level(const Vector3& centroid, const Vector3& up, double height) {
  return centroid + (height - up.dot(centroid)) * up;
}

}  // namespace ashlar
