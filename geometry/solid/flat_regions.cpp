#include "geometry/solid/flat_regions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ashlar {
namespace {

/// Twice the area, along the normal.
Vector3 area_vector(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

}  // namespace

std::vector<int> flat_regions(const TriangleMesh& mesh, const std::vector<int>& twins, double resolution) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<Vector3> areas;
  areas.reserve(mesh.triangles.size());
  for (int t = 0; t < count; ++t) areas.push_back(area_vector(mesh, t));
  std::vector<int> seeds(mesh.triangles.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](int s, int t) { return areas[s].squaredNorm() > areas[t].squaredNorm(); });

  std::vector<int> regions(mesh.triangles.size(), -1);
  int region = 0;
  for (const int seed : seeds) {
    if (regions[seed] >= 0) continue;
    const Vector3 normal = areas[seed].stableNormalized();
    const Vector3 origin = mesh.points[mesh.triangles[seed][0]];
    const auto belongs = [&](int t) {
      const auto& corners = mesh.triangles[t];
      // A sliver may have any inclination; others face the same way as the region.
      double longest = 0.0;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (mesh.points[corners[k]] - mesh.points[corners[(k + 1) % 3]]).norm());
      return normal.dot(areas[t]) >= -resolution * longest &&
             std::all_of(corners.begin(), corners.end(),
                         [&](int v) { return std::abs(normal.dot(mesh.points[v] - origin)) <= resolution; });
    };
    std::vector<int> front = {seed};
    regions[seed] = region;
    while (!front.empty()) {
      const int t = front.back();
      front.pop_back();
      for (int h = 3 * t; h < 3 * t + 3; ++h) {
        const int neighbour = twins[h] / 3;
        if (regions[neighbour] >= 0 || !belongs(neighbour)) continue;
        regions[neighbour] = region;
        front.push_back(neighbour);
      }
    }
    ++region;
  }
  return regions;
}

}  // namespace ashlar
