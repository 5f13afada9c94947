// Contact matrices against finite differences of their energies, and against the matrices of theory.md
// section 7.
#include "solver/contact_pair.hpp"

#include <gtest/gtest.h>

#include "support/check_derivatives.hpp"
#include "support/simulations.hpp"

namespace ashlar {
namespace {

using test_support::block_of;

struct Setting {
  BlockModel a;
  BlockModel b;
  std::vector<ContactPoint> points;
};

/// Two blocks of different orders with one point in each other, seen along a skew normal.
Setting skew_setting(double gap) {
  Setting setting{
      BlockModel(block_of("A", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), {2000, 1e8, 0.2}, 2)),
      BlockModel(block_of("B", Polyhedron(make_box({-1, -1, 0}, {2, 2, 1})), {2000, 1e8, 0.2}, 3)),
      {}};
  ContactPoint point{};
  point.material_a = {0.3, 0.7, 1.0};
  point.material_b = {0.35, 0.6, 0.95};
  point.normal = Vector3(0.2, -0.1, 1.0).normalized();
  const ViewFrame frame(Vector3::Zero(), point.normal);
  point.tangent_1 = frame.e1;
  point.tangent_2 = frame.e2;
  point.gap = gap;
  point.area = 0.25;
  setting.points = {point};
  return setting;
}

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd result(a.size() + b.size());
  result << a, b;
  return result;
}

TEST(ContactPair, ForcesAndTangentsAreDerivativesOfTheEnergy) {
  const JointLaw law{2e9, 1e9, 10.0, 0.0, 0.0, true};
  for (const double gap : {-1e-3, 1e-3}) {
    const Setting setting = skew_setting(gap);
    PointMemory memory;
    memory.slip = 1e-4 * setting.points[0].tangent_1;
    const ContactPair pair(0, 1, setting.a, setting.b, law, setting.points, {memory});
    const int na = setting.a.unknowns();
    const int nb = setting.b.unknowns();
    const auto respond = [&](const Eigen::VectorXd& y) {
      return pair.respond(y.head(na), y.tail(nb), false);
    };
    const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(na + nb, -1e-5, 1e-5);
    const PairResponse response = respond(start);
    ASSERT_EQ(response.points[0].state, gap < 0 ? ContactState::locked : ContactState::open);
    const auto energy = [&](const Eigen::VectorXd& y) {
      return Eigen::VectorXd::Constant(1, ContactPair::energy(respond(y)));
    };
    const Eigen::VectorXd force = joined(response.force_on_a, response.force_on_b);
    if (gap > 0) {
      EXPECT_EQ(force.norm(), 0.0);
      continue;
    }
    test_support::expect_derivative(energy, start, -force.transpose(), 1e-7, 1e-6);
    const ContactPair::Tangent tangent = pair.tangent(response);
    Eigen::MatrixXd matrix(na + nb, na + nb);
    matrix << tangent.aa, tangent.ab, tangent.ab.transpose(), tangent.bb;
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
          const PairResponse r = respond(y);
          return joined(r.force_on_a, r.force_on_b);
        },
        start, -matrix, 1e-7, 1e-6);
  }
}

TEST(ContactPair, MatricesAreThoseOfTheTheory) {
  const double kn = 2e9 * 0.25;
  const double ks = 1e9 * 0.25;
  const Setting setting = skew_setting(-1e-3);
  const ContactPoint& point = setting.points[0];
  const ContactPair pair(0, 1, setting.a, setting.b, {2e9, 1e9, 10.0, 0.0, 0.0, true}, setting.points,
                         {PointMemory{}});
  // C is (3, 3p): x = C q with q stacked column by column.
  const auto c_matrix = [](const BlockModel& block, const Vector3& at) {
    const Eigen::VectorXd phi = block.basis().values(at);
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(3, 3 * phi.size());
    for (int i = 0; i < 3; ++i) c.block(i, i * phi.size(), 1, phi.size()) = phi.transpose();
    return c;
  };
  const Eigen::MatrixXd ci = c_matrix(setting.a, point.material_a);
  const Eigen::MatrixXd cj = c_matrix(setting.b, point.material_b);
  const Eigen::RowVectorXd h = point.normal.transpose() * ci;
  const Eigen::RowVectorXd q = point.normal.transpose() * cj;
  const PairResponse response =
      pair.respond(Eigen::VectorXd::Zero(ci.cols()), Eigen::VectorXd::Zero(cj.cols()), false);
  const ContactPair::Tangent tangent = pair.tangent(response);
  const auto near = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).norm() < 1e-12 * b.norm();
  };
  EXPECT_TRUE(near(tangent.aa, kn * h.transpose() * h + ks * (ci.transpose() * ci - h.transpose() * h)));
  EXPECT_TRUE(near(tangent.ab, -kn * h.transpose() * q - ks * (ci.transpose() * cj - h.transpose() * q)));
  EXPECT_TRUE(near(tangent.bb, kn * q.transpose() * q + ks * (cj.transpose() * cj - q.transpose() * q)));
  EXPECT_TRUE(near(response.force_on_a, -kn * point.gap * h.transpose()));
  EXPECT_TRUE(near(response.force_on_b, kn * point.gap * q.transpose()));
}

}  // namespace
}  // namespace ashlar
