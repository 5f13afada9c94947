// Solids with their surfaces where they are, for tests of contact search.
#pragma once

#include "geometry/solid/shapes.hpp"
#include "geometry/subfaces/placed_surface.hpp"

namespace ashlar::test_support {

struct PlacedBody {
  Polyhedron solid;
  SubFaceSurface surface;
  PlacedSurface placed;
  /// @param levels of division; negative: whole faces
  explicit PlacedBody(Polyhedron polyhedron, int levels = -1)
      : solid(std::move(polyhedron)),
        surface(levels < 0 ? whole_surface(solid) : divide_surface(solid, levels)),
        placed(surface, surface.points) {}
  PlacedBody(const PlacedBody&) = delete;
  PlacedBody& operator=(const PlacedBody&) = delete;
};

inline Polyhedron box(const Vector3& low, const Vector3& high) {
  return Polyhedron(make_box(low, high));
}

}  // namespace ashlar::test_support
