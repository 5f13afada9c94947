// Contact pairs whose blocks move far in a step: rows of the middle and of the end, and forces that act there.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/contact/contact_pair.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar::moved_pair_test {
namespace {

using test_support::pair_of;
using test_support::Setting;
using test_support::skew_setting;

/// A block that starts undeformed, in the middle and at the end of a step.
BlockInStep moved_by(const BlockModel& block, const Eigen::VectorXd& change) {
  const Eigen::MatrixX3d& start = block.basis().identity_map();
  const Eigen::Map<const Eigen::MatrixX3d> motion(change.data(), start.rows(), 3);
  return {&block, start + 0.5 * motion, start + motion, {}};
}

/// Change of a block that turns about the y axis through a point and is shifted.
Eigen::VectorXd turn_of(const BlockModel& block, double angle, const Vector3& middle, const Vector3& shift) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d gradient = turn - Eigen::Matrix3d::Identity();
  const Eigen::MatrixX3d field =
      block.basis().linear_field(gradient * (block.basis().centroid() - middle) + shift, gradient);
  return field.reshaped();
}

/// A point of a that touches the top of b.
Setting touching_setting() {
  Setting setting = skew_setting(0.0);
  ContactPoint& point = setting.points[0];
  point.material_a = point.material_b = point.place_a = point.place_b = {0.3, 0.7, 1.0};
  point.normal = Vector3::UnitZ();
  point.source = NormalSource::face_of_b;
  const auto& faces = setting.b.solid().faces();
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (faces[k].normal.z() > 0.5) point.face_b = static_cast<int>(k);
  complete(point);
  return setting;
}

TEST(ContactPair, FollowedPointsHaveTheGapOfTheEndAndTheNormalOfTheMiddle) {
  const Setting setting = touching_setting();
  ContactPair pair = pair_of(setting, {2e9, 1e9, 0.0, 0.0, 0.0, true}, {});
  // The top of b turns by t about the y axis through (0, 0, 1): z = -x tan t. The point goes from x = 0.3 to
  // 0.4, so that it is 0.4 sin t above; without t it would only have slid.
  const double t = -0.01;
  const Eigen::VectorXd ya = turn_of(setting.a, 0.0, Vector3::Zero(), {0.1, 0, 0});
  const Eigen::VectorXd yb = turn_of(setting.b, t, {0, 0, 1}, Vector3::Zero());
  pair.follow(moved_by(setting.a, ya), moved_by(setting.b, yb), ya, yb);
  EXPECT_NEAR(pair.gaps(ya, yb)[0], 0.4 * std::sin(t), 1e-15);
  const Vector3 normal(std::sin(0.5 * t), 0, std::cos(0.5 * t));
  EXPECT_LT((pair.points()[0].normal - normal).norm(), 1e-14);
  const PairResponse response = pair.respond(ya, yb, false);
  const double push = 2e9 * 0.25 * 0.4 * std::sin(-t);
  EXPECT_NEAR(response.points[0].force[0], push, 1e-12 * push);
  const Eigen::MatrixX3d force = response.total_on_a().reshaped(setting.a.basis().size(), 3);
  EXPECT_LT((std::sqrt(setting.a.basis().volume()) * force.row(0).transpose() - push * normal).norm(),
            1e-12 * push);
  // Rows in the middle make the gap's change but for terms of third order.
  EXPECT_NEAR(pair.motion(ya, yb)(0, 0), 0.4 * std::sin(t), 0.4 * std::abs(t * t * t));
  // Elsewhere the gap is linear.
  const Eigen::VectorXd higher = ya + turn_of(setting.a, 0.0, Vector3::Zero(), 1e-3 * normal);
  EXPECT_NEAR(pair.gaps(higher, yb)[0], 0.4 * std::sin(t) + 1e-3, 1e-14);
}

TEST(ContactPair, BlocksThatTurnAsOneNeitherPartNorSlip) {
  const Setting setting = touching_setting();
  ContactPair pair = pair_of(setting, {2e9, 1e9, 0.3, 0.0, 0.0, true}, {});
  const Eigen::VectorXd ya = turn_of(setting.a, 0.4, {2, 0, -1}, {1, 2, 3});
  const Eigen::VectorXd yb = turn_of(setting.b, 0.4, {2, 0, -1}, {1, 2, 3});
  pair.follow(moved_by(setting.a, ya), moved_by(setting.b, yb), ya, yb);
  EXPECT_LT(pair.motion(ya, yb).norm(), 1e-14);
  EXPECT_NEAR(pair.gaps(ya, yb)[0], 0.0, 1e-14);
}

TEST(ContactPair, AtTheEndOfAStepRowsAreThoseOfTheEnd) {
  const Setting setting = touching_setting();
  const ContactPair pair = pair_of(setting, {2e9, 1e9, 0.3, 0.0, 0.0, true}, {});
  const Eigen::VectorXd ya = turn_of(setting.a, 0.0, Vector3::Zero(), {0.1, 0, 0});
  const Eigen::VectorXd yb = turn_of(setting.b, 0.02, {0, 0, 1}, Vector3::Zero());
  const ContactPair end = pair.at_end(moved_by(setting.a, ya), moved_by(setting.b, yb));
  const Vector3 normal(std::sin(0.02), 0, std::cos(0.02));
  EXPECT_LT((end.points()[0].normal - normal).norm(), 1e-14);
  // A velocity along the normal there is all normal.
  const Eigen::VectorXd apart = turn_of(setting.a, 0.0, Vector3::Zero(), normal);
  EXPECT_LT((end.motion(apart, 0.0 * yb).col(0) - Vector3::UnitX()).norm(), 1e-13);
}

TEST(ContactPair, TotalForcesHaveNoResultantAndNoTorque) {
  // a slides on b and is deep in it: the springs' forces alone are a couple about the middle of the step.
  Setting setting = skew_setting(-1e-2);
  ContactPoint& point = setting.points[0];
  point.place_a = point.material_a;
  point.place_b = point.material_b;
  ContactPair pair = pair_of(setting, {2e9, 1e9, 0.3, 0.0, 0.0, true}, {});
  const auto change = [](const BlockModel& block, double size) {
    return Eigen::VectorXd(size * Eigen::VectorXd::LinSpaced(block.unknowns(), -1.0, 2.0));
  };
  const Eigen::VectorXd ya = change(setting.a, 0.02);
  const Eigen::VectorXd yb = change(setting.b, -0.01);
  const auto torque_and_force = [](const BlockModel& block, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& force) {
    const Eigen::Index p = block.basis().size();
    const Eigen::MatrixX3d middle =
        block.basis().identity_map() + 0.5 * Eigen::Map<const Eigen::MatrixX3d>(y.data(), p, 3);
    const Eigen::Map<const Eigen::MatrixX3d> rows(force.data(), p, 3);
    Eigen::Matrix<double, 6, 1> result = Eigen::Matrix<double, 6, 1>::Zero();
    for (Eigen::Index k = 0; k < p; ++k) {
      const Vector3 place = middle.row(k);
      result.head<3>() += place.cross(Vector3(rows.row(k)));
    }
    result.tail<3>() = std::sqrt(block.basis().volume()) * rows.row(0).transpose();
    return result;
  };
  const auto check = [&] {
    const PairResponse response = pair.respond(ya, yb, false);
    const Eigen::Matrix<double, 6, 1> springs = torque_and_force(setting.a, ya, response.force_on_a) +
                                                torque_and_force(setting.b, yb, response.force_on_b);
    const Eigen::Matrix<double, 6, 1> total = torque_and_force(setting.a, ya, response.total_on_a()) +
                                              torque_and_force(setting.b, yb, response.total_on_b());
    const double scale = torque_and_force(setting.a, ya, response.force_on_a).norm();
    EXPECT_GT(springs.head<3>().norm(), 1e-3 * scale);
    EXPECT_LT(total.norm(), 1e-12 * scale);
  };
  check();
  // Followed at another guess, points are still apart.
  const Eigen::VectorXd guess_a = 0.6 * ya;
  const Eigen::VectorXd guess_b = 0.3 * yb;
  pair.follow(moved_by(setting.a, guess_a), moved_by(setting.b, guess_b), guess_a, guess_b);
  check();
}

}  // namespace
}  // namespace ashlar::moved_pair_test
