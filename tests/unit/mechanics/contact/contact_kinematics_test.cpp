// Contact points in other configurations of their blocks.
#include "mechanics/contact/contact_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/check_derivatives.hpp"
#include "support/simulations.hpp"

namespace ashlar::contact_kinematics_test {
namespace {

using test_support::block_of;

const Material rock{2500, 1e9, 0.2};

BlockModel box(const Vector3& low, const Vector3& high, int order = 1) {
  return BlockModel(block_of("box", Polyhedron(make_box(low, high)), rock, order));
}

/// The face of a block with an outward normal.
int face_of(const BlockModel& block, const Vector3& normal) {
  const auto& faces = block.solid().faces();
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (faces[k].normal.dot(normal) > 0.99) return static_cast<int>(k);
  return -1;
}

/// The block turned about the y axis through a point, then shifted.
Eigen::MatrixX3d moved(const BlockModel& block, double angle, const Vector3& middle, const Vector3& shift) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix();
  const Eigen::MatrixX3d& start = block.basis().identity_map();
  return start * turn.transpose() +
         block.basis().linear_field(middle - turn * middle + shift, Eigen::Matrix3d::Zero());
}

ContactPoint point_between(const Vector3& on_a, const Vector3& on_b, const Vector3& normal,
                           NormalSource source) {
  ContactPoint point{};
  point.material_a = point.place_a = on_a;
  point.material_b = point.place_b = on_b;
  point.normal = normal;
  point.source = source;
  complete(point);
  return point;
}

/// A corner of a over the top of b.
ContactPoint corner_on_top(const BlockModel& a, const BlockModel& b) {
  ContactPoint point =
      point_between({0.2, 0.3, 1.0}, {0.2, 0.3, 1.0}, Vector3::UnitZ(), NormalSource::face_of_b);
  point.face_a = face_of(a, -Vector3::UnitZ());
  point.face_b = face_of(b, Vector3::UnitZ());
  return point;
}

TEST(ContactKinematics, TheFootOfACornerMovesAlongAFaceThatTurns) {
  const BlockModel a = box({0.2, 0.3, 1}, {1, 1, 2});
  const BlockModel b = box({-1, -1, 0}, {2, 2, 1});
  const ContactPoint point = corner_on_top(a, b);
  // b turns by t about the y axis through (0, 0, 1), which tips its top towards +x: (s, 0, 1) goes to
  // (s cos t, 0, 1 - s sin t). a slides by 0.1 along x and rises by 0.05.
  const double t = 0.02;
  const Eigen::MatrixX3d place_a = moved(a, 0.0, Vector3::Zero(), {0.1, 0, 0.05});
  const Eigen::MatrixX3d place_b = moved(b, t, {0, 0, 1}, Vector3::Zero());
  const ContactPoint end = moved_to(point, {a, place_a}, {b, place_b});
  const Vector3 normal(std::sin(t), 0, std::cos(t));
  EXPECT_LT((end.normal - normal).norm(), 1e-15);
  // The corner is at (0.3, 0.3, 1.05), so 0.3 sin t + 0.05 cos t above the turned top.
  EXPECT_NEAR(end.gap, 0.3 * std::sin(t) + 0.05 * std::cos(t), 1e-15);
  EXPECT_EQ(end.material_a, point.material_a);
  const double along = 0.3 * std::cos(t) - 0.05 * std::sin(t);
  EXPECT_LT((end.material_b - Vector3(along, 0.3, 1)).norm(), 1e-14);
  EXPECT_LT((end.place_a - end.place_b - end.gap * normal).norm(), 1e-14);
  // The frame turns with the normal.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(t, Vector3::UnitY()).toRotationMatrix();
  EXPECT_LT((end.tangent_1 - turn * point.tangent_1).norm(), 1e-15);
  EXPECT_LT((end.tangent_2 - turn * point.tangent_2).norm(), 1e-15);
}

TEST(ContactKinematics, WhatTurnsAsOneBlockHasNoGap) {
  const BlockModel a = box({0.2, 0.3, 1}, {1, 1, 2});
  const BlockModel b = box({-1, -1, 0}, {2, 2, 1});
  const ContactPoint point = corner_on_top(a, b);
  const Eigen::MatrixX3d place_a = moved(a, 0.7, {0.5, 0, 3}, {1, 2, 3});
  const Eigen::MatrixX3d place_b = moved(b, 0.7, {0.5, 0, 3}, {1, 2, 3});
  const ContactPoint end = moved_to(point, {a, place_a}, {b, place_b});
  EXPECT_NEAR(end.gap, 0.0, 1e-14);
  EXPECT_LT((end.material_b - point.material_b).norm(), 1e-14);
}

TEST(ContactKinematics, CrossedEdgesAreAskedWhereTheyAreNearest) {
  // The lower edge of a along y crosses the upper edge of b along x.
  const BlockModel a = box({0.2, -1, 1}, {0.8, 1, 2});
  const BlockModel b = box({-1, 0, 0}, {1, 1, 1});
  ContactPoint point = point_between({0.2, 0, 1}, {0.2, 0, 1}, Vector3::UnitZ(), NormalSource::edges);
  point.edge_a = {0, 2, 0};
  point.edge_b = {2, 0, 0};
  const Eigen::MatrixX3d place_b = moved(b, 0.0, Vector3::Zero(), Vector3::Zero());
  const Eigen::MatrixX3d shifted = moved(a, 0.0, Vector3::Zero(), {0.3, 0.1, 0.02});
  const ContactPoint end = moved_to(point, {a, shifted}, {b, place_b});
  EXPECT_NEAR(end.gap, 0.02, 1e-15);
  EXPECT_LT((end.material_a - Vector3(0.2, -0.1, 1)).norm(), 1e-15);
  EXPECT_LT((end.material_b - Vector3(0.5, 0, 1)).norm(), 1e-15);
  // b turns about the y axis through (0, 0, 1): its edge goes to (s cos t, 0, 1 - s sin t) and the normal,
  // across it and y, to (sin t, 0, cos t).
  const double t = 0.05;
  const Eigen::MatrixX3d turned = moved(b, t, {0, 0, 1}, Vector3::Zero());
  const Eigen::MatrixX3d still = moved(a, 0.0, Vector3::Zero(), Vector3::Zero());
  const ContactPoint tipped = moved_to(point, {a, still}, {b, turned});
  EXPECT_LT((tipped.normal - Vector3(std::sin(t), 0, std::cos(t))).norm(), 1e-15);
  EXPECT_NEAR(tipped.gap, 0.2 * std::sin(t), 1e-15);
  // Farther beyond its end than it is long.
  const Eigen::MatrixX3d gone = moved(a, 0.0, Vector3::Zero(), {0, 2.5, 0});
  const ContactPoint kept = moved_to(point, {a, gone}, {b, turned});
  EXPECT_EQ(kept.material_a, point.material_a);
  EXPECT_EQ(kept.normal, point.normal);
}

TEST(ContactKinematics, RowsAreTheGradientOfTheGap) {
  // Blocks that are bent, a point apart, on a face of either and on edges.
  const BlockModel a = box({0, 0, 1}, {1, 1, 2}, 2);
  const BlockModel b = box({-1, -1, 0}, {2, 2, 1}, 3);
  const auto bent = [](const BlockModel& block, double size) -> Eigen::VectorXd {
    const Eigen::MatrixX3d& start = block.basis().identity_map();
    return Eigen::VectorXd(start.reshaped()) +
           size * Eigen::VectorXd::LinSpaced(start.size(), -1.0, 2.0).array().sin().matrix();
  };
  for (const NormalSource source : {NormalSource::face_of_a, NormalSource::face_of_b, NormalSource::edges}) {
    ContactPoint found = point_between({0.0, 0.6, 1.0}, {0.05, 0.6, 1.0}, Vector3::UnitZ(), source);
    found.face_a = face_of(a, -Vector3::UnitZ());
    found.face_b = face_of(b, Vector3::UnitZ());
    found.edge_a = {0, 1, 0};
    found.edge_b = {3, 0.3, 0};
    Eigen::VectorXd place(3 * a.basis().size() + 3 * b.basis().size());
    place << bent(a, 0.02), bent(b, 0.03);
    const auto at = [&](const Eigen::VectorXd& q) {
      const Eigen::MatrixX3d qa = q.head(3 * a.basis().size()).reshaped(a.basis().size(), 3);
      const Eigen::MatrixX3d qb = q.tail(3 * b.basis().size()).reshaped(b.basis().size(), 3);
      return moved_to(found, {a, qa}, {b, qb});
    };
    const ContactPoint point = at(place);
    Eigen::RowVectorXd rows(place.size());
    rows << Eigen::MatrixXd(a.basis().values(point.material_a) * point.normal.transpose())
                .reshaped()
                .transpose(),
        Eigen::MatrixXd(-b.basis().values(point.material_b) * point.normal.transpose())
            .reshaped()
            .transpose();
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& q) { return Eigen::VectorXd::Constant(1, at(q).gap); }, place, rows, 1e-6,
        1e-7);
  }
}

/// A configuration that bends in all its functions.
Eigen::MatrixX3d bent(const BlockModel& block) {
  Eigen::MatrixX3d position = block.basis().identity_map();
  for (Eigen::Index a = 0; a < position.rows(); ++a)
    position.row(a) += 0.01 * Vector3(std::sin(a + 1.0), std::cos(2.0 * a), std::sin(3.0 * a)).transpose();
  return position;
}

TEST(ContactKinematics, TheGradientOfAConfigurationIsTheDerivativeOfItsPlaces) {
  for (const int order : {1, 2, 3, 8}) {
    const BlockModel block = box({0, 0, 0}, {2, 1, 1}, order);
    const Eigen::MatrixX3d position = bent(block);
    const PlacedBlock placed(block, position);
    for (const Vector3& at : {Vector3(1.0, 0.5, 1.0), Vector3(0.3, 0.9, 0.2)}) {
      const Eigen::Matrix3d found = placed.at(at).gradient;
      const Vector3 place = position.transpose() * block.basis().values(at);
      EXPECT_LT((placed.at(at).place - place).norm(), 1e-14) << order;
      EXPECT_EQ(placed.place(at), placed.at(at).place) << order;
      constexpr double h = 1e-5;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 shift = h * Vector3::Unit(axis);
        const Vector3 expected = (placed.place(at + shift) - placed.place(at - shift)) / (2.0 * h);
        EXPECT_LT((found.col(axis) - expected).norm(), 1e-7 * found.norm()) << order;
      }
    }
  }
}

TEST(ContactKinematics, ManyPointsMoveAsEachOfThemDoes) {
  const BlockModel a = box({0, 0, 1}, {1, 1, 2}, 3);
  const BlockModel b = box({-1, -1, 0}, {2, 2, 1}, 4);
  const Eigen::MatrixX3d of_a = bent(a);
  const Eigen::MatrixX3d of_b = bent(b);
  std::vector<ContactPoint> points;
  for (const double x : {0.2, 0.7}) {
    for (const NormalSource source :
         {NormalSource::face_of_a, NormalSource::face_of_b, NormalSource::as_found}) {
      points.push_back(point_between({x, 0.4, 1}, {x, 0.4, 1}, {0, 0, 1}, source));
      points.back().face_a = face_of(a, {0, 0, -1});
      points.back().face_b = face_of(b, {0, 0, 1});
    }
  }
  const std::vector<ContactPoint> all = moved_to(points, PlacedBlock{a, of_a}, PlacedBlock{b, of_b});
  ASSERT_EQ(all.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ContactPoint one = moved_to(points[k], {a, of_a}, {b, of_b});
    EXPECT_NEAR(all[k].gap, one.gap, 1e-13);
    EXPECT_LT((all[k].place_a - one.place_a).norm() + (all[k].place_b - one.place_b).norm(), 1e-13);
    EXPECT_LT((all[k].normal - one.normal).norm(), 1e-13);
  }
}

TEST(ContactKinematics, FlatSubFacesKeepTheirNormal) {
  const BlockModel a = box({0.2, 0.3, 1}, {1, 1, 2});
  const BlockModel b = box({-1, -1, 0}, {2, 2, 1});
  ContactPoint point = corner_on_top(a, b);
  point.source = NormalSource::as_found;
  const Eigen::MatrixX3d place_a = moved(a, 0.0, Vector3::Zero(), {0.1, 0, 0.05});
  const Eigen::MatrixX3d place_b = moved(b, 0.3, {0, 0, 1}, Vector3::Zero());
  const ContactPoint end = moved_to(point, {a, place_a}, {b, place_b});
  EXPECT_EQ(end.normal, point.normal);
  EXPECT_EQ(end.material_b, point.material_b);
}

}  // namespace
}  // namespace ashlar::contact_kinematics_test
