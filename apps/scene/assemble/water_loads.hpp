// Water of a scene as loads of its blocks: hydrostatic pressure on joints and on free faces below a level.
//
// A joint is the common part of two faces (common_faces.hpp); the rest of a face is free. Pressure acts on the whole
// area of a joint, open or closed, on both blocks alike, so that contact forces are effective. It acts on the faces as
// they are placed: neither areas nor directions change with the motion.
#pragma once

#include <vector>

#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "mechanics/supports/loads.hpp"
#include "mechanics/supports/water_level.hpp"

namespace ashlar {

class WaterLoads {
 public:
  /// @param diagnostics receives levels that are not known over a wet face
  WaterLoads(const LoadedScene& loaded, Diagnostics& diagnostics);

  /// Pressure on a block of the scene; a load without parts if there is none.
  [[nodiscard]] Load of_block(std::size_t block) const;
  /// Pressure in the joint of two blocks at a place, Pa, >= 0; 0 in a dry joint. @param a,b indices of blocks
  [[nodiscard]] double in_joint(std::size_t a, std::size_t b, const Vector3& place) const;

 private:
  struct Water {
    JointSelection joints;
    WaterLevel level;
    double unit_weight;
  };
  /// The last [[water]] of the joint of two blocks; -1: none.
  [[nodiscard]] int water_of_joint(std::size_t a, std::size_t b) const;
  void add_joints(const LoadedScene& loaded, Diagnostics& diagnostics);
  void add_free_faces(const LoadedScene& loaded, Diagnostics& diagnostics);
  /// @param sign -1 takes a part away
  void press(const LoadedScene& loaded, int water, std::size_t block, const std::vector<Vector3>& polygon,
             const Vector3& inward, double sign, Diagnostics& diagnostics);

  std::vector<Water> waters_;
  std::vector<int> faces_;                       ///< (#blocks) the last [[water]] of its free faces; -1: none
  std::vector<std::vector<PressedPart>> parts_;  ///< (#blocks)
};

}  // namespace ashlar
