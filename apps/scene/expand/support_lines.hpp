// Bolts and props of a scene as lines through its blocks as placed.
//
// A bolt is where its line is inside blocks (geometry/solid/line_in_solid.hpp). Pieces shorter than a tenth of the bar
// are left out; where blocks overlap, the piece of the first one along the line ends where it does. A bar
// that is anchored at its ends is held by the blocks there: where two meet by the one that it goes into, a prop by the
// one behind. Ends may be on faces.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "mechanics/bolt/bolt_shape.hpp"

namespace ashlar {

/// A bolt or prop.
struct SupportLine {
  std::string name;
  std::string path;  ///< of its entry: "bolt.0"
  BoltLaw law;
  Vector3 from;
  Vector3 to;
  double thickness;             ///< m, diameter of a round bar of its area; 0: a prop
  std::vector<BoltSpan> spans;  ///< empty: `fault`
  bool installed;               ///< of one stage
  /// Reason why it holds no blocks, and what is allowed; otherwise empty
  std::string fault;
};

/// Direction of the rows of a pattern of bolts, unit length: horizontal, along x in a horizontal plane.
/// @param normal of its plane, not zero
[[nodiscard]] Vector3 pattern_row(const Vector3& normal);

/// All bolts, patterns expanded, then all props, in the order of the scene. The order does not depend on the stage.
/// Entries that are faulty in themselves have no lines.
/// @param solids by block; null: not built
[[nodiscard]] std::vector<SupportLine> support_lines(const Scene& scene,
                                                     const std::vector<const Polyhedron*>& solids);

}  // namespace ashlar
