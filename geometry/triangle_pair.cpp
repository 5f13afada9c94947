#include "geometry/triangle_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/closest_simplex.hpp"
#include "geometry/convex_contact.hpp"
#include "geometry/rounding_mode.hpp"

namespace ashlar {

namespace {

// All quantities below are polynomials of degree k <= 4 in differences of points. With M twice the greatest
// extent of the pair along an axis, every factor, sums of two differences included, is at most M, and none
// has more than 18 terms of degree 4, 12 of degree 3 or 6 of degree 2. Each term takes part in at most 16
// roundings, so the computed value errs by less than 18 * 16 * 2^-53 (1 + 2^-40) M^4 < 2^-44 M^4, and
// likewise for the lower degrees. Terms that underflow lose less than 2^-1070 max(1, M^3), which the same
// bound covers for the M allowed here.
class StaticFilter {
 public:
  StaticFilter(const TriangleCorners& a, const TriangleCorners& b) : a_(a), b_(b) {
    Vector3 low = a[0], high = a[0];
    for (const Vector3& p : {a[1], a[2], b[0], b[1], b[2]}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double extent = 2.0 * (high - low).maxCoeff();
    usable_ = extent > 0x1p-200 && extent < 0x1p200;
    bound_[1] = 0x1p-44 * extent;
    for (int k = 2; k <= 4; ++k) bound_[k] = bound_[k - 1] * extent;
  }

  // The type if the simplex is certainly the closest one and nothing is parallel to anything, or if the
  // origin is certainly inside it.
  [[nodiscard]] std::optional<TrianglePairType> certify(const CornerSimplex& simplex) {
    simplex_ = &simplex;
    if (!usable_) return std::nullopt;
    for (int k = 0; k < simplex.size; ++k) d_[k] = a_[simplex.pairs[k].a] - b_[simplex.pairs[k].b];
    if (simplex.size == 4) return tetrahedron_case();
    if (!(simplex.size == 1 ? point_case() : simplex.size == 2 ? segment_case() : triangle_case()))
      return std::nullopt;
    const std::optional<int> corners_of_a = support(a_, 1.0, &CornerPair::a, &CornerPair::b);
    const std::optional<int> corners_of_b = support(b_, -1.0, &CornerPair::b, &CornerPair::a);
    if (!corners_of_a || !corners_of_b) return std::nullopt;
    const int a_dim = *corners_of_a - 1, b_dim = *corners_of_b - 1;
    return TrianglePairType{Relation::apart, contact_type(a_dim, b_dim), a_dim, b_dim, 0};
  }

 private:
  [[nodiscard]] Vector3 between(int k, int l) const {
    const CornerPair &p = simplex_->pairs[k], &q = simplex_->pairs[l];
    if (p.b == q.b) return a_[q.a] - a_[p.a];
    if (p.a == q.a) return b_[p.b] - b_[q.b];
    return (a_[q.a] - a_[p.a]) + (b_[p.b] - b_[q.b]);
  }
  bool point_case() {
    w_ = d_[0];
    degree_ = 1;
    return true;
  }
  bool segment_case() {
    const Vector3 e = between(0, 1);
    const double along = d_[0].dot(e);
    if (!(along < -bound_[2]) || !(d_[1].dot(e) > bound_[2])) return false;
    w_ = d_[0] * e.squaredNorm() - e * along;
    degree_ = 3;
    return true;
  }
  bool triangle_case() {
    w_ = between(0, 1).cross(between(0, 2));
    degree_ = 2;
    for (int k = 0; k < 3; ++k)
      if (!(w_.dot(d_[k].cross(between(k, (k + 1) % 3))) > bound_[4])) return false;
    const double side = w_.dot(d_[0]);
    if (side < 0.0) w_ = -w_;
    return std::abs(side) > bound_[3];
  }
  // The origin inside a tetrahedron of D is inside D: no plane separates the two, not even weakly.
  [[nodiscard]] std::optional<TrianglePairType> tetrahedron_case() const {
    const double v0 = d_[1].dot(d_[2].cross(d_[3])), v1 = -d_[0].dot(d_[2].cross(d_[3])),
                 v2 = d_[0].dot(d_[1].cross(d_[3])), v3 = -d_[0].dot(d_[1].cross(d_[2]));
    if (std::min({v0, v1, v2, v3}) > bound_[3] || std::max({v0, v1, v2, v3}) < -bound_[3])
      return TrianglePairType{Relation::crossing, ContactType::crossing, 2, 2, 1};
    return std::nullopt;
  }
  // The number of corners of the simplex in one triangle, if they tie by construction (see closest_simplex)
  // and the others are strictly farther along w.
  [[nodiscard]] std::optional<int> support(const TriangleCorners& x, double orientation, int CornerPair::*own,
                                           int CornerPair::*other) const {
    const auto& p = simplex_->pairs;
    const int first = p[0].*own;
    int count = 1;
    for (int v = 0; v < 3; ++v) {
      if (v == first) continue;
      bool ties = false;
      for (int k = 0; k < simplex_->size; ++k)
        for (int l = 0; l < simplex_->size; ++l)
          ties = ties || (p[k].*own == v && p[l].*own == first && p[k].*other == p[l].*other);
      if (ties)
        ++count;
      else if (!(orientation * w_.dot(x[v] - x[first]) > bound_[degree_ + 1]))
        return std::nullopt;
    }
    return count;
  }

  const TriangleCorners &a_, &b_;
  const CornerSimplex* simplex_ = nullptr;
  bool usable_ = false;
  std::array<double, 5> bound_{};  // by degree
  std::array<Vector3, 4> d_;       // corners of D = A - B
  Vector3 w_;
  int degree_ = 0;  // of w
};

[[gnu::noinline]] std::optional<TrianglePairType> classify_to_nearest(const TriangleCorners& a,
                                                                      const TriangleCorners& b) {
  return StaticFilter(a, b).certify(guess_closest_simplex(a, b));
}

}  // namespace

TrianglePairType classify_triangles(const TriangleCorners& a, const TriangleCorners& b) {
  {
    const NearestRounding nearest;
    if (const auto type = classify_to_nearest(a, b)) return *type;
  }
  const ConvexContact contact =
      classify(ConvexShape::from_triangle(a[0], a[1], a[2]), ConvexShape::from_triangle(b[0], b[1], b[2]));
  const ContactRegion& region = contact.region;
  return {contact.relation, region.type, region.a_dimension, region.b_dimension, region.dimension};
}

}  // namespace ashlar
