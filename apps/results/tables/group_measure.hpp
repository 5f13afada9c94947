// Measures of several blocks: the drift of a storey and the width of cracks.
//
// Drift: u_k is the mean over the blocks that level k (height h_k along the unit vector e against gravity) cuts, weighted
// by their masses (by their volumes if all are fixed), of the displacement of the point at that height on the vertical
// through the block's centroid. With d = u_1 - u_0,
//     drift = (d - (d . e) e) / (h_1 - h_0).
//
// Cracks: the common faces of two blocks as they are placed (common_faces.hpp) are followed with both blocks. At a
// corner X of such a polygon, with the outward normal N of block a,
//     n = F^-T N / |F^-T N|,  v = x_b(X) - x_a(X),  opening = max(0, n . v),  slip = |v - (n . v) n|
// where F is the gradient of the motion of a at X. Both are known however far the blocks have moved apart. The largest
// values are those at corners: exact for affine blocks. Means over a polygon are those of a linear function with the
// values at its corners, which is exact for affine blocks where all of it is open or all closed.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "solver/block_pair.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Value of a measure that does not exist in a row.
inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// The two levels of a storey.
struct DriftLevels {
  struct Place {
    int block;
    Vector3 point;  ///< m, reference coordinates
    double weight;  ///< kg, or m^3
  };
  std::array<std::vector<Place>, 2> places;  ///< lower and upper level
  Vector3 up = Vector3::UnitZ();             ///< unit length
  double distance = 0.0;                     ///< m, > 0, between the levels
};
/// @param blocks of the scene
[[nodiscard]] DriftLevels drift_levels(const Scene& scene, const SceneDrift& drift,
                                       const std::vector<BlockModel>& blocks);
/// Horizontal displacement of the upper level relative to the lower one over their distance; nan if all blocks of a
/// level are absent.
[[nodiscard]] Vector3 measured_drift(const Simulation& simulation, const DriftLevels& levels);

/// The common faces of the blocks of some joints.
struct JointPolygons {
  struct Polygon {
    PairKey blocks;
    Vector3 normal;                ///< unit, out of the first block
    std::vector<Vector3> corners;  ///< m, reference coordinates of both
  };
  std::vector<Polygon> polygons;
};
[[nodiscard]] JointPolygons joint_polygons(const Scene& scene, const SceneCrack& crack,
                                           const std::vector<BlockModel>& blocks);

struct CrackWidths {
  double largest_opening;  ///< m, >= 0; nan: no joint between blocks that are present
  double mean_opening;     ///< m, over the area of all polygons; nan as above
  double largest_slip;     ///< m; nan as above
  double open_area;        ///< m^2, of polygons whose mean gap is positive
};
[[nodiscard]] CrackWidths measured_cracks(const Simulation& simulation, const JointPolygons& joints);

}  // namespace ashlar
