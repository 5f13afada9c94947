// Cracks that appear in blocks (notes/cracks.md): what a block resists, where it cracks, and the record of its cracks.
//
// A crack divides a block by a plane. The parts have the motion of the whole block, and between them a joint whose
// strength softens by its fracture energy (mechanics/contact/laws/bond_damage.hpp).
#pragma once

#include <vector>

#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {

/// Resistance of a block to cracks.
struct CrackLaw {
  double tensile_strength = 0.0;  ///< Pa, > 0, of the mean tension over least_size
  double least_size = 0.0;        ///< m, > 0: diameter of the means, least width of a part across its crack
  JointLaw joint;                 ///< between the parts; area springs with fracture energy
};

/// A place of a block whose mean tension has reached the strength.
struct WeakPlace {
  int block = -1;
  Plane plane;          ///< across the largest tension, unit normal; reference coordinates, m
  double stress = 0.0;  ///< mean tension across the plane, Pa
};

/// A crack that has divided a block.
struct CrackEvent {
  double time = 0.0;                 ///< s, of its stage
  int stage = 0;                     ///< stages that had ended before
  int block = -1;                    ///< number of the divided block, which the first part keeps
  std::vector<int> parts;            ///< numbers of the parts
  Vector3 point = Vector3::Zero();   ///< of its plane, m, in the placed, undeformed block
  Vector3 normal = Vector3::Zero();  ///< unit
  double area = 0.0;                 ///< m^2
  double stress = 0.0;               ///< mean tension across it as it appeared, Pa
};

/// Tension of blocks at the balance of a load level.
struct LevelTension {
  double time = 0.0;           ///< s, of its stage
  std::vector<double> shares;  ///< by block: largest mean tension over its strength; negative: not looked at
};

/// All cracks of a run: with the blocks of the scene they determine those of the run.
struct CrackRecord {
  std::vector<CrackEvent> events;    ///< in order
  std::vector<int> left_whole;       ///< blocks at their strength that have no room for a crack, increasing
  std::vector<LevelTension> levels;  ///< the last ones of a static stage, at most two, by time
};

}  // namespace ashlar
