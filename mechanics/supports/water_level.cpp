#include "mechanics/supports/water_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Rounding of a share of a triangle's area: places on a side belong to both triangles.
constexpr double side_rounding = 1e-12;

double plan_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a;
  return 0.5 * (u.x() * v.y() - u.y() * v.x());
}

/// The part of a convex polygon where an affine function is not negative. @param value (#corners)
std::vector<Vector3> not_negative(const std::vector<Vector3>& polygon, const std::vector<double>& value) {
  std::vector<Vector3> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (value[k] >= 0.0) result.push_back(polygon[k]);
    if ((value[k] > 0.0 && value[next] < 0.0) || (value[k] < 0.0 && value[next] > 0.0))
      result.emplace_back(polygon[k] + value[k] / (value[k] - value[next]) * (polygon[next] - polygon[k]));
  }
  return result;
}

}  // namespace

WaterLevel::WaterLevel(const Plane& level, const Vector3& up) {
  const double along = level.normal.dot(up);
  if (!(std::abs(along) > 0.0))
    throw std::invalid_argument("the plane of a water level is vertical, or its normal is zero");
  // (X + d up - point) . normal = 0
  level_ = Inclined{level.point, -level.normal / along};
}

WaterLevel::WaterLevel(HeightField level) : level_(std::move(level)) {}

WaterLevel::Inclined WaterLevel::triangle(std::size_t index) const {
  const HeightField& field = std::get<HeightField>(level_);
  const auto& [a, b, c] = field.triangles[index];
  const Vector3& origin = field.points[at(a)];
  const Vector3 normal = (field.points[at(b)] - origin).cross(field.points[at(c)] - origin);
  return {origin, -normal / normal.z()};
}

std::array<double, 3> WaterLevel::shares(std::size_t index, const Vector3& point) const {
  const HeightField& field = std::get<HeightField>(level_);
  std::array<Vector3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = field.points[at(field.triangles[index][k])];
  const double whole = plan_area(corners[0], corners[1], corners[2]);
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = plan_area(corners[k], corners[(k + 1) % 3], point) / whole;
    result[k] = std::abs(share) <= side_rounding ? 0.0 : share;
  }
  return result;
}

std::optional<double> WaterLevel::depth(const Vector3& point) const {
  if (const auto* plane = std::get_if<Inclined>(&level_)) return plane->gradient.dot(point - plane->origin);
  for (std::size_t k = 0; k < std::get<HeightField>(level_).triangles.size(); ++k) {
    const std::array<double, 3> inside = shares(k, point);
    if (std::any_of(inside.begin(), inside.end(), [](double share) { return share < 0.0; })) continue;
    const Inclined level = triangle(k);
    return level.gradient.dot(point - level.origin);
  }
  return std::nullopt;
}

void WaterLevel::add_below(const Inclined& level, std::vector<Vector3> polygon,
                           std::vector<LinearPatch>& parts) {
  std::vector<double> depth;
  depth.reserve(polygon.size());
  for (const Vector3& corner : polygon) depth.push_back(level.gradient.dot(corner - level.origin));
  if (std::any_of(depth.begin(), depth.end(), [](double d) { return d < 0.0; }))
    polygon = not_negative(polygon, depth);
  if (polygon.size() < 3) return;
  const double value = level.gradient.dot(polygon[0] - level.origin);
  parts.push_back({std::move(polygon), value, level.gradient});
}

bool WaterLevel::has_neighbour(std::size_t index, std::size_t side) const {
  const HeightField& field = std::get<HeightField>(level_);
  const int from = field.triangles[index][(side + 1) % 3], to = field.triangles[index][side];
  return std::any_of(field.triangles.begin(), field.triangles.end(), [&](const std::array<int, 3>& other) {
    for (std::size_t k = 0; k < 3; ++k)
      if (other[k] == from && other[(k + 1) % 3] == to) return true;
    return false;
  });
}

bool WaterLevel::misses(std::size_t index, const std::vector<Vector3>& polygon) const {
  const HeightField& field = std::get<HeightField>(level_);
  for (int axis = 0; axis < 2; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3& corner : polygon) {
      low = std::min(low, corner[axis]);
      high = std::max(high, corner[axis]);
    }
    const auto beside = [&](int corner) { return field.points[at(corner)][axis] < low; };
    const auto beyond = [&](int corner) { return field.points[at(corner)][axis] > high; };
    const std::array<int, 3>& corners = field.triangles[index];
    if (std::all_of(corners.begin(), corners.end(), beside) ||
        std::all_of(corners.begin(), corners.end(), beyond))
      return true;
  }
  return false;
}

std::vector<LinearPatch> WaterLevel::below(const std::vector<Vector3>& polygon) const {
  std::vector<LinearPatch> parts;
  if (const auto* plane = std::get_if<Inclined>(&level_)) {
    add_below(*plane, polygon, parts);
    return parts;
  }
  for (std::size_t k = 0; k < std::get<HeightField>(level_).triangles.size(); ++k) {
    if (misses(k, polygon)) continue;
    std::vector<Vector3> inside = polygon;
    // A vertical polygon on a side of two triangles belongs to the one whose side runs to a higher point.
    bool of_other = false;
    for (std::size_t side = 0; side < 3 && inside.size() >= 3; ++side) {
      std::vector<double> shares_of_corners;
      shares_of_corners.reserve(inside.size());
      for (const Vector3& corner : inside) shares_of_corners.push_back(shares(k, corner)[side]);
      const bool on_side = std::all_of(shares_of_corners.begin(), shares_of_corners.end(),
                                       [](double share) { return share == 0.0; });
      const auto& corners = std::get<HeightField>(level_).triangles[k];
      of_other = of_other || (on_side && corners[side] > corners[(side + 1) % 3] && has_neighbour(k, side));
      inside = not_negative(inside, shares_of_corners);
    }
    if (!of_other && inside.size() >= 3) add_below(triangle(k), std::move(inside), parts);
  }
  return parts;
}

}  // namespace ashlar
