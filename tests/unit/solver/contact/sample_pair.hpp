// Contact points made by hand, and two blocks with one of them, whose forces are tested.
#pragma once

#include <vector>

#include "solver/contact/contact_pair.hpp"
#include "support/simulations.hpp"

namespace ashlar::test_support {

/// A contact point of 1 m^2 that is pressed along z. @param place of both blocks' points, m. @param gap m
inline ContactPoint level_point(const Vector3& place, double gap) {
  ContactPoint point{};
  point.material_a = point.material_b = point.place_a = point.place_b = place;
  point.normal = Vector3::UnitZ();
  point.tangent_1 = Vector3::UnitX();
  point.tangent_2 = Vector3::UnitY();
  point.gap = gap;
  point.area = 1.0;
  return point;
}

struct Setting {
  BlockModel a;
  BlockModel b;
  std::vector<ContactPoint> points;
};

inline ContactPair pair_of(const Setting& setting, const JointLaw& law, const PointMemory& memory,
                           const PatchStart& start = {}) {
  const BlockState state_a = setting.a.initial_state();
  const BlockState state_b = setting.b.initial_state();
  return {{0, 1, {&setting.a, &state_a, nullptr}, {&setting.b, &state_b, nullptr}},
          law,
          {setting.points},
          {memory},
          start};
}

/// Two blocks of different orders with one point in each other, seen along a skew normal.
inline Setting skew_setting(double gap) {
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

}  // namespace ashlar::test_support
