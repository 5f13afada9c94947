#include "mechanics/supports/support_motion.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"

namespace ashlar::support_motion_test {
namespace {

const Polyhedron box(make_box({0, 0, 0}, {2, 1, 1}));

BlockSupport end_support(double x, SupportHistory history) {
  return {Plane{{x, 0, 0}, Vector3::UnitX()}, {true, true, true}, std::move(history)};
}

const SupportHistory to_and_fro{{1.0, 2.0, 4.0}, {{0, 0, 0}, {0.1, 0, -0.2}, {0.3, 0, 0}}};

TEST(SupportMotion, PointsOfTheSupportFollowTheHistory) {
  for (const int order : {1, 2, 4}) {
    const PolynomialBasis basis(box, order);
    const std::vector<BlockSupport> supports = {end_support(0, to_and_fro), end_support(2, {})};
    const SupportMotion motion(box, basis, supports);
    ASSERT_TRUE(motion.moves());
    const auto place = [&](double time, const Vector3& point) {
      return Vector3(motion.at(time).transpose() * basis.values(point));
    };
    for (const Vector3& point : {Vector3(0, 0, 0), Vector3(0, 0.3, 0.9), Vector3(0, 1, 1)}) {
      EXPECT_LT(place(0.5, point).norm(), 1e-14);
      EXPECT_LT((place(1.5, point) - Vector3(0.05, 0, -0.1)).norm(), 1e-12);
      EXPECT_LT((place(3.0, point) - Vector3(0.2, 0, -0.1)).norm(), 1e-12);
      EXPECT_LT((place(9.0, point) - Vector3(0.3, 0, 0)).norm(), 1e-12);
    }
    EXPECT_LT(place(2.0, {2, 0.5, 0.5}).norm(), 1e-12);
    // Nothing of it is a motion of the unknowns.
    const AdmissibleSpace space(box, basis, supports);
    EXPECT_LT(space.restrict(motion.at(2.0)).norm(), 1e-12);
  }
}

TEST(SupportMotion, ChangesWhereAHistoryIsNotConstant) {
  const PolynomialBasis basis(box, 1);
  const SupportMotion motion(box, basis, {end_support(0, to_and_fro)});
  EXPECT_FALSE(motion.changes_between(0.0, 1.0));
  EXPECT_TRUE(motion.changes_between(0.0, 1.1));
  EXPECT_TRUE(motion.changes_between(3.9, 5.0));
  EXPECT_FALSE(motion.changes_between(4.0, 5.0));
}

TEST(SupportMotion, OnlyChosenComponentsMove) {
  const PolynomialBasis basis(box, 2);
  BlockSupport support = end_support(0, to_and_fro);
  support.components = {false, false, true};
  const SupportMotion motion(box, basis, {support});
  const Vector3 place = motion.at(2.0).transpose() * basis.values(Vector3(0, 0.5, 0.5));
  EXPECT_LT((place - Vector3(0, 0, -0.2)).norm(), 1e-12);
}

TEST(SupportMotion, SupportsAtRestDoNotMove) {
  const PolynomialBasis basis(box, 2);
  EXPECT_FALSE(SupportMotion(box, basis, {end_support(0, {})}).moves());
  EXPECT_FALSE(SupportMotion().changes_between(0.0, 1.0));
}

TEST(SupportMotion, RefusesContradictions) {
  const PolynomialBasis basis(box, 2);
  BlockSupport side{Plane{{0, 0, 0}, Vector3::UnitY()}};
  // The side shares an edge with the end that moves.
  EXPECT_THROW(SupportMotion(box, basis, {end_support(0, to_and_fro), side}), std::invalid_argument);
  side.history = to_and_fro;
  EXPECT_NO_THROW(SupportMotion(box, basis, {end_support(0, to_and_fro), side}));
}

TEST(SupportMotion, HistoriesThatAgreeAtTheirRowsOnlyAreContradictions) {
  const PolynomialBasis basis(box, 2);
  BlockSupport side{Plane{{0, 0, 0}, Vector3::UnitY()}};
  side.history = to_and_fro;
  side.history.record = MotionRecord::smooth_displacement;
  EXPECT_THROW(SupportMotion(box, basis, {end_support(0, to_and_fro), side}), std::invalid_argument);
}

TEST(SupportMotion, VelocityIsThatOfTheRecordAtTheEndOfAStep) {
  const PolynomialBasis basis(box, 2);
  const SupportHistory record{{0.0, 1.0}, {Vector3::Zero(), {3, 0, 0}}, MotionRecord::acceleration};
  const SupportMotion smooth(box, basis, {end_support(0, record)});
  EXPECT_TRUE(smooth.has_velocity());
  const auto velocity = [&](const SupportMotion& motion, double from, double step) {
    return Vector3(motion.velocity(from, step).transpose() * basis.values(Vector3(0, 0.5, 0.5)));
  };
  EXPECT_LT((velocity(smooth, 0.2, 0.3) - Vector3(1.5 * 0.25, 0, 0)).norm(), 1e-12);
  // Straight lines have their mean.
  const SupportMotion lines(box, basis, {end_support(0, to_and_fro)});
  EXPECT_FALSE(lines.has_velocity());
  EXPECT_LT((velocity(lines, 1.5, 1.5) - Vector3(0.15 / 1.5, 0, 0)).norm(), 1e-12);
}

TEST(SupportMotion, RefusesAStartElsewhere) {
  const PolynomialBasis basis(box, 1);
  EXPECT_THROW(SupportMotion(box, basis, {end_support(0, {{0.0, 1.0}, {{0.1, 0, 0}, {0.2, 0, 0}}})}),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::support_motion_test
