#include "geometry/solid/line_in_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "geometry/boxes/box.hpp"
#include "geometry/solid/solid_location.hpp"

namespace ashlar {
namespace {

/// Bound of the rounding errors of a place on the line, m.
double rounding_at(const Vector3& start, const Vector3& direction, double low, double high) {
  constexpr double operations = 64.0;
  const double farthest = std::max(std::abs(low), std::abs(high));
  return operations * std::numeric_limits<double>::epsilon() *
         (start.cwiseAbs().maxCoeff() + farthest * direction.cwiseAbs().maxCoeff());
}

/// Places where the line crosses planes of triangles near them, and both ends of the range.
std::vector<double> places_of_change(const TriangleMesh& solid, const Vector3& start,
                                     const Vector3& direction, double low, double high) {
  std::vector<double> places = {low, high};
  const double margin = rounding_at(start, direction, low, high);
  Box range;
  range.include(start + low * direction);
  range.include(start + high * direction);
  for (const auto& triangle : solid.triangles) {
    Box box;
    for (const auto corner : triangle) box.include(solid.points[static_cast<std::size_t>(corner)]);
    box = box.grown(margin);
    if (!box.meets(range)) continue;
    const Vector3& x = solid.points[static_cast<std::size_t>(triangle[0])];
    const Vector3 normal = (solid.points[static_cast<std::size_t>(triangle[1])] - x)
                               .cross(solid.points[static_cast<std::size_t>(triangle[2])] - x);
    const double place = normal.dot(x - start) / normal.dot(direction);
    if (!(place > low && place < high)) continue;
    if (box.contains(start + place * direction)) places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

std::vector<std::array<double, 2>> parts_inside(const TriangleMesh& solid, const Vector3& start,
                                                const Vector3& direction, double low, double high) {
  std::vector<std::array<double, 2>> parts;
  const std::vector<double> places = places_of_change(solid, start, direction, low, high);
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    if (!is_inside(solid, start + 0.5 * (places[k] + places[k + 1]) * direction)) continue;
    if (!parts.empty() && parts.back()[1] == places[k])
      parts.back()[1] = places[k + 1];
    else
      parts.push_back({places[k], places[k + 1]});
  }
  return parts;
}

}  // namespace ashlar
