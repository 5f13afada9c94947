#include "oracle/lattice_hull.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace ashlar::oracle {
namespace {

/// The plane through three points with all points on or below it, primitive normal, or zero if there is none.
LatticePoint supporting_normal(const std::vector<LatticePoint>& points, const LatticePoint& a,
                               const LatticePoint& b, const LatticePoint& c) {
  LatticePoint normal = lattice_cross(lattice_add(b, a, -1), lattice_add(c, a, -1));
  bool above = false;
  bool below = false;
  for (const LatticePoint& point : points) {
    const std::int64_t height = lattice_dot(normal, lattice_add(point, a, -1));
    above = above || height > 0;
    below = below || height < 0;
  }
  if (above == below) return {};
  const std::int64_t divisor = std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
  for (std::int64_t& component : normal) component /= above ? -divisor : divisor;
  return normal;
}

/// Corners of the hull of coplanar points, counter-clockwise seen against the normal (gift wrapping).
std::vector<LatticePoint> wrap(const std::vector<LatticePoint>& points, const LatticePoint& normal) {
  std::vector<LatticePoint> cycle{*std::min_element(points.begin(), points.end())};
  for (;;) {
    const LatticePoint& from = cycle.back();
    LatticePoint best = from;
    for (const LatticePoint& candidate : points) {
      const LatticePoint step = lattice_add(candidate, from, -1);
      const LatticePoint best_step = lattice_add(best, from, -1);
      const std::int64_t turn = lattice_dot(normal, lattice_cross(best_step, step));
      const bool farther = turn == 0 && lattice_dot(step, step) > lattice_dot(best_step, best_step);
      if (turn < 0 || farther) best = candidate;
    }
    if (best == cycle.front()) return cycle;
    cycle.push_back(best);
  }
}

}  // namespace

std::int64_t pick(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

std::int64_t lattice_dot(const LatticePoint& a, const LatticePoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LatticePoint lattice_cross(const LatticePoint& a, const LatticePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

LatticePoint lattice_add(const LatticePoint& a, const LatticePoint& b, std::int64_t factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

LatticeSolid lattice_hull(const std::vector<LatticePoint>& given, Random& random) {
  const std::set<LatticePoint> distinct(given.begin(), given.end());
  const std::vector<LatticePoint> points(distinct.begin(), distinct.end());
  std::map<LatticePoint, std::int64_t> planes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const LatticePoint normal = supporting_normal(points, points[i], points[j], points[k]);
        if (normal != LatticePoint{}) planes.emplace(normal, lattice_dot(normal, points[i]));
      }
    }
  }
  LatticeSolid solid;
  std::map<LatticePoint, int> index;
  for (const auto& [normal, offset] : planes) {
    std::vector<LatticePoint> on_plane;
    for (const LatticePoint& point : points) {
      if (lattice_dot(normal, point) == offset) on_plane.push_back(point);
    }
    std::vector<LatticePoint> cycle = wrap(on_plane, normal);
    std::rotate(cycle.begin(), cycle.begin() + pick(random, 0, static_cast<std::int64_t>(cycle.size()) - 1),
                cycle.end());
    std::vector<int> corners;
    for (const LatticePoint& point : cycle) {
      const auto [entry, added] = index.emplace(point, static_cast<int>(solid.points.size()));
      if (added) solid.points.push_back(point);
      corners.push_back(entry->second);
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      solid.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    solid.normals.push_back(normal);
  }
  return solid;
}

}  // namespace ashlar::oracle
