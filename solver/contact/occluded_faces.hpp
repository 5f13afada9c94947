// Occluded faces: faces that lie on other blocks and so cannot be entered or left through.
//
// With penalty springs a corner penetrates its support. Where that block ends and a neighbour begins, the corner
// passes through the common side into the neighbour without ever having been outside of it. The side is the nearest
// face, but the surface of the neighbour supports the corner (geometry/contacts/contact_search.hpp, OccludedPlaces).
#pragma once

#include <map>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

class OccludedFaces {
 public:
  /// Adds the faces of two blocks that lie on each other.
  /// @param reach m, largest gap of such faces
  void add(const PairKey& blocks, const std::vector<CellOverlap>& overlaps, const SubFaceSurface& a,
           const SubFaceSurface& b, double reach);
  [[nodiscard]] bool empty() const { return covers_.empty(); }
  /// True if a face of a block lies on any block other than `but` at a place in its plane.
  [[nodiscard]] bool hides(int block, int face, int but, const Vector3& place) const;
  /// Occluded places of a pair of blocks. This must outlive the result.
  [[nodiscard]] OccludedPlaces of_pair(const PairKey& blocks) const;

 private:
  struct Cover {
    int other;
    ViewFrame frame;
    std::vector<Eigen::Vector2d> outline;  ///< counter-clockwise in the frame
  };
  std::map<std::array<int, 2>, std::vector<Cover>> covers_;  ///< by block and face
};

}  // namespace ashlar
