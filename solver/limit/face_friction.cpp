#include "solver/limit/face_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "mechanics/basis/plane_cross.hpp"

namespace ashlar {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

/// Area and its first moment.
struct AreaMoment {
  double area = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
};

AreaMoment moment_of(const std::vector<Polygon>& polygons) {
  AreaMoment sum;
  for (const Polygon& polygon : polygons) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const double area = 0.5 * cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
      sum.area += area;
      sum.first += area / 3.0 * (polygon[0] + polygon[k - 1] + polygon[k]);
    }
  }
  return sum;
}

/// Integral of the distance from the origin over the triangle between it and a side, with the sign of its area: h^3 /
/// 6 (tan t / cos t + asinh tan t) between the angles t of its ends from the foot at the distance h.
double distance_over_triangle(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const double length = (end - start).norm();
  if (!(length > 0.0)) return 0.0;
  const Eigen::Vector2d along = (end - start) / length;
  const double height = cross(start, along);
  if (height == 0.0) return 0.0;
  const auto up_to = [&](double place) {
    return place * correctly_rounded::hypot(place, height) +
           height * height * correctly_rounded::asinh(place / std::abs(height));
  };
  return height / 6.0 * (up_to(along.dot(end)) - up_to(along.dot(start)));
}

}  // namespace

Vector3 middle_of_point(const ContactPoint& point) {
  return 0.5 * (point.place_a + point.place_b);
}

double mean_distance(const std::vector<Polygon>& polygons, const Eigen::Vector2d& about) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons)
    for (std::size_t k = 0; k < polygon.size(); ++k)
      sum += distance_over_triangle(polygon[k] - about, polygon[(k + 1) % polygon.size()] - about);
  return sum / moment_of(polygons).area;
}

std::map<std::array<int, 2>, FaceFriction> face_frictions(const PlacedSurface& a, const PlacedSurface& b,
                                                          const std::vector<CellOverlap>& overlaps,
                                                          const std::vector<ContactPoint>& points) {
  std::map<std::array<int, 2>, std::vector<std::size_t>> corners;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].type == ContactPointType::face_face)
      corners[{points[k].face_a, points[k].face_b}].push_back(k);
  std::map<std::array<int, 2>, FaceFriction> frictions;
  for (const auto& [faces, of_overlap] : corners) {
    const ContactPoint& first = points[of_overlap.front()];
    const ViewFrame frame(middle_of_point(first), first.normal);
    std::vector<Polygon> polygons;
    for (const CellOverlap& overlap : overlaps) {
      if (a.surface().cells[at(overlap.cell_a)].face != faces[0] ||
          b.surface().cells[at(overlap.cell_b)].face != faces[1])
        continue;
      Polygon& polygon = polygons.emplace_back();
      polygon.reserve(overlap.corners.size());
      const ViewFrame& seen = overlap.frame;
      for (const OverlapCorner& corner : overlap.corners)
        polygon.push_back(
            frame.project(seen.origin + corner.place.x() * seen.e1 + corner.place.y() * seen.e2));
    }
    const AreaMoment moment = moment_of(polygons);
    if (!(std::abs(moment.area) > 0.0)) continue;
    const Eigen::Vector2d middle = moment.first / moment.area;
    double farthest = 0.0;
    for (const std::size_t k : of_overlap)
      farthest = std::max(farthest, (frame.project(middle_of_point(points[k])) - middle).norm());
    frictions[faces] = {frame.origin + middle.x() * frame.e1 + middle.y() * frame.e2,
                        std::min(1.0, mean_distance(polygons, middle) / farthest)};
  }
  return frictions;
}

std::vector<Vector3> places_of_friction(const std::map<std::array<int, 2>, FaceFriction>& frictions,
                                        const std::vector<ContactPoint>& points) {
  std::vector<Vector3> places;
  places.reserve(points.size());
  for (const ContactPoint& point : points) {
    Vector3& place = places.emplace_back(middle_of_point(point));
    const auto face = point.type == ContactPointType::face_face ? frictions.find({point.face_a, point.face_b})
                                                                : frictions.end();
    if (face == frictions.end()) continue;
    const ViewFrame frame(face->second.middle, point.normal);
    const Eigen::Vector2d arm = (face->second.share - 1.0) * frame.project(place);
    place += arm.x() * frame.e1 + arm.y() * frame.e2;
  }
  return places;
}

}  // namespace ashlar
