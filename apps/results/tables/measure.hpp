// History values of a [[measure]] of a scene: the motion and stress of a material point, the motion and rotation of a
// block, the contacts of two blocks, the forces of a bolt, the drift of a storey, or the width of cracks.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/results/tables/group_measure.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

struct Measure {
  enum class Kind {
    point,     ///< a material point
    block,     ///< a block: its centroid and its rotation
    pair,      ///< the contacts of two blocks
    bolt,      ///< a bolt or prop
    drift,     ///< two levels of some blocks
    crack,     ///< the joints of some blocks
    fracture,  ///< cracks that appear in blocks: not a [[measure]]
  };
  std::string name;
  Kind kind = Kind::point;
  int block = 0;
  Vector3 point = Vector3::Zero();                   ///< reference coordinates, m; for a block its centroid
  int other = -1;                                    ///< for a pair: the second block
  std::string bolt = {};                             ///< for a bolt: its name
  std::shared_ptr<const DriftLevels> levels = {};    ///< for a drift, otherwise null
  std::shared_ptr<const JointPolygons> joints = {};  ///< for cracks, otherwise null
  /// Of a scene with [[crack]], by block: number of the block of the scene of which it is a part; otherwise null
  std::shared_ptr<const std::vector<int>> parts = {};
  Vector3 origin = Vector3::Zero();  ///< m, Scene::origin, of measured places
  Vector3 up = Vector3::UnitZ();     ///< unit vector against gravity
};

/// Measures of a scene, in its order, and of one with [[crack]] the energy of the cracks. A point of a block that has cracked
/// is that of the part at the point, the block its first part. @param blocks of the simulation
[[nodiscard]] std::vector<Measure> measures_of(const Scene& scene, const std::vector<BlockModel>& blocks);

/// Results of other processes that measures are evaluated from: states of their blocks, and contacts of measured pairs.
[[nodiscard]] ResultNeeds needs_of(const std::vector<Measure>& measures);

/// Motion of the measured point, its place in the user's coordinates; nan if its block is absent. @param measure of a point or block
[[nodiscard]] PointMotion measured_motion(const Simulation& simulation, const Measure& measure);

/// Rotation of a block since it was placed: axis times angle, degrees, 0 to 180, of the rotation in the polar
/// decomposition of the deformation gradient at its centroid; nan if the block is absent.
[[nodiscard]] Vector3 measured_turn(const Simulation& simulation, const Measure& measure);

/// Slip of block a of a pair along block b at a contact point since both were placed, m, perpendicular to the normal;
/// zero if one of them is incremental.
[[nodiscard]] Vector3 slip_of(const Simulation& simulation, const PairRecord& pair, std::size_t index);

/// The contacts of two blocks after the last step.
struct PairMeasure {
  double normal_force = 0.0;  ///< N, sum over the points, compression positive
  double shear_force = 0.0;   ///< N, length of the sum of the shear forces
  double opening;             ///< m, mean gap over the area of the points, negative: depth; nan: no points
  double slip;        ///< m, slip of the blocks along each other since they were placed, mean over the area;
                      ///< nan: no points, or an incremental block
  double area = 0.0;  ///< m^2, of closed points
};
[[nodiscard]] PairMeasure measured_pair(const Simulation& simulation, const Measure& measure);

/// A bolt or prop after the last step.
struct BoltMeasure {
  double axial_force;       ///< N, largest by its amount along the bar, tension positive; nan: not installed
  double shear_force;       ///< N, largest at any joint; nan: not installed
  BoltCondition condition;  ///< worst so far
};
[[nodiscard]] BoltMeasure measured_bolt(const Simulation& simulation, const Measure& measure);

}  // namespace ashlar
