#include "geometry/convex/closest_simplex.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace ashlar {

namespace {

// The corner with the least w . x up to rounding error; any answer is allowed.
int lowest(std::span<const Vector3> points, const Vector3& w) {
  int best = 0;
  double value = w.dot(points[0]);
  for (int v = 1; v < static_cast<int>(points.size()); ++v) {
    const double candidate = w.dot(points[v]);
    if (candidate < value) {
      value = candidate;
      best = v;
    }
  }
  return best;
}

class ExactSimplexSearch {
 public:
  ExactSimplexSearch(const ConvexShape& a, const ConvexShape& b, PredicateLadder& ladder)
      : a_(a.corners()), b_(b.corners()), ladder_(ladder) {}

  ClosestSimplex run(CornerSimplex simplex) {
    while (true) {
      reduce(simplex);
      if (result_.contains_origin) break;
      const CornerPair next = farther_pair();
      const CornerPair first = result_.simplex.pairs[0];
      if (next.a == first.a && next.b == first.b) break;
      simplex = result_.simplex;
      simplex.add(next);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] Difference corner(const CornerPair& p) const { return {&a_[p.a], &b_[p.b]}; }
  // q - p as corners of D, without the cancelling half.
  [[nodiscard]] Difference between(const CornerPair& p, const CornerPair& q) const {
    if (p.b == q.b) return {&a_[q.a], &a_[p.a]};
    if (p.a == q.a) return {&b_[p.b], &b_[q.b]};
    return {&a_[q.a], &a_[p.a], &b_[p.b], &b_[q.b]};
  }

  // Finds the subset of the simplex that has the nearest point of its hull in its relative interior, the full
  // set first.
  void reduce(const CornerSimplex& simplex) {
    const int all = (1 << simplex.size) - 1;
    for (int mask = all; mask > 0; --mask) {
      result_.simplex.size = 0;
      for (int k = 0; k < simplex.size; ++k)
        if ((mask >> k & 1) != 0) result_.simplex.add(simplex.pairs[k]);
      if (!nearest_is_inside()) continue;
      if (result_.contains_origin) return;
      bool optimal = true;
      for (int k = 0; optimal && k < simplex.size; ++k)
        optimal = (mask >> k & 1) != 0 ||
                  sign_along(result_.w, between(result_.simplex.pairs[0], simplex.pairs[k]), ladder_) >= 0;
      if (optimal) return;
    }
  }

  // Sets w; false if the nearest point of the affine hull of the simplex is not inside its hull.
  bool nearest_is_inside() {
    switch (result_.simplex.size) {
      case 1:
        return point_case();
      case 2:
        return segment_case();
      case 3:
        return triangle_case();
      default:
        return tetrahedron_case();
    }
  }
  bool point_case() {
    result_.w = ContactDirection::along(corner(result_.simplex.pairs[0]));
    result_.contains_origin = is_zero(result_.w, ladder_);
    return true;
  }
  bool segment_case() {
    const auto& p = result_.simplex.pairs;
    const Difference e = between(p[0], p[1]);
    const ContactDirection along = ContactDirection::along(e);
    if (sign_along(along, corner(p[0]), ladder_) >= 0 || sign_along(along, corner(p[1]), ladder_) <= 0)
      return false;
    result_.w = ContactDirection::rejection(corner(p[0]), e);
    result_.contains_origin = is_zero(result_.w, ladder_);
    return true;
  }
  bool triangle_case() {
    const auto& p = result_.simplex.pairs;
    result_.w = ContactDirection::cross(between(p[0], p[1]), between(p[0], p[2]));
    for (int k = 0; k < 3; ++k)
      if (sign_triple(result_.w, corner(p[k]), between(p[k], p[(k + 1) % 3]), ladder_) <= 0) return false;
    const int side = sign_along(result_.w, corner(p[0]), ladder_);
    result_.contains_origin = side == 0;
    if (side < 0) result_.w.reverse();
    return true;
  }
  // Inside if the origin lies on the same side of each face as the fourth corner.
  bool tetrahedron_case() {
    const auto& p = result_.simplex.pairs;
    for (int k = 0; k < 4; ++k) {
      const CornerPair &x = p[(k + 1) % 4], &y = p[(k + 2) % 4], &z = p[(k + 3) % 4];
      const ContactDirection normal = ContactDirection::cross(between(x, y), between(x, z));
      const int origin_side = -sign_along(normal, corner(x), ladder_);
      if (origin_side == 0 || origin_side != sign_along(normal, between(x, p[k]), ladder_)) return false;
    }
    result_.contains_origin = result_.interior = true;
    return true;
  }

  // A corner pair of D strictly beyond the simplex along -w, or its first pair if there is none; the latter
  // case leaves the support corners in the result.
  CornerPair farther_pair() {
    const CornerPair first = result_.simplex.pairs[0];
    return {farthest(a_, first.a, 1, &CornerPair::a, &CornerPair::b, result_.support_a),
            farthest(b_, first.b, -1, &CornerPair::b, &CornerPair::a, result_.support_b)};
  }
  // Two corners of one shape that the simplex pairs with the same corner of the other one tie without a
  // computation: w is normal to the difference of any two pairs.
  [[nodiscard]] bool ties(int v, int CornerPair::*own, int CornerPair::*other) const {
    const auto& p = result_.simplex.pairs;
    for (int k = 0; k < result_.simplex.size; ++k)
      for (int l = 0; l < result_.simplex.size; ++l)
        if (p[k].*own == v && p[l].*own == p[0].*own && p[k].*other == p[l].*other) return true;
    return false;
  }
  int farthest(const std::vector<Vector3>& points, int first, int orientation, int CornerPair::*own,
               int CornerPair::*other, std::vector<int>& support) {
    const auto& w = result_.w.tracked();
    int best = first;
    double best_value = 0.0;
    support.clear();
    for (int v = 0; v < static_cast<int>(points.size()); ++v) {
      const int sign = v == first || ties(v, own, other)
                           ? 0
                           : orientation * sign_along(result_.w, points[v], points[first], ladder_);
      if (sign == 0) support.push_back(v);
      if (sign >= 0) continue;
      const Vector3 step = points[v] - points[first];
      const double value = orientation * (w.x.value * step[0] + w.y.value * step[1] + w.z.value * step[2]);
      if (best == first || value < best_value) {
        best = v;
        best_value = value;
      }
    }
    return best;
  }

  const std::vector<Vector3>& a_;
  const std::vector<Vector3>& b_;
  PredicateLadder& ladder_;
  ClosestSimplex result_;
};

// Floating GJK: the nearest point of a simplex of up to four corners of D by Voronoi regions. The last corner
// is the newest one; as it lies beyond the others' nearest point, only regions that contain it are looked at.
class FloatingSearch {
 public:
  FloatingSearch(std::span<const Vector3> a, std::span<const Vector3> b) : a_(a), b_(b) {}

  CornerSimplex run() {
    const Vector3 start = a_[0] - b_[0];
    simplex_.add({lowest(a_, start), lowest(b_, -start)});
    points_[0] = nearest_ = a_[simplex_.pairs[0].a] - b_[simplex_.pairs[0].b];
    double squared_norm = nearest_.squaredNorm();
    while (simplex_.size < 4 && squared_norm > 0.0) {
      const CornerPair next{lowest(a_, nearest_), lowest(b_, -nearest_)};
      const Vector3 point = a_[next.a] - b_[next.b];
      if (!(nearest_.dot(point) < squared_norm) || has(next) || completes_parallelogram(next)) break;
      points_[simplex_.size] = point;
      simplex_.add(next);
      shrink();
      const double shorter = nearest_.squaredNorm();
      if (simplex_.size == 4 || !(shorter < squared_norm)) break;
      squared_norm = shorter;
    }
    return simplex_;
  }

 private:
  [[nodiscard]] bool has(const CornerPair& p) const {
    for (int k = 0; k < simplex_.size; ++k)
      if (simplex_.pairs[k].a == p.a && simplex_.pairs[k].b == p.b) return true;
    return false;
  }
  // The last corner of the sum of two edges lies in the plane of the other three; only rounding sees it
  // nearer.
  [[nodiscard]] bool completes_parallelogram(const CornerPair& p) const {
    if (simplex_.size != 3) return false;
    int same_a = 0, same_b = 0;
    for (int k = 0; k < 3; ++k) {
      same_a += static_cast<int>(simplex_.pairs[k].a == p.a);
      same_b += static_cast<int>(simplex_.pairs[k].b == p.b);
    }
    if (same_a != 1 || same_b != 1) return false;
    for (int k = 0; k < 3; ++k) {  // the corner opposite to p is made of the others' remaining corners
      const CornerPair& q = simplex_.pairs[k];
      if (q.a == p.a || q.b == p.b) continue;
      const CornerPair &r = simplex_.pairs[(k + 1) % 3], &s = simplex_.pairs[(k + 2) % 3];
      return (r.a == p.a && r.b == q.b && s.a == q.a && s.b == p.b) ||
             (s.a == p.a && s.b == q.b && r.a == q.a && r.b == p.b);
    }
    return false;
  }
  void keep(std::initializer_list<int> which) {
    int n = 0;
    for (const int k : which) {
      simplex_.pairs[n] = simplex_.pairs[k];
      points_[n++] = points_[k];
    }
    simplex_.size = n;
  }
  void shrink() {
    if (simplex_.size == 2) {
      shrink_segment();
    } else if (simplex_.size == 3) {
      shrink_triangle();
    } else {
      shrink_tetrahedron();
    }
  }
  void shrink_segment() {
    const Vector3 e = points_[0] - points_[1];
    const double t = -points_[1].dot(e);
    if (t <= 0.0) return keep_last();
    nearest_ = points_[1] + e * (t / e.squaredNorm());
  }
  void keep_last() {
    keep({simplex_.size - 1});
    nearest_ = points_[0];
  }
  // Nearest among the segments from the last corner to corner k, and to the other one.
  void shrink_to_sides(int k, double t, int other, double other_t) {
    if (t > 0.0)
      keep({k, 2});
    else if (other_t > 0.0)
      keep({other, 2});
    else
      return keep_last();
    shrink_segment();
  }
  void shrink_triangle() {
    const Vector3 &a = points_[0], &b = points_[1], &c = points_[2];
    const Vector3 ca = a - c, cb = b - c;
    const double along_a = -c.dot(ca), along_b = -c.dot(cb);
    if (along_a <= 0.0 && along_b <= 0.0) return keep_last();
    const Vector3 normal = ca.cross(cb);
    if (normal.dot(a.cross(c)) > 0.0) return shrink_to_sides(0, along_a, 1, along_b);
    if (normal.dot(c.cross(b)) > 0.0) return shrink_to_sides(1, along_b, 0, along_a);
    nearest_ = normal * (normal.dot(c) / normal.squaredNorm());
  }
  void shrink_tetrahedron() {
    int best = -1;
    double least = 0.0;
    CornerSimplex best_simplex;
    std::array<Vector3, 4> best_points;
    Vector3 best_nearest;
    const CornerSimplex full = simplex_;
    const std::array<Vector3, 4> points = points_;
    constexpr std::array<std::array<int, 3>, 3> faces{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
    for (int f = 0; f < 3; ++f) {
      const auto& [i, j, opposite] = faces[f];
      const Vector3 normal = (points[i] - points[3]).cross(points[j] - points[3]);
      const double origin_side = -normal.dot(points[3]);
      const double inner_side = normal.dot(points[opposite] - points[3]);
      if (origin_side * inner_side > 0.0) continue;
      if (best >= 0) {  // rare: the origin is outside two faces
        best_simplex = simplex_;
        best_points = points_;
        best_nearest = nearest_;
        simplex_ = full;
        points_ = points;
      }
      keep({i, j, 3});
      shrink_triangle();
      if (best >= 0 && !(nearest_.squaredNorm() < least)) {
        simplex_ = best_simplex;
        points_ = best_points;
        nearest_ = best_nearest;
      }
      best = f;
      least = nearest_.squaredNorm();
    }
  }

  std::span<const Vector3> a_;
  std::span<const Vector3> b_;
  CornerSimplex simplex_;
  std::array<Vector3, 4> points_;
  Vector3 nearest_;
};

}  // namespace

CornerSimplex guess_closest_simplex(std::span<const Vector3> a, std::span<const Vector3> b) {
  return FloatingSearch(a, b).run();
}

ClosestSimplex find_closest_simplex(const ConvexShape& a, const ConvexShape& b, const CornerSimplex& guess,
                                    PredicateLadder& ladder) {
  return ExactSimplexSearch(a, b, ladder).run(guess);
}

std::vector<int> support_corners(const ConvexShape& shape, const ContactDirection& w, int orientation,
                                 PredicateLadder& ladder) {
  const std::vector<Vector3>& points = shape.corners();
  // Starting from the corner that rounding shows as extreme leaves almost all signs to the filter.
  const Vector3 v(w.tracked().x.value, w.tracked().y.value, w.tracked().z.value);
  const int start = lowest(points, orientation * v);
  std::vector<int> support{start};
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    if (p == start) continue;
    const int sign = orientation * sign_along(w, points[p], points[support[0]], ladder);
    if (sign < 0) support.clear();
    if (sign <= 0) support.push_back(p);
  }
  std::sort(support.begin(), support.end());
  return support;
}

}  // namespace ashlar
