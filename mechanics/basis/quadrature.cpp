// Nodes are eigenvalues of the Jacobi matrix of the three-term recurrence (Golub and Welsch 1969), modified
// in its last row for rules with prescribed ends (Golub 1973); weights are squared first components of the
// eigenvectors.
#include "mechanics/basis/quadrature.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "mechanics/basis/plane_cross.hpp"

namespace ashlar {
namespace {

/// Recurrence coefficients on [-1, 1] for the weight (1 - x)^alpha, alpha 0 or 1.
double diagonal(int k, int alpha) {
  if (alpha == 0) return 0.0;
  return -1.0 / ((2.0 * k + 1.0) * (2.0 * k + 3.0));
}
double squared_off_diagonal(int k, int alpha) {  // k >= 1
  const double n = k;
  if (alpha == 0) return n * n / (4.0 * n * n - 1.0);
  return n * (n + 1.0) / ((2.0 * n + 1.0) * (2.0 * n + 1.0));
}

SegmentRule from_jacobi_matrix(const Eigen::VectorXd& main, const Eigen::VectorXd& off, double total) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(main, off);
  SegmentRule rule;
  for (Eigen::Index k = 0; k < main.size(); ++k) {
    rule.points.push_back(0.5 * (1.0 + eigen.eigenvalues()[k]));
    rule.weights.push_back(total * eigen.eigenvectors()(0, k) * eigen.eigenvectors()(0, k));
  }
  return rule;
}

/// Solves (J - x I) y = e_last for the leading part of the Jacobi matrix. @return last component of y
double last_of_shifted_solve(const Eigen::VectorXd& main, const Eigen::VectorXd& off, double x) {
  const Eigen::Index n = main.size();
  Eigen::MatrixXd shifted = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    shifted(k, k) = main[k] - x;
    if (k + 1 < n) shifted(k, k + 1) = shifted(k + 1, k) = off[k];
  }
  return shifted.partialPivLu().solve(Eigen::VectorXd::Unit(n, n - 1))[n - 1];
}

void fill_recurrence(int count, int alpha, Eigen::VectorXd& main, Eigen::VectorXd& off) {
  main.resize(count);
  off.resize(std::max(count - 1, 0));
  for (int k = 0; k < count; ++k) {
    main[k] = diagonal(k, alpha);
    if (k > 0) off[k - 1] = std::sqrt(squared_off_diagonal(k, alpha));
  }
}

}  // namespace

SegmentRule gauss_legendre(int count) {
  Eigen::VectorXd main;
  Eigen::VectorXd off;
  fill_recurrence(count, 0, main, off);
  return from_jacobi_matrix(main, off, 1.0);
}

SegmentRule gauss_lobatto(int count) {
  Eigen::VectorXd main;
  Eigen::VectorXd off;
  fill_recurrence(count, 0, main, off);
  if (count == 2) {
    off[0] = 1.0;
  } else {
    const double left = last_of_shifted_solve(main.head(count - 1), off.head(count - 2), -1.0);
    const double right = last_of_shifted_solve(main.head(count - 1), off.head(count - 2), 1.0);
    // last diagonal a and squared off-diagonal b with  a - b left = -1,  a - b right = 1
    const double squared = 2.0 / (left - right);
    main[count - 1] = -1.0 + squared * left;
    off[count - 2] = std::sqrt(squared);
  }
  SegmentRule rule = from_jacobi_matrix(main, off, 1.0);
  rule.points.front() = 0.0;
  rule.points.back() = 1.0;
  return rule;
}

SegmentRule radau_for_triangles(int count) {
  Eigen::VectorXd main;
  Eigen::VectorXd off;
  fill_recurrence(count, 1, main, off);
  if (count == 1) return {{0.0}, {0.5}};
  const double left = last_of_shifted_solve(main.head(count - 1), off.head(count - 2), -1.0);
  main[count - 1] = -1.0 + off[count - 2] * off[count - 2] * left;
  SegmentRule rule = from_jacobi_matrix(main, off, 0.5);
  rule.points.front() = 0.0;
  return rule;
}

namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// Height of a corner over the line between its neighbours, of its length: flatter ones are cut off as triangles of their
/// own. Larger values cut off corners of good shape, smaller ones leave triangles of a fan nearly without height.
constexpr double nearly_straight = 1e-3;
/// Ratio of heights below which a corner is flatter than another: the first of those that are equal within rounding error is
/// cut off.
constexpr double flatter = 1.0 - 1e-6;
/// Doubled area of a polygon without a centroid, of its squared length: some hundred rounding errors. Smaller values have an
/// arbitrary centroid, larger ones leave out thin polygons.
constexpr double sliver = 1e-13;
/// Weight of the two middle points that counts as none: rounding errors are about 1e-16.
constexpr double no_weight = 1e-12;

/// Removes the flattest corner of a polygon if it is nearly straight. @return it, the next one and the last one
std::optional<std::array<Eigen::Vector2d, 3>> take_flat_corner(Corners& polygon) {
  const std::size_t corners = polygon.size();
  if (corners <= 3) return std::nullopt;
  double least = nearly_straight;
  std::optional<std::size_t> flattest;
  for (std::size_t k = 0; k < corners; ++k) {
    const Eigen::Vector2d& before = polygon[(k + corners - 1) % corners];
    const Eigen::Vector2d line = polygon[(k + 1) % corners] - before;
    const double height = std::abs(cross(line, polygon[k] - before));
    if (!(height < (flattest ? flatter : 1.0) * least * line.squaredNorm())) continue;
    least = height / line.squaredNorm();
    flattest = k;
  }
  if (!flattest) return std::nullopt;
  const std::array<Eigen::Vector2d, 3> corner{polygon[*flattest], polygon[(*flattest + 1) % corners],
                                              polygon[(*flattest + corners - 1) % corners]};
  polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(*flattest));
  return corner;
}

/// The rule of a triangle has an apex, the first corner, and is symmetric with respect to it: with the flat corner as
/// apex, a polygon seen from behind has the same points.
void add_triangle(const std::array<Eigen::Vector2d, 3>& corners, int degree, PolygonRule& rule) {
  const double area = 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (!(area > 0.0)) return;
  const TriangleRule triangle = triangle_rule(degree);
  for (std::size_t k = 0; k < triangle.weights.size(); ++k) {
    const Vector3& share = triangle.barycentric[k];
    rule.points.emplace_back(share[0] * corners[0] + share[1] * corners[1] + share[2] * corners[2]);
    rule.weights.push_back(triangle.weights[k] * area);
  }
}

/// Centroid of a polygon; empty for slivers whose height is within rounding error: it would be arbitrary.
std::optional<Eigen::Vector2d> centroid_of(const Corners& polygon) {
  double doubled_area = 0.0;
  double squared_length = 0.0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Eigen::Vector2d a = polygon[k] - polygon[0];
    const Eigen::Vector2d b = polygon[k + 1] - polygon[0];
    const double part = cross(a, b);
    squared_length = std::max({squared_length, a.squaredNorm(), b.squaredNorm()});
    doubled_area += part;
    centroid += part * (a + b) / 3.0;
  }
  if (!(doubled_area > sliver * squared_length)) return std::nullopt;
  return polygon[0] + centroid / doubled_area;
}

/// Triangles from the centroid to the sides.
void add_fan(const Corners& polygon, int degree, PolygonRule& rule) {
  const std::optional<Eigen::Vector2d> middle = centroid_of(polygon);
  if (!middle) return;
  const Eigen::Vector2d& centroid = *middle;
  const std::size_t corners = polygon.size();

  const SegmentRule inward = radau_for_triangles((degree + 3) / 2);
  const SegmentRule along = gauss_lobatto((degree + 4) / 2);
  const std::size_t rays = along.points.size() - 1;
  for (std::size_t k = 0; k < corners; ++k) {
    const Eigen::Vector2d& start = polygon[k];
    const Eigen::Vector2d& end = polygon[(k + 1) % corners];
    const Eigen::Vector2d& before = polygon[(k + corners - 1) % corners];
    const double area = cross(start - centroid, end - centroid);
    const double area_before = cross(before - centroid, start - centroid);
    for (std::size_t v = 0; v < rays; ++v) {
      const Eigen::Vector2d rim = start + along.points[v] * (end - start);
      const double share = v == 0 ? along.weights.front() * area + along.weights.back() * area_before
                                  : along.weights[v] * area;
      if (!(share > 0.0)) continue;  // coincident corners
      for (std::size_t u = 0; u < inward.points.size(); ++u) {
        rule.points.emplace_back(rim + inward.points[u] * (centroid - rim));
        rule.weights.push_back(inward.weights[u] * share);
      }
    }
  }
}

/// Moments about the centroid.
struct CornerMoments {
  double area = 0.0;
  std::vector<double> tributary;                         ///< area by corner, of the sum `area`
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();      ///< of the polygon
  Eigen::Matrix2d of_corners = Eigen::Matrix2d::Zero();  ///< of the tributary areas in the corners
};

CornerMoments moments_of(const Corners& polygon, const Eigen::Vector2d& centroid) {
  CornerMoments result;
  const std::size_t corners = polygon.size();
  result.tributary.assign(corners, 0.0);
  for (std::size_t k = 0; k < corners; ++k) {
    const std::size_t next = (k + 1) % corners;
    const Eigen::Vector2d a = polygon[k] - centroid;
    const Eigen::Vector2d b = polygon[next] - centroid;
    const double area = 0.5 * cross(a, b);
    const Eigen::Matrix2d squares = a * a.transpose() + b * b.transpose();
    result.area += area;
    result.tributary[k] += 0.5 * area;
    result.tributary[next] += 0.5 * area;
    result.second += area / 12.0 * (squares + (a + b) * (a + b).transpose());
    result.of_corners += 0.5 * area * squares;
  }
  return result;
}

/// Adds corners, as many points within them, and two points for the remaining moment, see affine_rule().
void add_two_rings(const Corners& polygon, PolygonRule& rule) {
  const std::optional<Eigen::Vector2d> centroid = centroid_of(polygon);
  if (!centroid) return;
  const CornerMoments moments = moments_of(polygon, *centroid);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> shares(moments.second, moments.of_corners);
  // Bounds for every convex polygon; rounding errors of needles may exceed them.
  const auto bounded = [](double found) { return found > 1.0 / 6.0 ? std::min(found, 0.5) : 1.0 / 6.0; };
  const double share = bounded(shares.eigenvalues()[0]);
  const double remainder = 1.0 - share / bounded(shares.eigenvalues()[1]);
  const double middle = remainder > no_weight ? remainder : 0.0;
  const double outer = 0.5 * share;
  const double inner = 1.0 - outer - middle;
  const double scale = std::sqrt((share - outer) / inner);
  for (const auto& [weight, size] : {std::pair(outer, 1.0), std::pair(inner, scale)}) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      if (!(moments.tributary[k] > 0.0)) continue;  // coincident corners
      rule.points.emplace_back(size == 1.0 ? polygon[k] : *centroid + size * (polygon[k] - *centroid));
      rule.weights.push_back(weight * moments.tributary[k]);
    }
  }
  if (middle == 0.0) return;
  // M - b S = (1 - b/b') (M x) (M x)' of the eigenvector x of b', x' M x = 1.
  const Eigen::Vector2d moment = moments.second * shares.eigenvectors().col(1);
  const Eigen::Vector2d arm = moment / std::sqrt(shares.eigenvectors().col(1).dot(moment) * moments.area);
  for (const double side : {-1.0, 1.0}) {
    rule.points.emplace_back(*centroid + side * arm);
    rule.weights.push_back(0.5 * middle * moments.area);
  }
}

}  // namespace

PolygonRule polygon_rule(const std::vector<Eigen::Vector2d>& polygon, int degree) {
  PolygonRule rule;
  if (polygon.size() < 3) return rule;
  Corners rest = polygon;
  while (const auto corner = take_flat_corner(rest)) add_triangle(*corner, degree, rule);
  add_fan(rest, degree, rule);
  return rule;
}

PolygonRule affine_rule(const std::vector<Eigen::Vector2d>& polygon) {
  PolygonRule rule;
  if (polygon.size() < 3) return rule;
  Corners rest = polygon;
  while (const auto corner = take_flat_corner(rest)) add_triangle(*corner, 2, rule);
  add_two_rings(rest, rule);
  return rule;
}

TriangleRule triangle_rule(int degree) {
  const SegmentRule outer = gauss_legendre(degree / 2 + 2);
  const SegmentRule inner = gauss_legendre(degree / 2 + 1);
  TriangleRule rule;
  for (std::size_t i = 0; i < outer.points.size(); ++i) {
    const double u = outer.points[i];
    for (std::size_t j = 0; j < inner.points.size(); ++j) {
      const double v = inner.points[j];
      rule.barycentric.emplace_back(1.0 - u, u * (1.0 - v), u * v);
      rule.weights.push_back(2.0 * u * outer.weights[i] * inner.weights[j]);
    }
  }
  return rule;
}

VolumeRule volume_rule(const TriangleMesh& mesh, const Vector3& apex, int degree) {
  // A point of the tetrahedron is apex + u (p - apex), p on the triangle; u^2 of the Jacobian needs two degrees.
  const SegmentRule height = gauss_legendre(degree / 2 + 2);
  const TriangleRule base = triangle_rule(degree);
  VolumeRule rule;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 a = mesh.points[static_cast<std::size_t>(i)] - apex;
    const Vector3 b = mesh.points[static_cast<std::size_t>(j)] - apex;
    const Vector3 c = mesh.points[static_cast<std::size_t>(k)] - apex;
    const double half_determinant = 0.5 * a.dot(b.cross(c));
    if (half_determinant == 0.0) continue;
    for (std::size_t n = 0; n < base.weights.size(); ++n) {
      const Vector3& l = base.barycentric[n];
      const Vector3 side = l[0] * a + l[1] * b + l[2] * c;
      for (std::size_t m = 0; m < height.points.size(); ++m) {
        const double u = height.points[m];
        rule.points.emplace_back(apex + u * side);
        rule.weights.push_back(half_determinant * u * u * base.weights[n] * height.weights[m]);
      }
    }
  }
  return rule;
}

}  // namespace ashlar
