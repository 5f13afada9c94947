#include "mechanics/contact/tie.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/subfaces/view_frame.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

/// Singular values below this part of the largest belong to combinations of functions that vanish on the faces.
constexpr double rank_tolerance = 1e-10;
/// Tolerance of opposite normals of faces that face each other: rounded corners tilt them by less.
constexpr double opposite_tolerance = 1e-6;

using Polygon = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// The part of a convex polygon to the left of a line. Parts of the edge due to rounding have negligible area.
Polygon left_of(const Polygon& polygon, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& p = polygon[k];
    const Eigen::Vector2d& q = polygon[(k + 1) % polygon.size()];
    const double side_p = cross(to - from, p - from);
    const double side_q = cross(to - from, q - from);
    if (side_p >= 0.0) result.push_back(p);
    if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0))
      result.emplace_back(p + side_p / (side_p - side_q) * (q - p));
  }
  return result;
}

Polygon triangle_of(const Polyhedron& solid, int triangle, const ViewFrame& frame) {
  Polygon corners;
  for (const int point : solid.mesh().triangles[static_cast<std::size_t>(triangle)])
    corners.push_back(frame.project(solid.mesh().points[static_cast<std::size_t>(point)]));
  return corners;
}

/// Points and weights on the common faces.
struct CommonRule {
  std::vector<Vector3> points;
  std::vector<double> weights;
};

void add_common(const Polyhedron& a, const PolyhedronFace& face_a, const Polyhedron& b,
                const PolyhedronFace& face_b, int degree, CommonRule& rule) {
  const auto first = static_cast<std::size_t>(face_a.loops[0][0]);
  const ViewFrame frame(a.mesh().points[first], face_a.normal);
  for (const int ta : face_a.triangles) {
    const Polygon of_a = triangle_of(a, ta, frame);
    for (const int tb : face_b.triangles) {
      Polygon common = triangle_of(b, tb, frame);
      // Seen from outside of a, triangles of b run clockwise.
      std::reverse(common.begin(), common.end());
      for (std::size_t k = 0; k < 3 && common.size() >= 3; ++k)
        common = left_of(common, of_a[k], of_a[(k + 1) % 3]);
      if (common.size() < 3) continue;
      const PolygonRule part = polygon_rule(common, degree);
      for (std::size_t k = 0; k < part.points.size(); ++k) {
        const Eigen::Vector2d& place = part.points[k];
        rule.points.emplace_back(frame.origin + place.x() * frame.e1 + place.y() * frame.e2);
        rule.weights.push_back(part.weights[k]);
      }
    }
  }
}

bool face_each_other(const Polyhedron& a, const PolyhedronFace& face_a, const Polyhedron& b,
                     const PolyhedronFace& face_b) {
  if (face_a.normal.dot(face_b.normal) > opposite_tolerance - 1.0) return false;
  const Vector3& on_a = a.mesh().points[static_cast<std::size_t>(face_a.loops[0][0])];
  const double allowed = std::min(allowed_offset(a), allowed_offset(b));
  return std::all_of(face_b.loops[0].begin(), face_b.loops[0].end(), [&](int corner) {
    return std::abs(face_a.normal.dot(b.mesh().points[static_cast<std::size_t>(corner)] - on_a)) <= allowed;
  });
}

}  // namespace

Tie tie_between(const Polyhedron& solid_a, const PolynomialBasis& basis_a, const Polyhedron& solid_b,
                const PolynomialBasis& basis_b) {
  // The square of the gap is integrated exactly.
  const int degree = 2 * std::max(basis_a.order(), basis_b.order());
  CommonRule rule;
  for (const PolyhedronFace& face_a : solid_a.faces()) {
    for (const PolyhedronFace& face_b : solid_b.faces()) {
      if (face_each_other(solid_a, face_a, solid_b, face_b))
        add_common(solid_a, face_a, solid_b, face_b, degree, rule);
    }
  }
  Tie tie;
  for (const double weight : rule.weights) tie.area += weight;
  if (!(tie.area > 0.0)) return {};
  const Eigen::VectorXd root =
      Eigen::Map<const Eigen::VectorXd>(rule.weights.data(), static_cast<Eigen::Index>(rule.weights.size()))
          .cwiseSqrt();
  Eigen::MatrixXd gap(root.size(), basis_a.size() + basis_b.size());
  gap << root.asDiagonal() * basis_a.values(rule.points), root.asDiagonal() * basis_b.values(rule.points);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(gap);
  qr.setThreshold(rank_tolerance);
  const Eigen::MatrixXd triangle = qr.matrixQR().topRows(qr.rank()).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd rows = triangle * qr.colsPermutation().transpose();
  tie.a = rows.leftCols(basis_a.size());
  tie.b = rows.rightCols(basis_b.size());
  return tie;
}

}  // namespace ashlar
