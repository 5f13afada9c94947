// Features of a surface near a box, for searches of contacts.
#pragma once

#include <vector>

#include "geometry/boxes/box.hpp"
#include "geometry/subfaces/placed_surface.hpp"

namespace ashlar {

/// Upper bound of the distance of the true edge from the straight one, m.
[[nodiscard]] double chord_bound(const PlacedSurface& s, const SurfaceEdge& edge);

/// Features whose boxes intersect a given one, and these boxes.
struct IndexedBoxes {
  std::vector<int> indices;  ///< ascending
  std::vector<Box> boxes;
};

/// Features of a surface near a box, their own boxes grown by a margin. Costs what lies there if the surface has many
/// cells.
class FeaturesNear {
 public:
  /// @param surface must outlive this. @param margin m, >= 0
  FeaturesNear(const PlacedSurface& surface, const Box& around, double margin);

  [[nodiscard]] IndexedBoxes cells() const;
  [[nodiscard]] IndexedBoxes vertices() const;
  [[nodiscard]] IndexedBoxes edges() const;

 private:
  /// @param candidates beside near cells, of a surface with many; otherwise all of `count` are looked at
  template <class BoxOf>
  [[nodiscard]] IndexedBoxes near_of(std::size_t count, const std::vector<int>& candidates,
                                     const BoxOf& box_of_feature) const;

  const PlacedSurface& surface_;
  Box around_;
  double margin_;
  std::vector<int> cells_;  ///< near the box, of a surface with many
};

/// Points, or edges, beside cells, ascending.
[[nodiscard]] std::vector<int> points_of_cells(const SubFaceSurface& surface, const std::vector<int>& cells);
[[nodiscard]] std::vector<int> edges_of_cells(const SubFaceSurface& surface, const std::vector<int>& cells);

}  // namespace ashlar
