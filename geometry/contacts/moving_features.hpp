// Features of a moving surface for collision checks: points, sides and cells whose paths come near a box.
#pragma once

#include <array>
#include <vector>

#include "geometry/boxes/box.hpp"
#include "geometry/subfaces/placed_surface.hpp"

namespace ashlar {

/// A surface during a step: the same cells at its start and its end.
struct MovingSurface {
  const PlacedSurface* start;
  const PlacedSurface* end;
};

/// A side of cells between two points: a convex edge, or, where faces are divided, an inner side.
struct SurfaceSide {
  std::array<int, 2> ends;
  std::array<int, 2> cells;  ///< adjacent cells; for an inner side the same twice
};

/// Features of one kind, each with the box of its path, m.
template <class Feature>
struct FeatureList {
  std::vector<Feature> list;
  std::vector<Box> boxes;
};

struct MovingFeatures {
  FeatureList<int> points;  ///< vertices; where faces are divided all points
  FeatureList<SurfaceSide> sides;
  FeatureList<int> cells;
};

/// Features whose boxes meet `around`: points move on straight lines.
[[nodiscard]] MovingFeatures features_near(const MovingSurface& moving, const Box& around);

// Faces whose contacts represent a feature.

[[nodiscard]] std::vector<int> faces_of_point(const SubFaceSurface& surface, int point);
/// The cell's face and those across convex edges of it.
[[nodiscard]] std::vector<int> faces_of_cell(const SubFaceSurface& surface, int cell);
/// The faces beside a side, and those at its ends that are across a convex edge of these.
[[nodiscard]] std::vector<int> faces_of_side(const SubFaceSurface& surface, const SurfaceSide& side);

/// Sum of the normals beside a side.
[[nodiscard]] Vector3 outward_of(const PlacedSurface& surface, const SurfaceSide& side);

}  // namespace ashlar
