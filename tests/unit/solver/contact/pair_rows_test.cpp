#include "solver/contact/pair_rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/simulations.hpp"

namespace ashlar::pair_rows_test {
namespace {

using test_support::block_of;

/// Three points between two blocks, each seen along a normal of its own.
std::vector<ContactPoint> skew_points() {
  std::vector<ContactPoint> points;
  for (const Vector3& normal : {Vector3(0.2, -0.1, 1.0), Vector3(0.0, 0.0, 1.0), Vector3(-0.7, 0.4, 0.5)}) {
    ContactPoint point{};
    point.place_a = point.place_b = Vector3::Zero();
    point.material_a = Vector3(0.3, 0.5, 1.0) + 0.2 * normal;
    point.material_b = point.material_a - Vector3(0.0, 0.1, 0.05);
    const ViewFrame frame(Vector3::Zero(), normal.normalized());
    point.normal = normal.normalized();
    point.tangent_1 = frame.e1;
    point.tangent_2 = frame.e2;
    point.area = 0.25;
    points.push_back(point);
  }
  return points;
}

struct Subject {
  BlockModel a;
  BlockModel b;
  BlockState state_a = a.initial_state();
  BlockState state_b = b.initial_state();
  std::vector<ContactPoint> points = skew_points();
  PairRows rows{{&a, &state_a, nullptr}, {&b, &state_b, nullptr}, points};
};

BlockDefinition base() {
  return block_of("B", Polyhedron(make_box({-1, -1, 0}, {2, 2, 1})), {2000, 1e8, 0.2}, 2);
}

/// The upper block is of order 3, the lower one free, held along two axes, or fixed.
std::vector<Subject> subjects() {
  const BlockModel a(block_of("A", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), {2000, 1e8, 0.2}, 3));
  BlockDefinition held = base();
  BlockSupport support;
  support.where = Plane{{0, 0, 0}, {0, 0, -1}};
  support.components = {true, false, true};
  held.supports.push_back(support);
  BlockDefinition fixed = base();
  fixed.fixed = true;
  std::vector<Subject> result;
  for (const BlockDefinition& lower : {base(), held, fixed}) result.push_back({a, BlockModel(lower)});
  return result;
}

/// Any response: a symmetric tangent and a coupling at the points; the second one is open.
PairResponse some_response() {
  PairResponse response;
  for (int k = 0; k < 3; ++k) {
    MeanResponse mean;
    mean.force.setZero();
    mean.tangent.setZero();
    mean.limit = 0.0;
    const Eigen::Vector3d direction(1.0, 0.3 * k, -0.5);
    if (k != 1) {
      mean.tangent = direction * direction.transpose() + (1.0 + k) * Eigen::Matrix3d::Identity();
      mean.coupling.force = {0.0, 0.4, -0.2 * k};
      mean.coupling.by = {1.0, 0.1, 0.2};
    }
    response.means.push_back(mean);
  }
  return response;
}

Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> some(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return some(generator); });
}

TEST(PairRows, ProductsOfStiffnessesAreThoseOfTheTangent) {
  const PairResponse response = some_response();
  for (const Subject& subject : subjects()) {
    const Eigen::VectorXd da = random_vector(subject.a.unknowns(), 1);
    const Eigen::VectorXd db = random_vector(subject.b.unknowns(), 2);
    const PairTangent tangent = subject.rows.tangent(derivatives_of(response));
    Eigen::VectorXd on_a = Eigen::VectorXd::Zero(da.size());
    Eigen::VectorXd on_b = Eigen::VectorXd::Zero(db.size());
    subject.rows.add_product(subject.rows.stiffnesses(derivatives_of(response)), da, db, on_a, on_b);
    Eigen::VectorXd expected_a = tangent.aa * da;
    if (db.size() > 0) expected_a += tangent.ab * db;
    EXPECT_LT((on_a - expected_a).norm(), 1e-13 * expected_a.norm());
    ASSERT_EQ(on_b.size(), subject.b.unknowns());
    if (db.size() == 0) continue;
    const Eigen::VectorXd expected_b = tangent.ab.transpose() * da + tangent.bb * db;
    EXPECT_LT((on_b - expected_b).norm(), 1e-13 * expected_b.norm());
  }
}

TEST(PairRows, CouplingsAreForcesByMotionAtEachPoint) {
  const PairResponse response = some_response();
  for (const Subject& subject : subjects()) {
    const Eigen::VectorXd da = random_vector(subject.a.unknowns(), 3);
    const Eigen::VectorXd db = random_vector(subject.b.unknowns(), 4);
    const Eigen::Matrix3Xd motion = subject.rows.motion(da, db);
    Eigen::VectorXd forces(9);
    for (int k = 0; k < 3; ++k) {
      const Coupling& coupling = response.means[static_cast<std::size_t>(k)].coupling;
      forces.segment<3>(3 * k) = coupling.by.dot(motion.col(k)) * coupling.force;
    }
    PairResponse expected;
    subject.rows.set_forces(forces, expected);
    Eigen::VectorXd on_a = Eigen::VectorXd::Zero(da.size());
    Eigen::VectorXd on_b = Eigen::VectorXd::Zero(db.size());
    subject.rows.add_product(subject.rows.couplings(derivatives_of(response)), da, db, on_a, on_b);
    EXPECT_LT((on_a - expected.force_on_a).norm(), 1e-13 * expected.force_on_a.norm());
    ASSERT_EQ(on_b.size(), subject.b.unknowns());
    if (db.size() > 0) {
      EXPECT_LT((on_b - expected.force_on_b).norm(), 1e-13 * expected.force_on_b.norm());
    }
  }
}

TEST(PairRows, WithoutSlidingThereAreNoCouplings) {
  PairResponse response = some_response();
  for (MeanResponse& mean : response.means) mean.coupling.force.setZero();
  EXPECT_EQ(subjects().front().rows.couplings(derivatives_of(response)).cols(), 0);
}

}  // namespace
}  // namespace ashlar::pair_rows_test
