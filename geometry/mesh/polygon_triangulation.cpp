#include "geometry/mesh/polygon_triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "geometry/lexicographic.hpp"

namespace ashlar {
namespace {

using FlatPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

// The remaining corners form a ring; those of them that are not strictly convex, the only ones that can lie in an
// ear, form a second list.
class EarClipper {
 public:
  EarClipper(const std::vector<Vector3>& points, std::span<const int> corners, std::size_t& tests_left)
      : tests_left_(tests_left) {
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
    const int count = static_cast<int>(corners.size());
    for (int i = 0; i < count; ++i) {
      const int c = corners[i];
      ring_.push_back({c, FlatPoint(points[c][u], points[c][v]), (i + count - 1) % count, (i + 1) % count});
    }
    for (int i = 0; i < count; ++i) mark(i);
  }

  void run(std::vector<std::array<int, 3>>& triangles) {
    std::size_t left = ring_.size();
    std::size_t refused = 0;
    int candidate = 1;
    int first = 0;  // of those left, in the order given
    while (left > 3 && refused < left) {
      const int next = ring_[candidate].next;
      if (!is_ear(candidate)) {
        candidate = next;
        ++refused;
        continue;
      }
      emit(candidate, triangles);
      if (candidate == first) first = next;
      remove(candidate);
      candidate = next;
      --left;
      refused = 0;
    }
    for (int i = ring_[first].next; ring_[i].next != first; i = ring_[i].next) {
      triangles.push_back({ring_[first].corner, ring_[i].corner, ring_[ring_[i].next].corner});
    }
  }

 private:
  struct Corner {
    int corner;
    FlatPoint place;
    int before;
    int next;
    bool convex = true;  // strictly
    int before_not_convex = none;
    int next_not_convex = none;
  };
  static constexpr int none = -1;

  void mark(int i) {
    Corner& corner = ring_[i];
    const bool convex = CGAL::orientation(ring_[corner.before].place, corner.place,
                                          ring_[corner.next].place) == CGAL::COUNTERCLOCKWISE;
    if (convex == corner.convex) return;
    if (convex)
      unlist(i);
    else
      list(i);
    corner.convex = convex;
  }

  void list(int i) {
    ring_[i].before_not_convex = none;
    ring_[i].next_not_convex = first_not_convex_;
    if (first_not_convex_ != none) ring_[first_not_convex_].before_not_convex = i;
    first_not_convex_ = i;
  }

  void unlist(int i) {
    const int before = ring_[i].before_not_convex;
    const int next = ring_[i].next_not_convex;
    (before == none ? first_not_convex_ : ring_[before].next_not_convex) = next;
    if (next != none) ring_[next].before_not_convex = before;
  }

  // An ear, which is convex.
  void remove(int i) {
    const int before = ring_[i].before;
    const int next = ring_[i].next;
    ring_[before].next = next;
    ring_[next].before = before;
    mark(next);
    mark(before);
  }

  [[nodiscard]] bool is_ear(int i) {
    if (!ring_[i].convex) return false;
    const FlatPoint& a = ring_[ring_[i].before].place;
    const FlatPoint& b = ring_[i].place;
    const FlatPoint& c = ring_[ring_[i].next].place;
    for (int k = first_not_convex_; k != none; k = ring_[k].next_not_convex) {
      if (tests_left_ == 0) throw std::length_error("polygons with too many corners");
      --tests_left_;
      const FlatPoint& p = ring_[k].place;
      if (p != a && p != b && p != c && CGAL::orientation(a, b, p) != CGAL::CLOCKWISE &&
          CGAL::orientation(b, c, p) != CGAL::CLOCKWISE && CGAL::orientation(c, a, p) != CGAL::CLOCKWISE)
        return false;
    }
    return true;
  }

  void emit(int i, std::vector<std::array<int, 3>>& triangles) const {
    triangles.push_back({ring_[ring_[i].before].corner, ring_[i].corner, ring_[ring_[i].next].corner});
  }

  std::vector<Corner> ring_;  // by index, those cut off too
  int first_not_convex_ = none;
  std::size_t& tests_left_;
};

/// A ring of corners read from one of them, forwards or backwards.
class Reading {
 public:
  Reading(const std::vector<Vector3>& points, std::span<const int> ring, bool backwards)
      : points_(points), ring_(ring), backwards_(backwards) {}

  [[nodiscard]] int corner(std::size_t k) const {
    const std::size_t place = (start_ + k) % ring_.size();
    return ring_[backwards_ ? ring_.size() - 1 - place : place];
  }
  /// Starts where the sequence of places is smallest, in time linear in the corners: of two candidates with k common
  /// places, the one that is greater there is excluded together with the next k.
  void start_at_least() {
    const std::size_t count = ring_.size();
    std::size_t best = 0, other = 1, common = 0;
    while (best < count && other < count && common < count) {
      const Vector3& x = points_[corner(best + common)];
      const Vector3& y = points_[corner(other + common)];
      if (x == y) {
        ++common;
        continue;
      }
      (lexicographically_less(y, x) ? best : other) += common + 1;
      if (best == other) ++other;
      common = 0;
    }
    start_ = std::min(best, other);
  }
  [[nodiscard]] bool is_less_than(const Reading& reading) const {
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      const Vector3& x = points_[corner(k)];
      const Vector3& y = points_[reading.corner(k)];
      if (x != y) return lexicographically_less(x, y);
    }
    return false;
  }
  [[nodiscard]] std::vector<int> corners() const {
    std::vector<int> result;
    result.reserve(ring_.size());
    for (std::size_t k = 0; k < ring_.size(); ++k) result.push_back(corner(k));
    return result;
  }

 private:
  const std::vector<Vector3>& points_;
  std::span<const int> ring_;
  bool backwards_;
  std::size_t start_ = 0;
};

}  // namespace

void triangulate_polygon(const std::vector<Vector3>& points, std::span<const int> corners,
                         std::vector<std::array<int, 3>>& triangles, std::size_t& tests_left) {
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const bool finite =
      std::all_of(corners.begin(), corners.end(), [&points](int c) { return points[c].allFinite(); });
  if (finite) {
    Reading forwards(points, corners, false), backwards(points, corners, true);
    forwards.start_at_least();
    backwards.start_at_least();
    const bool turned = backwards.is_less_than(forwards);
    const std::size_t first = triangles.size();
    EarClipper(points, (turned ? backwards : forwards).corners(), tests_left).run(triangles);
    if (!turned) return;
    const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(first);
    std::for_each(begin, triangles.end(), [](auto& triangle) { std::swap(triangle[1], triangle[2]); });
    std::reverse(begin, triangles.end());
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
