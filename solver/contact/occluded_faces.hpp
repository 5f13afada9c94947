// Where faces of blocks lie on other blocks: nothing gets in there, and no way leads out.
//
// Penalty springs let a corner sink into what it lies on. Where that block ends and a neighbour begins, the
// corner goes through the common side into the neighbour, without ever having been outside of it: the side is
// next to it, but what holds it there is the neighbour's surface (geometry/contacts/contact_search.hpp, OccludedPlaces).
#pragma once

#include <map>
#include <vector>

#include "geometry/contacts/contact_search.hpp"

namespace ashlar {

class OccludedFaces {
 public:
  /// Takes note of the faces of two blocks that lie on each other.
  /// @param reach m, how far apart they may be there
  void add(const std::array<int, 2>& blocks, const std::vector<CellOverlap>& overlaps,
           const SubFaceSurface& a, const SubFaceSurface& b, double reach);
  [[nodiscard]] bool empty() const { return covers_.empty(); }
  /// Whether a face of a block lies on any block but one at a place in its plane.
  [[nodiscard]] bool hides(int block, int face, int but, const Vector3& place) const;
  /// Of a pair of blocks. This must outlive the answer.
  [[nodiscard]] OccludedPlaces of_pair(const std::array<int, 2>& blocks) const;

 private:
  struct Cover {
    int other;
    ViewFrame frame;
    std::vector<Eigen::Vector2d> outline;  ///< counter-clockwise in the frame
  };
  std::map<std::array<int, 2>, std::vector<Cover>> covers_;  ///< by block and face
};

}  // namespace ashlar
