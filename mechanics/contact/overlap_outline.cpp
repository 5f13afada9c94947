#include "mechanics/contact/overlap_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "mechanics/basis/plane_cross.hpp"

namespace ashlar {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& start,
                           const Eigen::Vector2d& end) {
  const Eigen::Vector2d along = end - start;
  const double squared_length = along.squaredNorm();
  const double share =
      squared_length > 0.0 ? std::clamp((point - start).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (point - start - share * along).norm();
}

bool is_corner_of(const Corners& polygon, const Eigen::Vector2d& point, double tolerance) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](const Eigen::Vector2d& corner) { return (corner - point).norm() <= tolerance; });
}

/// Interior angle of a convex polygon at a point, rad; 0 off its outline.
double angle_at(const Corners& polygon, const Eigen::Vector2d& point, double tolerance) {
  const std::size_t count = polygon.size();
  for (std::size_t k = 0; k < count; ++k) {
    if ((polygon[k] - point).norm() > tolerance) continue;
    const Eigen::Vector2d next = polygon[(k + 1) % count] - polygon[k];
    const Eigen::Vector2d last = polygon[(k + count - 1) % count] - polygon[k];
    return correctly_rounded::atan2(cross(next, last), next.dot(last));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (distance_to_segment(point, polygon[k], polygon[(k + 1) % count]) <= tolerance)
      return std::numbers::pi;
  }
  return 0.0;
}

/// Place in space of a corner, on the plane of its frame.
Vector3 lifted(const CellOverlap& overlap, int corner) {
  const Eigen::Vector2d& place = overlap.corners[at(corner)].place;
  return overlap.frame.origin + place.x() * overlap.frame.e1 + place.y() * overlap.frame.e2;
}

}  // namespace

double coordinate_rounding(const PlacedSurface& a, const PlacedSurface& b) {
  double farthest = 0.0;
  for (const Box& box : {a.box(), b.box()})
    farthest = std::max({farthest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  return 16.0 * std::numeric_limits<double>::epsilon() * farthest;
}

double outline_tolerance(const PlacedSurface& a, const PlacedSurface& b) {
  constexpr double share = 1e-10;
  return std::max(share * std::min(a.size(), b.size()), coordinate_rounding(a, b));
}

std::vector<Eigen::Vector2d> places_of(const CellOverlap& overlap) {
  Corners places;
  places.reserve(overlap.corners.size());
  for (const OverlapCorner& corner : overlap.corners) places.push_back(corner.place);
  return places;
}

std::vector<Eigen::Vector2d> outline_of(std::vector<Eigen::Vector2d> polygon, double tolerance) {
  while (!polygon.empty()) {
    const std::size_t count = polygon.size();
    if (count < 3) return {};
    std::size_t least = 0;
    double least_distance = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
      const double distance =
          distance_to_segment(polygon[k], polygon[(k + count - 1) % count], polygon[(k + 1) % count]);
      if (distance >= least_distance) continue;
      least_distance = distance;
      least = k;
    }
    if (least_distance > tolerance) break;
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return polygon;
}

FaceOutline outline_of(const FaceOverlap& face, const std::vector<CellOverlap>& overlaps, bool divided,
                       double tolerance) {
  FaceOutline outline{{}, 0.0};
  std::vector<Corners> pieces;
  pieces.reserve(face.cells.size());
  for (const int cell : face.cells) {
    pieces.push_back(outline_of(places_of(overlaps[at(cell)]), tolerance));
    outline.area += area_of(pieces.back());
  }
  // The crossing of almost coincident sides is ill-conditioned, and the number of corners of sub-faces that almost
  // coincide changes with each motion.
  constexpr double blur = 1e-3;
  double one_point = std::max(4.0 * tolerance, blur * std::sqrt(outline.area));
  std::vector<Corners> rough;
  rough.reserve(pieces.size());
  for (const Corners& piece : pieces) rough.push_back(outline_of(piece, one_point));
  if (std::any_of(rough.begin(), rough.end(), [](const Corners& piece) { return !piece.empty(); })) {
    pieces = std::move(rough);
  } else {
    one_point = 4.0 * tolerance;
  }
  constexpr double straight = 1e-2;  // rad: largest change of direction of an outline by removal of corners
  std::vector<Vector3> kept;
  const auto keep_corners = [&](double reach) {
    for (const FaceOverlapPoint& point : face.points) {
      const Vector3 place = lifted(overlaps[at(point.overlap)], point.corner);
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const Vector3& other) {
        return (other - place).norm() <= one_point;
      });
      if (known) continue;
      double angle = 0.0;
      bool corner = false;
      for (std::size_t k = 0; k < face.cells.size(); ++k) {
        const Eigen::Vector2d seen = overlaps[at(face.cells[k])].frame.project(place);
        corner = corner || is_corner_of(pieces[k], seen, reach);
        angle += angle_at(pieces[k], seen, 2.0 * one_point);
      }
      const bool turns = std::abs(angle - std::numbers::pi) > straight &&
                         std::abs(angle - 2.0 * std::numbers::pi) > straight;
      if (!corner || !(divided || turns)) continue;
      kept.push_back(place);
      outline.corners.push_back(point);
    }
  };
  keep_corners(2.0 * tolerance);
  // A corner kept by pieces may be listed with a sliver, which keeps none and has another direction of view.
  keep_corners(one_point);
  return outline;
}

double area_of(const std::vector<Eigen::Vector2d>& polygon) {
  double area = 0.0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    area += 0.5 * cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return area;
}

}  // namespace ashlar
