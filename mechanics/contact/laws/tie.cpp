#include "mechanics/contact/laws/tie.hpp"

#include <vector>

#include "mechanics/basis/quadrature.hpp"
#include "mechanics/contact/common_faces.hpp"

namespace ashlar {
namespace {

/// Singular values below this part of the largest belong to combinations of functions that vanish on the faces.
constexpr double rank_tolerance = 1e-10;

/// Points and weights on the common faces.
struct CommonRule {
  std::vector<Vector3> points;
  std::vector<double> weights;
};

void add_rule(const CommonPolygon& polygon, int degree, CommonRule& rule) {
  const PolygonRule part = polygon_rule(polygon.corners, degree);
  for (std::size_t k = 0; k < part.points.size(); ++k) {
    rule.points.push_back(polygon.point(part.points[k]));
    rule.weights.push_back(part.weights[k]);
  }
}

}  // namespace

Tie tie_between(const Polyhedron& solid_a, const PolynomialBasis& basis_a, const Polyhedron& solid_b,
                const PolynomialBasis& basis_b) {
  // The square of the gap is integrated exactly.
  const int degree = 2 * std::max(basis_a.order(), basis_b.order());
  CommonRule rule;
  for (const CommonPolygon& polygon : common_polygons(solid_a, solid_b)) add_rule(polygon, degree, rule);
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
