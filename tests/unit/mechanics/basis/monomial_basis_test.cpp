#include "mechanics/basis/monomial_basis.hpp"

#include <gtest/gtest.h>

#include "mechanics/material/elasticity.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::monomial_basis_test {
namespace {

/// Coefficients of the monomials in the orthonormal basis: both span the same space.
Eigen::MatrixXd in_orthonormal(const MonomialBasis& monomials, const PolynomialBasis& basis,
                               const Polyhedron& solid) {
  std::vector<Vector3> points;
  for (const auto& [point, weight] : test_support::volume_rule(solid, 2 * basis.order()))
    points.push_back(point);
  return basis.values(points).colPivHouseholderQr().solve(monomials.values(points)).transpose();
}

TEST(MonomialBasis, GramAndStiffnessAreThoseOfTheOrthonormalBasis) {
  const Polyhedron solid = test_support::l_shaped_prism();
  const Material material{1.0, 2.5, 0.3};
  const int order = 3;
  const PolynomialBasis basis(solid, order);
  const Eigen::MatrixXd stiffness = elastic_stiffness(basis, material);
  for (const MonomialOrigin origin :
       {MonomialOrigin::global, MonomialOrigin::centred, MonomialOrigin::scaled}) {
    const MonomialBasis monomials(solid, order, origin);
    const Eigen::MatrixXd t = in_orthonormal(monomials, basis, solid);
    EXPECT_LT((monomials.gram() - t * t.transpose()).norm(), 1e-10 * monomials.gram().norm());
    EXPECT_LT((monomials.gram().row(0).transpose() - monomials.integrals()).norm(),
              1e-14 * monomials.gram().norm());
    const Eigen::Index p = basis.size();
    Eigen::MatrixXd expected(3 * p, 3 * p);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        expected.block(i * p, j * p, p, p) = t * stiffness.block(i * p, j * p, p, p) * t.transpose();
    }
    EXPECT_LT((monomials.stiffness(material) - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(MonomialBasis, ValuesOfTheUnitCube) {
  const MonomialBasis monomials(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), 2, MonomialOrigin::global);
  const Eigen::MatrixXd values = monomials.values({Vector3(2, 3, 5)});
  const Eigen::RowVectorXd expected = (Eigen::RowVectorXd(10) << 1, 2, 3, 5, 4, 6, 10, 9, 15, 25).finished();
  EXPECT_EQ(values.row(0), expected);
  EXPECT_DOUBLE_EQ(monomials.gram()(1, 1), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(monomials.gram()(1, 2), 0.25);
}

}  // namespace
}  // namespace ashlar::monomial_basis_test
