// Bounds. All floating geometry is relative to the query x: a = fl(A - x) has a relative error of u = 2^-53
// in every coordinate. Let R bound |a|, |b|, |c|. A floating nearest point p = a + s (b - a) + t (c - a),
// whatever s, t in the triangle, is within 16 u R of a true point of the triangle, so
//   distance <= |p| + 16 u R.
// Every point of the triangle is at least as far along g = p as its lowest corner, for any g:
//   distance >= min(g.a, g.b, g.c) / |g| - 16 u R.
// The rounding error of the two right sides is below 8 u R, for which the factor is doubled. If |p|^2 is not a normal
// number, the error of |p| is less than 2^-510, far below u R, and the second bound is not used.
#include "geometry/any_solid/closest_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/any_solid/solid_features.hpp"
#include "geometry/exact/direction_constructions.hpp"
#include "geometry/exact/rounding_mode.hpp"

namespace ashlar {

namespace {

// The bounds consist of polynomials of degree 4, and of quotients that are checked for underflow.
constexpr int bounds_degree = 4;

// Parts of a triangle: corners 0 to 2, sides 3 to 5 (side k from corner k - 3 to the next one), inner part 6.
constexpr int first_side = 3, inner_part = 6, part_count = 7;

// Corners relative to the query; the regions of Ericson (2005), section 5.1.5.
std::pair<int, Vector3> guess_nearest(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return {0, a};
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return {1, b};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {3, a + (d1 / (d1 - d3)) * ab};
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return {2, c};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {5, a + (d2 / (d2 - d6)) * ac};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {4, b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b)};
  const double scale = 1.0 / (va + vb + vc);
  return {inner_part, a + ab * std::clamp(vb * scale, 0.0, 1.0) +
                          ac * std::clamp(vc * scale, 0.0, 1.0 - std::clamp(vb * scale, 0.0, 1.0))};
}

RationalVector rational_difference(const Vector3& p, const Vector3& q) {
  return difference(to_rational(p), to_rational(q));
}

}  // namespace

class ClosestPointFinder::Surface {
 public:
  explicit Surface(Polyhedron solid)
      : solid_(std::move(solid)), features_(solid_), tree_(boxes(solid_.mesh()), 1), packed_(tree_) {
    const TriangleMesh& mesh = solid_.mesh();
    for (const Vector3& p : mesh.points)
      for (int i = 0; i < 3; ++i) range_.include(p[i]);
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      const auto& v = mesh.triangles[t];
      auto& parts = parts_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        parts[k] = features_.feature_of_point(v[k], t);
        parts[first_side + k] = features_.feature_of_side(v[k], v[(k + 1) % 3], t);
      }
      parts[inner_part] = {2, solid_.face_of_triangle()[t]};
    }
    // In the order of the tree: triangles visited together are stored together.
    for (const int t : tree_.items()) {
      const auto& v = mesh.triangles[t];
      corners_.push_back({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]});
    }
  }
  [[nodiscard]] const Polyhedron& solid() const { return solid_; }
  [[nodiscard]] const BoxTree& tree() const { return tree_; }

  // Separate from find() so that no arithmetic is moved across the change of the rounding mode.
  [[gnu::noinline]] [[nodiscard]] ClosestPoint find_to_nearest(const Vector3& x, bool any) const {
    NumericRange range = range_;
    for (int i = 0; i < 3; ++i) range.include(x[i]);
    PredicateLadder ladder;
    ladder.open(range);
    std::vector<Candidate> candidates = ladder.allows(bounds_degree) ? near_triangles(x) : all_triangles();
    if (any && ladder.allows(bounds_degree)) {
      const auto first =
          std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& p, const Candidate& q) { return p.lower < q.lower; });
      candidates = {*first};
    }
    for (Candidate& c : candidates) c.part = certified_part(x, c, ladder);
    return answer(x, nearest(x, candidates), ladder);
  }

 private:
  struct Candidate {
    int triangle;
    int part;
    double lower;
  };

  static std::vector<Box> boxes(const TriangleMesh& mesh) {
    std::vector<Box> result(mesh.triangles.size());
    for (std::size_t t = 0; t < result.size(); ++t)
      for (const int v : mesh.triangles[t]) result[t].include(mesh.points[v]);
    return result;
  }

  // All triangles that are not certainly farther than some other one.
  [[nodiscard]] std::vector<Candidate> near_triangles(const Vector3& x) const {
    std::vector<Candidate> candidates;
    candidates.reserve(16);
    double best = std::numeric_limits<double>::infinity();
    const Box& all = tree_.nodes()[0].box;
    constexpr double error_units = 32.0 * TrackedNumber::unit_roundoff;
    const double error = error_units * (all.high - x).cwiseAbs().cwiseMax((all.low - x).cwiseAbs()).sum();
    packed_.for_each_near(
        x, [&] { return best * best; },
        [&](int k) {
          const auto& [a, b, c] = corners_[k];
          add_candidate(k, {a - x, b - x, c - x}, error, best, candidates);
        });
    std::erase_if(candidates, [&](const Candidate& c) { return c.lower > best; });
    return candidates;
  }
  // The square root of the lower bound is computed only if its square does not exclude the triangle.
  void add_candidate(int k, const std::array<Vector3, 3>& corners, double error, double& best,
                     std::vector<Candidate>& candidates) const {
    const auto& [a, b, c] = corners;
    constexpr double rounding = 1.0 - 0x1p-49, smallest = std::numeric_limits<double>::min();
    const auto [part, p] = guess_nearest(a, b, c);
    const double squared = p.squaredNorm(), limit = best + error;
    const double lowest = std::min({p.dot(a), p.dot(b), p.dot(c)}), bound = limit * limit * squared;
    const bool is_precise = squared > smallest && bound > smallest;
    if (is_precise && lowest > 0.0 && lowest * lowest * rounding > bound) return;
    const double length = std::sqrt(squared);
    best = std::min(best, length + error);
    const double lower = is_precise ? lowest / length - error : 0.0;
    candidates.push_back({tree_.items()[k], part, lower});
  }

  [[nodiscard]] std::vector<Candidate> all_triangles() const {
    std::vector<Candidate> candidates;
    candidates.reserve(solid_.mesh().triangles.size());
    for (int t = 0; t < static_cast<int>(solid_.mesh().triangles.size()); ++t)
      candidates.push_back({t, inner_part, 0.0});
    return candidates;
  }

  [[nodiscard]] const Vector3& corner(int t, int k) const {
    return solid_.mesh().points[solid_.mesh().triangles[t][k % 3]];
  }
  [[nodiscard]] ContactDirection normal(int t) const {
    return ContactDirection::cross({&corner(t, 1), &corner(t, 0)}, {&corner(t, 2), &corner(t, 0)});
  }

  // The seven sets of points x with their nearest point in a part are a partition of space.
  [[nodiscard]] bool is_nearest_part(const Vector3& x, int t, int part, PredicateLadder& ladder) const {
    const auto along = [&](int from, int to) {
      const ContactDirection side = ContactDirection::along({&corner(t, to), &corner(t, from)});
      return sign_along(side, x, corner(t, from), ladder);
    };
    if (part < first_side) return along(part, part + 1) <= 0 && along(part, part + 2) <= 0;
    if (part < inner_part) {
      const int from = part - first_side;
      return along(from, from + 1) > 0 && along(from + 1, from) > 0 &&
             sign_turn(normal(t), corner(t, from), corner(t, from + 1), x, ladder) <= 0;
    }
    const ContactDirection up = normal(t);
    for (int k = 0; k < 3; ++k)
      if (sign_turn(up, corner(t, k), corner(t, k + 1), x, ladder) <= 0) return false;
    return true;
  }
  [[nodiscard]] int certified_part(const Vector3& x, const Candidate& c, PredicateLadder& ladder) const {
    if (is_nearest_part(x, c.triangle, c.part, ladder)) return c.part;
    for (int part = 0; part < part_count; ++part)
      if (part != c.part && is_nearest_part(x, c.triangle, part, ladder)) return part;
    throw std::logic_error("a triangle has a nearest point");
  }

  // Identifies a part by its points of the mesh, which other triangles may share.
  [[nodiscard]] std::array<int, 3> element(const Candidate& c) const {
    const auto& v = solid_.mesh().triangles[c.triangle];
    if (c.part == inner_part) return {v[0], v[1], v[2]};
    if (c.part < first_side) return {v[c.part], -1, -1};
    const auto [low, high] = std::minmax(v[c.part - first_side], v[(c.part - first_side + 1) % 3]);
    return {low, high, -1};
  }
  [[nodiscard]] const ContactFeature& feature(const Candidate& c) const { return parts_[c.triangle][c.part]; }
  [[nodiscard]] Rational squared_distance(const Vector3& x, const Candidate& c) const {
    const int from = c.part < first_side ? c.part : c.part < inner_part ? c.part - first_side : 0;
    const RationalVector d = rational_difference(x, corner(c.triangle, from));
    if (c.part < first_side) return dot_product(d, d);
    const RationalVector u = rational_difference(corner(c.triangle, from + 1), corner(c.triangle, from));
    if (c.part < inner_part) {
      const RationalVector w = cross_product(d, u);
      return Rational(dot_product(w, w) / dot_product(u, u));
    }
    const RationalVector n =
        cross_product(u, rational_difference(corner(c.triangle, 2), corner(c.triangle, 0)));
    const Rational height = dot_product(n, d);
    return Rational(height * height / dot_product(n, n));
  }
  [[nodiscard]] Candidate nearest(const Vector3& x, const std::vector<Candidate>& candidates) const {
    const Candidate& first = candidates.front();
    const bool is_one = std::all_of(candidates.begin() + 1, candidates.end(), [&](const Candidate& c) {
      return c.part == inner_part ? c.triangle == first.triangle : element(c) == element(first);
    });
    if (is_one) return first;
    const auto rank = [this](const Candidate& c) {
      return std::pair(feature(c).dimension, feature(c).index);
    };
    const Candidate* best = nullptr;
    Rational least;
    for (const Candidate& c : candidates) {
      Rational squared = squared_distance(x, c);
      const int order = best == nullptr ? -1 : cmp(squared, least);
      if (order > 0 || (order == 0 && rank(c) >= rank(*best))) continue;
      best = &c;
      least = std::move(squared);
    }
    return *best;
  }

  [[nodiscard]] PointPlace place(const Vector3& x, const Candidate& c, PredicateLadder& ladder) const {
    const ContactFeature& f = feature(c);
    if (f.dimension == 2) {
      const int side = sign_along(normal(c.triangle), x, corner(c.triangle, 0), ladder);
      return side > 0 ? PointPlace::outside : side < 0 ? PointPlace::inside : PointPlace::on_surface;
    }
    const bool outside = f.dimension == 1 ? features_.edges()[f.index].convex
                                          : features_.lies_beyond(f.index, x, ladder.allows(6));
    return outside ? PointPlace::outside : PointPlace::inside;
  }

  [[nodiscard]] ClosestPoint answer(const Vector3& x, const Candidate& c, PredicateLadder& ladder) const {
    ClosestPoint result;
    result.feature = feature(c);
    if (c.part < first_side) {
      result.point = corner(c.triangle, c.part);
      result.squared_distance = squared_length(x, result.point, ladder);
    } else if (c.part < inner_part) {
      const Vector3 &a = corner(c.triangle, c.part - first_side),
                    &b = corner(c.triangle, c.part - first_side + 1);
      result.point = plane_point(ContactDirection::along({&b, &a}), a, b, x, ladder);
      result.squared_distance = squared_distance_to_line(x, c, a, b, ladder);
    } else {
      const ContactDirection up = normal(c.triangle);
      const ContactHeight height(up, {&x, &corner(c.triangle, 0)}, ladder);
      result.point = height.below(x);
      result.squared_distance = height.squared();
    }
    // A nonzero distance rounds to zero only if products underflow.
    const bool on_surface = result.squared_distance == 0.0 && sgn(squared_distance(x, c)) == 0;
    result.place = on_surface ? PointPlace::on_surface : place(x, c, ladder);
    return result;
  }
  [[nodiscard]] static double squared_length(const Vector3& x, const Vector3& p,
                                             const PredicateLadder& ladder) {
    if (ladder.allows(2)) {
      const NumberVector<DoubleDouble> d = evaluate<DoubleDouble>({&x, &p});
      if (const auto value = rounded(dot(d, d))) return *value;
    }
    const RationalVector d = rational_difference(x, p);
    const Rational squared = dot_product(d, d);
    return round_to_nearest(squared.get_mpq_t());
  }
  [[nodiscard]] double squared_distance_to_line(const Vector3& x, const Candidate& c, const Vector3& a,
                                                const Vector3& b, const PredicateLadder& ladder) const {
    if (ladder.floating) {
      const NumberVector<DoubleDouble> u = evaluate<DoubleDouble>({&b, &a});
      const NumberVector<DoubleDouble> w = cross(evaluate<DoubleDouble>({&x, &a}), u);
      if (const auto ratio = quotient(dot(w, w), dot(u, u)))
        if (const auto value = rounded(*ratio)) return *value;
    }
    const Rational squared = squared_distance(x, c);
    return round_to_nearest(squared.get_mpq_t());
  }

  Polyhedron solid_;
  SolidFeatures features_;  // refers to solid_
  BoxTree tree_;            // one triangle a leaf
  PackedBoxTree packed_;
  NumericRange range_;
  std::vector<std::array<Vector3, 3>> corners_;                // in the order of the tree's items
  std::vector<std::array<ContactFeature, part_count>> parts_;  // by triangle
};

ClosestPointFinder::ClosestPointFinder(Polyhedron solid)
    : surface_(std::make_unique<const Surface>(std::move(solid))) {}
ClosestPointFinder::~ClosestPointFinder() = default;
ClosestPointFinder::ClosestPointFinder(ClosestPointFinder&&) noexcept = default;
ClosestPointFinder& ClosestPointFinder::operator=(ClosestPointFinder&&) noexcept = default;

const Polyhedron& ClosestPointFinder::solid() const {
  return surface_->solid();
}

const BoxTree& ClosestPointFinder::triangle_boxes() const {
  return surface_->tree();
}

ClosestPoint ClosestPointFinder::find(const Vector3& x) const {
  if (!x.allFinite()) throw std::invalid_argument("point must be finite");
  const NearestRounding nearest;
  return surface_->find_to_nearest(x, false);
}

ClosestPoint ClosestPointFinder::find_any(const Vector3& x) const {
  if (!x.allFinite()) throw std::invalid_argument("point must be finite");
  const NearestRounding nearest;
  return surface_->find_to_nearest(x, true);
}

}  // namespace ashlar
