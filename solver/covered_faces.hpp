// Which blocks lie on a face, and where: a block that spans several others lies on one surface, and the rims
// between them are no ends of it (mechanics/contact_master.hpp).
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "solver/contact_finder.hpp"

namespace ashlar {

class CoveredFaces {
 public:
  /// @param found, placed must outlive this. @param placed surfaces of the blocks that have contacts
  /// @param reach m, how far apart the blocks may be that make one surface
  CoveredFaces(const std::vector<FoundContacts>& found,
               const std::function<const PlacedSurface&(int)>& placed, double reach);

  /// Whether another block than the one with the rim is next to a place on the rim, and touches the face
  /// there or is as near to it.
  /// @param block,face what lies on the rim. @param place on it. @param gap to the rim, m
  [[nodiscard]] bool goes_on(int block, int face, int with_rim, const Vector3& place, double gap) const;

 private:
  struct Cover {
    int other;
    const CellOverlap* overlap;
    const PlacedSurface* a;
    const PlacedSurface* b;
  };
  [[nodiscard]] bool is_near(const Cover& cover, const Vector3& place, double gap) const;

  std::map<std::array<int, 2>, std::vector<Cover>> of_faces_;  ///< by block and face
  double reach_;
};

}  // namespace ashlar
