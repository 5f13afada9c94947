#include "geometry/cell_overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

/// Signs of every point against every side of a counter-clockwise polygon. Row: point, column: side.
class SideSigns {
 public:
  SideSigns(std::span<const Vector3> points, std::span<const Vector3> polygon, const Vector3& w,
            PredicateCounts& counts)
      : sides_(polygon.size()), signs_(points.size() * polygon.size()) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (std::size_t s = 0; s < sides_; ++s) {
        signs_[p * sides_ + s] =
            orientation_along(w, polygon[s], polygon[(s + 1) % sides_], points[p], counts);
      }
    }
  }
  [[nodiscard]] int operator()(std::size_t point, std::size_t side) const {
    return signs_[point * sides_ + side];
  }
  [[nodiscard]] bool inside(std::size_t point) const {
    for (std::size_t s = 0; s < sides_; ++s) {
      if ((*this)(point, s) < 0) return false;
    }
    return true;
  }

 private:
  std::size_t sides_;
  std::vector<int> signs_;
};

Eigen::Vector2d crossing_place(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                               const Eigen::Vector2d& d) {
  const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double share = cross(c - a, d - c) / cross(b - a, d - c);
  return a + std::clamp(share, 0.0, 1.0) * (b - a);
}

}  // namespace

ViewFrame::ViewFrame(const Vector3& origin_, const Vector3& direction)
    : origin(origin_), w(direction.normalized()) {
  // The axis least along w gives the best conditioned frame; ties go to the first.
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(w[k]) < std::abs(w[axis])) axis = k;
  }
  e1 = Vector3::Unit(axis).cross(w).normalized();
  e2 = w.cross(e1);
}

Eigen::Vector2d ViewFrame::project(const Vector3& point) const {
  const Vector3 r = point - origin;
  return {e1.dot(r), e2.dot(r)};
}

std::vector<OverlapCorner> overlap_polygon(std::span<const Vector3> a, std::span<const Vector3> b,
                                           const ViewFrame& frame, PredicateCounts& counts) {
  // Turned over, a runs counter-clockwise as well; side k of the turned polygon is side n-2-k of a.
  const std::vector<Vector3> turned(a.rbegin(), a.rend());
  const std::size_t n = turned.size();
  const std::size_t m = b.size();
  const SideSigns a_of_b(turned, b, frame.w, counts);
  const SideSigns b_of_a(b, turned, frame.w, counts);

  const auto index_of_a = [&](std::size_t k) { return static_cast<int>(n - 1 - k); };
  const auto side_of_a = [&](std::size_t k) { return static_cast<int>((2 * n - 2 - k) % n); };
  std::vector<OverlapCorner> corners;
  for (std::size_t i = 0; i < n; ++i) {
    if (a_of_b.inside(i)) {
      corners.push_back({OverlapCornerKind::vertex_of_a, index_of_a(i), -1, frame.project(turned[i])});
    }
  }
  for (std::size_t j = 0; j < m; ++j) {
    if (!b_of_a.inside(j)) continue;
    bool on_vertex = false;
    for (std::size_t i = 0; i < n; ++i)
      on_vertex = on_vertex || (b_of_a(j, i) == 0 && b_of_a(j, (i + n - 1) % n) == 0);
    if (!on_vertex) {
      corners.push_back({OverlapCornerKind::vertex_of_b, -1, static_cast<int>(j), frame.project(b[j])});
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next_i = (i + 1) % n;
    for (std::size_t j = 0; j < m; ++j) {
      const std::size_t next_j = (j + 1) % m;
      if (a_of_b(i, j) * a_of_b(next_i, j) >= 0 || b_of_a(j, i) * b_of_a(next_j, i) >= 0) continue;
      corners.push_back({OverlapCornerKind::crossing, side_of_a(i), static_cast<int>(j),
                         crossing_place(frame.project(turned[i]), frame.project(turned[next_i]),
                                        frame.project(b[j]), frame.project(b[next_j]))});
    }
  }
  if (corners.size() < 3) return corners;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const OverlapCorner& corner : corners) middle += corner.place;
  middle /= static_cast<double>(corners.size());
  std::stable_sort(corners.begin(), corners.end(), [&](const OverlapCorner& p, const OverlapCorner& q) {
    const Eigen::Vector2d u = p.place - middle;
    const Eigen::Vector2d v = q.place - middle;
    return std::atan2(u.y(), u.x()) < std::atan2(v.y(), v.x());
  });
  return corners;
}

}  // namespace ashlar
