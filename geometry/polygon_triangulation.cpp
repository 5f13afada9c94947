#include "geometry/polygon_triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace ashlar {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

class EarClipper {
 public:
  EarClipper(const std::vector<Vector3>& points, std::span<const int> corners) {
    Vector3 normal = Vector3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Vector3& a = points[corners[0]];
      normal += (points[corners[i - 1]] - a).cross(points[corners[i]] - a);
    }
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(u, v);
    for (const int c : corners) ring_.push_back({c, Point(points[c][u], points[c][v]), false});
    for (std::size_t i = 0; i < ring_.size(); ++i) mark(i);
  }

  void run(std::vector<std::array<int, 3>>& triangles) {
    std::size_t candidate = 1;
    std::size_t refused = 0;
    while (ring_.size() > 3 && refused < ring_.size()) {
      candidate %= ring_.size();
      if (!is_ear(candidate)) {
        ++candidate;
        ++refused;
        continue;
      }
      emit(candidate, triangles);
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(candidate));
      mark(candidate % ring_.size());
      mark((candidate + ring_.size() - 1) % ring_.size());
      refused = 0;
    }
    for (std::size_t i = 1; i + 1 < ring_.size(); ++i) {
      triangles.push_back({ring_[0].corner, ring_[i].corner, ring_[i + 1].corner});
    }
  }

 private:
  struct Corner {
    int corner;
    Point place;
    bool convex;  // strictly; others are all that can lie in an ear
  };

  [[nodiscard]] const Corner& at(std::size_t i) const { return ring_[i % ring_.size()]; }
  [[nodiscard]] const Corner& before(std::size_t i) const { return at(i + ring_.size() - 1); }

  void mark(std::size_t i) {
    ring_[i].convex =
        CGAL::orientation(before(i).place, at(i).place, at(i + 1).place) == CGAL::COUNTERCLOCKWISE;
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    if (!at(i).convex) return false;
    const Point& a = before(i).place;
    const Point& b = at(i).place;
    const Point& c = at(i + 1).place;
    return std::none_of(ring_.begin(), ring_.end(), [&](const Corner& other) {
      const Point& p = other.place;
      return !other.convex && p != a && p != b && p != c && CGAL::orientation(a, b, p) != CGAL::CLOCKWISE &&
             CGAL::orientation(b, c, p) != CGAL::CLOCKWISE && CGAL::orientation(c, a, p) != CGAL::CLOCKWISE;
    });
  }

  void emit(std::size_t i, std::vector<std::array<int, 3>>& triangles) const {
    triangles.push_back({before(i).corner, at(i).corner, at(i + 1).corner});
  }

  std::vector<Corner> ring_;
};

}  // namespace

void triangulate_polygon(const std::vector<Vector3>& points, std::span<const int> corners,
                         std::vector<std::array<int, 3>>& triangles) {
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const bool finite =
      std::all_of(corners.begin(), corners.end(), [&points](int c) { return points[c].allFinite(); });
  if (finite) {
    EarClipper(points, corners).run(triangles);
    return;
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
}

void append_fan(std::vector<int> loop, std::vector<std::array<int, 3>>& triangles) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) triangles.push_back({loop[0], loop[k], loop[k + 1]});
}

}  // namespace ashlar
