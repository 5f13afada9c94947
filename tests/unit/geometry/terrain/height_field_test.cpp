#include "geometry/terrain/height_field.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ashlar::height_field_test {
namespace {

TEST(HeightField, TrianglesOfASquareCoverIt) {
  const HeightField field = height_field({{0, 0, 1}, {2, 0, 2}, {2, 2, 3}, {0, 2, 4}, {2, 0, 2}});
  EXPECT_EQ(field.points.size(), 4U);
  ASSERT_EQ(field.triangles.size(), 2U);
  double area = 0.0;
  for (const auto& [a, b, c] : field.triangles) {
    const Vector3 u = field.points[static_cast<std::size_t>(b)] - field.points[static_cast<std::size_t>(a)];
    const Vector3 v = field.points[static_cast<std::size_t>(c)] - field.points[static_cast<std::size_t>(a)];
    EXPECT_GT(u.cross(v).z(), 0.0);
    area += 0.5 * u.cross(v).z();
  }
  EXPECT_EQ(area, 4.0);
}

TEST(HeightField, RefusesWhatIsNoSurface) {
  EXPECT_THROW((void)height_field({{0, 0, 0}, {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW((void)height_field({{0, 0, 0}, {1, 1, 0}, {3, 3, 5}}), std::invalid_argument);
  EXPECT_THROW((void)height_field({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::height_field_test
