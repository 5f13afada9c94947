// Contact matrices against finite differences of their energies, and against the matrices of theory.md
// section 7.
#include "solver/contact/contact_pair.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/check_derivatives.hpp"
#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::contact_pair_test {
namespace {

using test_support::block_of;
using test_support::pair_of;
using test_support::Setting;
using test_support::skew_setting;

/// No change of a block.
Eigen::VectorXd none(const BlockModel& block) {
  return Eigen::VectorXd::Zero(block.unknowns());
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
    const ContactPair pair = pair_of(setting, law, memory);
    const int na = setting.a.unknowns();
    const int nb = setting.b.unknowns();
    const auto respond = [&](const Eigen::VectorXd& y) {
      return pair.respond(y.head(na), y.tail(nb), false);
    };
    const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(na + nb, -1e-5, 1e-5);
    const PairResponse response = respond(start);
    ASSERT_EQ(response.points[0].state, gap < 0 ? ContactState::locked : ContactState::open);
    const auto energy = [&](const Eigen::VectorXd& y) {
      return Eigen::VectorXd::Constant(1, ContactPair::energies(respond(y)).total());
    };
    const Eigen::VectorXd force = joined(response.force_on_a, response.force_on_b);
    if (gap > 0) {
      EXPECT_EQ(force.norm(), 0.0);
      continue;
    }
    test_support::expect_derivative(energy, start, -force.transpose(), 1e-7, 1e-6);
    const PairTangent tangent = pair.tangent(response);
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
  const ContactPair pair = pair_of(setting, {2e9, 1e9, 10.0, 0.0, 0.0, true}, {});
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
  const PairTangent tangent = pair.tangent(response);
  const auto near = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).norm() < 1e-12 * b.norm();
  };
  EXPECT_TRUE(near(tangent.aa, kn * h.transpose() * h + ks * (ci.transpose() * ci - h.transpose() * h)));
  EXPECT_TRUE(near(tangent.ab, -kn * h.transpose() * q - ks * (ci.transpose() * cj - h.transpose() * q)));
  EXPECT_TRUE(near(tangent.bb, kn * q.transpose() * q + ks * (cj.transpose() * cj - q.transpose() * q)));
  EXPECT_TRUE(near(response.force_on_a, -kn * point.gap * h.transpose()));
  EXPECT_TRUE(near(response.force_on_b, kn * point.gap * q.transpose()));
}

TEST(ContactPair, SpringsFoundDeeperThanTheyWereAreAtRestBelowTheSurface) {
  // kn = 5e8 N/m at 2 mm holds 1000 J, ks = 2.5e8 N/m at 0.1 mm 1.25 J.
  const Setting setting = skew_setting(-2e-3);
  PointMemory memory;
  memory.slip = 1e-4 * setting.points[0].tangent_1;
  const JointLaw law{2e9, 1e9, 10.0, 0.0, 0.0, true};
  const Eigen::VectorXd still_a = Eigen::VectorXd::Zero(setting.a.unknowns());
  const Eigen::VectorXd still_b = Eigen::VectorXd::Zero(setting.b.unknowns());
  ContactPair pair = pair_of(setting, law, memory);
  EXPECT_NEAR(pair.start_energy(), 1001.25, 1e-9);
  pair.hold_at_most(any_spring_energy);
  EXPECT_NEAR(pair.start_energy(), 1001.25, 1e-9);
  pair.hold_at_most({250.0, 0.3125});
  // Half of each.
  const PairResponse response = pair.respond(still_a, still_b, false);
  EXPECT_NEAR(response.points[0].force[0], 5e8 * 1e-3, 1e-6);
  EXPECT_NEAR(response.points[0].force[1], -2.5e8 * 5e-5, 1e-8);
  EXPECT_NEAR(ContactPair::energies(response).normal, 250.0, 1e-9);
  EXPECT_NEAR(ContactPair::energies(response).shear, 0.3125, 1e-12);
  // The blocks have not moved.
  EXPECT_NEAR(pair.gaps(still_a, still_b)[0], -2e-3, 1e-18);
}

/// A pair of skew_setting(-2e-3) that may hold 250 J in its normal spring and has slid. N = 5e5 N after the
/// rest has moved by half; the limit 0.1 N is 2e-4 m of slip, 5 J; 3 mm are beyond it.
ContactPair slid_pair(const Setting& setting, double shear_held) {
  PointMemory memory;
  memory.slip = 3e-3 * setting.points[0].tangent_2;
  ContactPair pair = pair_of(setting, {2e9, 1e9, 0.1, 0.0, 0.0, true}, memory);
  pair.hold_at_most({250.0, shear_held});
  return pair;
}

TEST(ContactPair, ASlidingPairFoundAnewHoldsNoMoreShear) {
  const Setting setting = skew_setting(-2e-3);
  const ContactPair pair = slid_pair(setting, 1.25);
  const PairResponse response = pair.respond(Eigen::VectorXd::Zero(setting.a.unknowns()),
                                             Eigen::VectorXd::Zero(setting.b.unknowns()), false);
  EXPECT_NEAR(ContactPair::energies(response).normal, 250.0, 1e-9);
  EXPECT_NEAR(ContactPair::energies(response).shear, 1.25, 1e-11);
  EXPECT_NEAR(response.points[0].force[2], -2.5e8 * 1e-4, 1e-7);
}

TEST(ContactPair, SlipThatFrictionDoesNotBearIsCutWhateverIsHeld) {
  // More energy was held than the 5 J at the limit of 2e-4 m: taken back by half, it is locked.
  const Setting setting = skew_setting(-2e-3);
  const ContactPair pair = slid_pair(setting, 10.0);
  const Eigen::MatrixX3d back =
      setting.a.basis().linear_field(-1e-4 * setting.points[0].tangent_2, Eigen::Matrix3d::Zero());
  const PairResponse response = pair.respond(Eigen::Map<const Eigen::VectorXd>(back.data(), back.size()),
                                             Eigen::VectorXd::Zero(setting.b.unknowns()), false);
  EXPECT_EQ(response.points[0].state, ContactState::locked);
  EXPECT_NEAR(response.points[0].force[2], -2.5e8 * 1e-4, 1e-6);
}

// Points that are found where pressure ends are at the surface to rounding.
TEST(ContactPair, WhatCohesionHeldIsKeptOnBothSidesOfTheSurface) {
  // c A = 2.5e4 N is 1e-4 m of slip at ks A = 2.5e8 N/m, which holds 1.25 J; the blocks have not moved.
  for (const double gap : {-1e-18, 0.0, 1e-18}) {
    const Setting setting = skew_setting(gap);
    PointMemory memory;
    memory.slip = 3e-4 * setting.points[0].tangent_1;
    memory.intact = true;
    ContactPair pair = pair_of(setting, {2e9, 1e9, 0.1, 1e5, 0.0, true}, memory);
    pair.hold_at_most({0.0, 10.0});
    EXPECT_NEAR(pair.start_energy(), 1.25, 1e-9) << gap;
    const Eigen::MatrixX3d down =
        setting.a.basis().linear_field(-1e-6 * setting.points[0].normal, Eigen::Matrix3d::Zero());
    for (const bool averaged : {false, true}) {
      const PairResponse pressed = pair.respond(Eigen::Map<const Eigen::VectorXd>(down.data(), down.size()),
                                                Eigen::VectorXd::Zero(setting.b.unknowns()), averaged);
      EXPECT_NEAR(pressed.means[0].force[1], -2.5e4, 1e-6) << gap << averaged;
    }
  }
}

JointLaw multiplier_law() {
  JointLaw law{2e9, 1e9, 0.1, 0.0, 0.0, true};
  law.transmission = Transmission::multipliers;
  return law;
}

TEST(ContactPair, MultipliersHoldPointsWhereTheyAreFound) {
  PointMemory memory;
  memory.normal_multiplier = 4e4;  // Pa, over 0.25 m^2: 1e4 N
  const auto start_force = [&](double gap) {
    const Setting setting = skew_setting(gap);
    PatchStart start;
    start.frozen = 2.0;
    const ContactPair pair = pair_of(setting, multiplier_law(), memory, start);
    EXPECT_EQ(pair.spent(), 2.0);
    EXPECT_EQ(pair.depth_found(), std::max(0.0, -gap));
    EXPECT_EQ(pair.start_energy(), 0.0);
    return pair.respond(none(setting.a), none(setting.b), false).points[0].force[0];
  };
  // Nothing pushes back, however deep; above the surface the spring of 5e8 N/m pulls.
  EXPECT_NEAR(start_force(-1e-6), 1e4, 1e-6);
  EXPECT_NEAR(start_force(-9e-3), 1e4, 1e-6);
  EXPECT_NEAR(start_force(1e-6), 1e4 - 500.0, 1e-6);
}

TEST(ContactPair, MovedApartPushesFromADepthOnAndKeepsBonds) {
  PointMemory memory;
  memory.normal_multiplier = 4e4;
  memory.slip = Vector3(1e-3, 0, 0);
  memory.state = ContactState::locked;
  const auto force_at = [&](double gap, double tensile_strength, bool intact) {
    memory.intact = intact;
    JointLaw law = multiplier_law();
    law.tensile_strength = tensile_strength;
    law.cohesion = 1e5;
    const Setting setting = skew_setting(gap);
    PatchStart start;
    start.frozen = 0.0;
    const ContactPair pair = pair_of(setting, law, memory, start);
    EXPECT_EQ(pair.depth_found(), intact && tensile_strength > 0.0 ? 0.0 : std::max(0.0, -gap));
    return Eigen::Vector3d(
        pair.projected(2e-6).respond(none(setting.a), none(setting.b), false).points[0].force);
  };
  // From 9e-6 m deep to 2e-6 m: 5e8 N/m times 7e-6 m, without shear; nothing from less deep or above.
  EXPECT_NEAR((force_at(-9e-6, 0.0, false) - Eigen::Vector3d(3500, 0, 0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(force_at(-1e-6, 0.0, true), Eigen::Vector3d::Zero());
  EXPECT_EQ(force_at(1e-6, 1e6, false), Eigen::Vector3d::Zero());
  // A bond that is whole is at rest wherever it is, deep or open.
  EXPECT_EQ(force_at(-9e-6, 1e6, true), Eigen::Vector3d::Zero());
  EXPECT_EQ(force_at(1e-6, 1e6, true), Eigen::Vector3d::Zero());
}

TEST(ContactPair, WhatIsPlacedBelowTheSurfaceByRoundingTouches) {
  JointLaw law{2e9, 1e9, 0.5, 0.0, 0.0, true};
  law.rounding = 3e-14;
  const auto start_force = [&](double gap) {
    const Setting setting = skew_setting(gap);
    PointMemory memory;
    memory.intact = true;
    PatchStart start;
    start.touch_within = law.rounding;
    const ContactPair pair = pair_of(setting, law, memory, start);
    const PairResponse response = pair.respond(none(setting.a), none(setting.b), false);
    EXPECT_NE(response.points[0].state, ContactState::open) << gap;
    return response.points[0].force[0];
  };
  EXPECT_EQ(start_force(-2e-14), 0.0);
  EXPECT_EQ(start_force(2e-14), 0.0);
  EXPECT_DOUBLE_EQ(start_force(-4e-14), 2e9 * 0.25 * 4e-14);
  // A bond holds either way.
  law.tensile_strength = 1e6;
  EXPECT_DOUBLE_EQ(start_force(-2e-14), 2e9 * 0.25 * 2e-14);
}

TEST(ContactPair, WithoutPointsThereAreNoForces) {
  Setting setting = skew_setting(0.0);
  setting.points.clear();
  const BlockState state_a = setting.a.initial_state();
  const BlockState state_b = setting.b.initial_state();
  ContactPair pair({0, 1, {&setting.a, &state_a, nullptr}, {&setting.b, &state_b, nullptr}},
                   JointLaw{2e9, 1e9, 0.1, 0.0, 0.0, true}, ContactPatch{}, {});
  pair.hold_at_most({});
  const Eigen::VectorXd ya = Eigen::VectorXd::Ones(setting.a.unknowns());
  const Eigen::VectorXd yb = Eigen::VectorXd::Ones(setting.b.unknowns());
  const PairResponse response = pair.respond(ya, yb, false);
  EXPECT_EQ(response.total_on_a(), Eigen::VectorXd::Zero(setting.a.unknowns()));
  EXPECT_EQ(response.total_on_b(), Eigen::VectorXd::Zero(setting.b.unknowns()));
  EXPECT_TRUE(pair.tangent(response).ab.isZero(0.0));
}

TEST(ContactPair, BondsKeepTheirRest) {
  const Setting setting = skew_setting(-2e-3);
  PointMemory memory;
  memory.intact = true;
  ContactPair pair = pair_of(setting, {2e9, 1e9, 0.1, 0.0, 1e6, true}, memory);
  pair.hold_at_most({250.0, 0.0});
  EXPECT_NEAR(pair.start_energy(), 1000.0, 1e-9);
}

TEST(ContactPair, CohesionLastsWhereAPointOpensByRounding) {
  PointMemory memory;
  memory.intact = true;
  const auto intact_after = [&](double gap, double tensile_strength) {
    const Setting setting = skew_setting(gap);
    const ContactPair pair = pair_of(setting, {2e9, 1e9, 0.1, 1e5, tensile_strength, true}, memory);
    const Eigen::VectorXd ya = none(setting.a), yb = none(setting.b);
    return pair.memory_after(pair.respond(ya, yb, false), pair.laws(), ya, yb, 1e-9)[0].intact;
  };
  EXPECT_TRUE(intact_after(-1e-17, 0.0));
  EXPECT_TRUE(intact_after(1e-17, 0.0));
  EXPECT_FALSE(intact_after(1e-8, 0.0));
  // 2e9 Pa/m times 1e-4 m is 2e5 Pa.
  EXPECT_TRUE(intact_after(1e-4, 2.1e5));
  EXPECT_FALSE(intact_after(1e-4, 1.9e5));
}

TEST(ContactPair, SlidingInACircleTakesFrictionTimesThePathOfTheSpringsFoot) {
  // A spring of length s = mu N / ks drags its foot behind a point on a circle of radius r: the foot runs on
  // a circle of radius sqrt(r^2 - s^2), the force along its path.
  Setting setting = skew_setting(-1e-3);
  setting.b = BlockModel([] {
    BlockDefinition base = block_of("B", Polyhedron(make_box({-1, -1, 0}, {2, 2, 1})), {2000, 1e8, 0.2}, 1);
    base.fixed = true;
    return base;
  }());
  const ContactPoint point = setting.points[0];
  const JointLaw law{2e9, 1e9, 0.5, 0.0, 0.0, true};
  const double limit = 0.5 * 2e9 * 0.25 * 1e-3;
  const double length = limit / (1e9 * 0.25);
  const double radius = 4.0 * length;
  constexpr int steps = 4000;
  PointMemory memory;
  double work = 0.0;
  double turned = 0.0;
  for (int k = 0; k < 2 * steps; ++k) {
    const double from = 2.0 * std::numbers::pi * k / steps;
    const double to = 2.0 * std::numbers::pi * (k + 1) / steps;
    const Vector3 motion = radius * ((std::cos(to) - std::cos(from)) * point.tangent_1 +
                                     (std::sin(to) - std::sin(from)) * point.tangent_2);
    const Eigen::MatrixX3d field = setting.a.basis().linear_field(motion, Eigen::Matrix3d::Zero());
    const Eigen::VectorXd ya = Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
    const ContactPair pair = pair_of(setting, law, memory);
    const PairResponse response = pair.respond(ya, {}, false);
    // The first turn drags the spring into its steady length and direction.
    if (k >= steps) {
      work += pair.friction_work(response, pair.laws(), ya, {});
      turned += memory.slip.norm() / steps;
    }
    memory = pair.memory_after(response, pair.laws(), ya, {}, 0.0)[0];
  }
  EXPECT_NEAR(turned, length, 1e-9 * length);
  const double expected = limit * 2.0 * std::numbers::pi * std::sqrt(radius * radius - length * length);
  EXPECT_NEAR(work, expected, 1e-3 * expected);
}

}  // namespace
}  // namespace ashlar::contact_pair_test
