// Continuation of supporting surfaces: a block that spans several others lies on one surface, and edges between flush
// blocks do not bound it (mechanics/contact/reference_face.hpp).
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "mechanics/contact/reference_face.hpp"
#include "solver/contact/contact_finder.hpp"

namespace ashlar {

class SurfaceContinuation {
 public:
  /// @param found, placed must outlive this. @param placed surfaces of the blocks that have contacts
  /// @param reach m, largest distance of blocks that form one surface
  SurfaceContinuation(const std::vector<FoundContacts>& found,
                      const std::function<const PlacedSurface&(int)>& placed, double reach);

  /// True if a block other than the one with the rim continues the surface behind it.
  /// @param block that lies on the rim. @param with_rim the other one
  [[nodiscard]] bool goes_on(int block, int with_rim, const RimPlace& rim) const;

 private:
  struct Cover {
    int other;
    const CellOverlap* overlap;
    const PlacedSurface* a;
    const PlacedSurface* b;
  };
  [[nodiscard]] bool goes_on(const Cover& cover, const RimPlace& rim) const;

  std::map<std::array<int, 2>, std::vector<Cover>> of_faces_;  ///< by block and face
  double reach_;
};

}  // namespace ashlar
