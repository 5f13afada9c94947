#include "geometry/solid_relation.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "geometry/convex_contact.hpp"
#include "geometry/number_vector.hpp"
#include "geometry/rounding_mode.hpp"
#include "geometry/tracked_number.hpp"

namespace ashlar {

namespace {

using Rational = mpq_class;
using Point = NumberVector<Rational>;
using Triangle = std::array<int, 3>;

Point to_point(const Vector3& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}

Point difference(const Point& a, const Point& b) {
  return {Rational(a.x - b.x), Rational(a.y - b.y), Rational(a.z - b.z)};
}

Point cross_product(const Point& a, const Point& b) {
  return {Rational(a.y * b.z - a.z * b.y), Rational(a.z * b.x - a.x * b.z), Rational(a.x * b.y - a.y * b.x)};
}

Rational dot_product(const Point& a, const Point& b) {
  return Rational(a.x * b.x + a.y * b.y + a.z * b.z);
}

const Rational& component(const Point& p, int i) {
  return i == 0 ? p.x : i == 1 ? p.y : p.z;
}

// A mesh with rational coordinates besides its own.
struct Surface {
  explicit Surface(const TriangleMesh& mesh) : triangles(mesh.triangles), doubles(mesh.points) {
    NumericRange range;
    for (const Vector3& p : mesh.points) {
      points.push_back(to_point(p));
      for (int i = 0; i < 3; ++i) range.include(p[i]);
    }
    floating = range.safe();
  }
  [[nodiscard]] const Point& corner(int t, int k) const { return points[triangles[t][k]]; }
  [[nodiscard]] Point normal(int t) const {
    return cross_product(difference(corner(t, 1), corner(t, 0)), difference(corner(t, 2), corner(t, 0)));
  }
  const std::vector<Triangle>& triangles;
  const std::vector<Vector3>& doubles;
  std::vector<Point> points;
  bool floating = false;  // products of coordinates stay within the range of doubles
};

using Tracked = NumberVector<TrackedNumber>;

// Conversion cuts off, which loses less than a unit in the last place.
TrackedNumber tracked(const Rational& q) {
  const double value = q.get_d();
  return {value, 4.0 * TrackedNumber::unit_roundoff * std::abs(value)};
}

// A half-line through the cells of a surface; p in numbers of both kinds.
class Ray {
 public:
  Ray(const Surface& solid, const Point& p, long m)
      : solid_(solid),
        p_(p),
        direction_{Rational(1), Rational(m), Rational(m * m)},
        tracked_p_{tracked(p.x), tracked(p.y), tracked(p.z)},
        tracked_direction_{TrackedNumber(1.0), TrackedNumber(static_cast<double>(m)),
                           TrackedNumber(static_cast<double>(m * m))} {}

  /// Sign of the volume of the ray, from p, and two corners of a triangle.
  [[nodiscard]] int side(int t, int k) const {
    const int from = solid_.triangles[t][k], to = solid_.triangles[t][(k + 1) % 3];
    if (solid_.floating) {
      const int sign =
          sign_of(dot(tracked_direction_, cross(tracked_difference(from), tracked_difference(to))));
      if (sign != unknown_sign) return sign;
    }
    return sgn(dot_product(
        direction_, cross_product(difference(solid_.points[from], p_), difference(solid_.points[to], p_))));
  }
  [[nodiscard]] const Point& direction() const { return direction_; }

 private:
  [[nodiscard]] Tracked tracked_difference(int v) const {
    const Vector3& x = solid_.doubles[v];
    return Tracked{TrackedNumber(x[0]), TrackedNumber(x[1]), TrackedNumber(x[2])} - tracked_p_;
  }

  const Surface& solid_;
  const Point& p_;
  Point direction_;
  Tracked tracked_p_, tracked_direction_;
};

struct Location {
  enum { outside, inside, on_triangle } place;
  int triangle;  // for on_triangle: p is an inner point of it
};

// By the parity of the crossings of a ray; none if the ray meets an edge, or p is on one.
std::optional<Location> locate_along(const Surface& solid, const Point& p, const Ray& ray) {
  bool inside = false;
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t) {
    int positive = 0, negative = 0;
    for (int k = 0; k < 3 && (positive == 0 || negative == 0); ++k) {
      const int sign = ray.side(t, k);
      positive += sign > 0;
      negative += sign < 0;
    }
    if (positive > 0 && negative > 0) continue;
    if (positive + negative < 3) return std::nullopt;
    // The height of the triangle's plane over p, along its normal and along the ray.
    const Point normal = solid.normal(t);
    const int height = sgn(dot_product(normal, difference(solid.corner(t, 0), p)));
    if (height == 0) return Location{Location::on_triangle, t};
    if (height == sgn(dot_product(normal, ray.direction()))) inside = !inside;
  }
  return Location{inside ? Location::inside : Location::outside, -1};
}

// @param p not on an edge of the surface.
Location locate(const Surface& solid, const Point& p) {
  // Directions (1, m, m^2) lie in few planes with any one edge, so one that meets none comes soon.
  for (long m = 3;; ++m)
    if (const auto place = locate_along(solid, p, Ray(solid, p, m))) return *place;
}

// A line a x + b y = c in the coordinate plane onto which a triangle is projected.
struct PlaneLine {
  Rational a, b, c;
};

// Cells of one triangle between its sides and given lines.
class TriangleCells {
 public:
  TriangleCells(const Surface& surface, int t) : surface_(surface), t_(t), normal_(surface.normal(t)) {
    dropped_ = sgn(normal_.x) != 0 ? 0 : sgn(normal_.y) != 0 ? 1 : 2;
    for (int k = 0; k < 3; ++k) add_line(surface.corner(t, k), surface.corner(t, (k + 1) % 3));
  }

  /// Cuts by the edges of another triangle that lie in the plane of this one, and through its corners there:
  /// no sample is one of them.
  void cut_by(const Surface& other, int s) {
    std::array<bool, 3> in_plane;
    for (int k = 0; k < 3; ++k)
      in_plane[k] = sgn(dot_product(normal_, difference(other.corner(s, k), surface_.corner(t_, 0)))) == 0;
    for (int k = 0; k < 3; ++k)
      if (in_plane[k] && in_plane[(k + 1) % 3]) add_line(other.corner(s, k), other.corner(s, (k + 1) % 3));
    for (int k = 0; k < 3; ++k)
      if (in_plane[k]) add({Rational(1), Rational(0), u(other.corner(s, k))});
  }

  /// A point of every cell. Between two neighbouring abscissas of crossings no lines cross, so the points
  /// halfway between neighbouring lines there meet every cell that reaches into that strip.
  [[nodiscard]] std::vector<Point> samples() const {
    const std::vector<Rational> x = crossing_abscissas();
    std::vector<Point> result;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const Rational middle = (x[i] + x[i + 1]) / 2;
      std::vector<Rational> y;
      for (const PlaneLine& line : lines_)
        if (sgn(line.b) != 0) y.emplace_back((line.c - line.a * middle) / line.b);
      sort_unique(y);
      for (std::size_t k = 0; k + 1 < y.size(); ++k) {
        const Rational height = (y[k] + y[k + 1]) / 2;
        if (contains(middle, height)) result.push_back(lift(middle, height));
      }
    }
    return result;
  }

  [[nodiscard]] const Point& normal() const { return normal_; }

 private:
  [[nodiscard]] const Rational& u(const Point& p) const { return component(p, (dropped_ + 1) % 3); }
  [[nodiscard]] const Rational& v(const Point& p) const { return component(p, (dropped_ + 2) % 3); }

  static void sort_unique(std::vector<Rational>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
  void add_line(const Point& p, const Point& q) {
    PlaneLine line{Rational(v(q) - v(p)), Rational(u(p) - u(q)), Rational(0)};
    line.c = line.a * u(p) + line.b * v(p);
    add(std::move(line));
  }
  void add(PlaneLine line) {
    for (const PlaneLine& known : lines_)
      if (known.a * line.b == known.b * line.a && known.a * line.c == known.c * line.a &&
          known.b * line.c == known.c * line.b)
        return;
    lines_.push_back(std::move(line));
  }
  [[nodiscard]] std::vector<Rational> crossing_abscissas() const {
    std::vector<Rational> x;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const PlaneLine &f = lines_[i], &g = lines_[k];
        const Rational determinant = f.a * g.b - g.a * f.b;
        if (sgn(determinant) != 0) x.emplace_back((f.c * g.b - g.c * f.b) / determinant);
      }
    sort_unique(x);
    return x;
  }
  [[nodiscard]] bool contains(const Rational& x, const Rational& y) const {
    int positive = 0;
    for (int k = 0; k < 3; ++k) {
      const PlaneLine& side = lines_[k];
      positive += sgn(Rational(side.a * x + side.b * y - side.c)) > 0;
    }
    return positive == 0 || positive == 3;
  }
  [[nodiscard]] Point lift(const Rational& x, const Rational& y) const {
    const Point& o = surface_.corner(t_, 0);
    const int first = (dropped_ + 1) % 3, second = (dropped_ + 2) % 3;
    const Rational height =
        component(o, dropped_) - (component(normal_, first) * (x - component(o, first)) +
                                  component(normal_, second) * (y - component(o, second))) /
                                     component(normal_, dropped_);
    const auto pick = [&](int i) -> const Rational& { return i == dropped_ ? height : i == first ? x : y; };
    return {pick(0), pick(1), pick(2)};
  }

  const Surface& surface_;
  int t_;
  Point normal_;
  int dropped_;
  std::vector<PlaneLine> lines_;  // the first three are the sides
};

// True if some cell of A's triangles that touch B is inside B, or on B with both solids on the same side.
bool enters(const Surface& a, const Surface& b, const std::map<int, std::vector<int>>& touching) {
  for (const auto& [t, others] : touching) {
    TriangleCells cells(a, t);
    for (const int s : others) cells.cut_by(b, s);
    for (const Point& p : cells.samples()) {
      const Location location = locate(b, p);
      if (location.place == Location::inside) return true;
      if (location.place == Location::on_triangle &&
          sgn(dot_product(cells.normal(), b.normal(location.triangle))) > 0)
        return true;
    }
  }
  return false;
}

// Without common points of the boundaries: a point of one tells about all of it.
bool contains(const Surface& outer, const Surface& inner) {
  return locate(outer, inner.points[inner.triangles[0][0]]).place == Location::inside;
}

struct Box {
  Vector3 low, high;
};

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

// Rounded. Every coordinate of the gap is rounded once, and so are three squares and two sums: its relative
// error is below 4 * 2^-52.
double squared_distance(const Box& a, const Box& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).squaredNorm();
}

// Triangles of both meshes in order of box distance, as far as they can matter.
class NearestTriangles {
 public:
  NearestTriangles(const TriangleMesh& a, const TriangleMesh& b)
      : a_(a), b_(b), a_boxes_(boxes_of(a)), b_boxes_(boxes_of(b)) {}

  /// @return false if two triangles cross, which ends the search.
  bool search(SolidRelation& result) {
    result.squared_distance = std::numeric_limits<double>::infinity();
    const std::array<int, 2> first = nearest_boxes();
    if (!visit(first, result)) return false;
    for (int i = 0; i < static_cast<int>(a_boxes_.size()); ++i)
      for (int k = 0; k < static_cast<int>(b_boxes_.size()); ++k) {
        const std::array<int, 2> pair{i, k};
        if (pair == first || is_farther(squared_distance(a_boxes_[i], b_boxes_[k]), result.squared_distance))
          continue;
        if (!visit(pair, result)) return false;
      }
    std::sort(result.nearest.begin(), result.nearest.end());
    return true;
  }

 private:
  // Also for the true values; products of the smallest numbers are left to the exact answer.
  [[nodiscard]] static bool is_farther(double boxes, double best) {
    constexpr double rounding = 1.0 - 0x1p-49;
    return boxes > std::numeric_limits<double>::min() && boxes * rounding > best;
  }
  [[nodiscard]] std::array<int, 2> nearest_boxes() const {
    std::array<int, 2> nearest{0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < static_cast<int>(a_boxes_.size()); ++i)
      for (int k = 0; k < static_cast<int>(b_boxes_.size()); ++k)
        if (const double d = squared_distance(a_boxes_[i], b_boxes_[k]); d < least) {
          least = d;
          nearest = {i, k};
        }
    return nearest;
  }
  [[nodiscard]] static ConvexShape shape(const TriangleMesh& mesh, int t) {
    const auto& [i, j, k] = mesh.triangles[t];
    return ConvexShape::from_triangle(mesh.points[i], mesh.points[j], mesh.points[k]);
  }
  bool visit(const std::array<int, 2>& pair, SolidRelation& result) const {
    const ConvexContact contact =
        classify(shape(a_, pair[0]), shape(b_, pair[1]), std::nullopt, {false, false});
    result.decided_by.filter += contact.decided_by.filter;
    result.decided_by.exact += contact.decided_by.exact;
    if (contact.relation == Relation::crossing) return false;
    // A tiny distance may round to zero.
    touching_ = touching_ || contact.relation == Relation::touching;
    if (contact.squared_distance > result.squared_distance) return true;
    if (contact.squared_distance < result.squared_distance) result.nearest.clear();
    result.squared_distance = contact.squared_distance;
    result.nearest.push_back(pair);
    return true;
  }

 public:
  [[nodiscard]] bool touching() const { return touching_; }

 private:
  const TriangleMesh &a_, &b_;
  std::vector<Box> a_boxes_, b_boxes_;
  mutable bool touching_ = false;
};

bool interiors_meet(const TriangleMesh& a, const TriangleMesh& b, bool touching,
                    const std::vector<std::array<int, 2>>& pairs) {
  const Surface exact_a(a), exact_b(b);
  if (!touching) return contains(exact_a, exact_b) || contains(exact_b, exact_a);
  std::map<int, std::vector<int>> of_a, of_b;
  for (const auto& [i, k] : pairs) {
    of_a[i].push_back(k);
    of_b[k].push_back(i);
  }
  return enters(exact_a, exact_b, of_a) || enters(exact_b, exact_a, of_b);
}

// Apart from relate_solids() so that no arithmetic moves across the change of the rounding mode.
[[gnu::noinline]] SolidRelation relate_to_nearest(const TriangleMesh& a, const TriangleMesh& b) {
  SolidRelation result;
  NearestTriangles triangles(a, b);
  if (!triangles.search(result) || interiors_meet(a, b, triangles.touching(), result.nearest)) {
    result.relation = Relation::crossing;
    result.squared_distance = 0.0;
    result.nearest.clear();
  } else if (triangles.touching()) {
    result.relation = Relation::touching;
  }
  return result;
}

}  // namespace

SolidRelation relate_solids(const TriangleMesh& a, const TriangleMesh& b) {
  const NearestRounding nearest;
  return relate_to_nearest(a, b);
}

}  // namespace ashlar
