// Water as loads of blocks: hydrostatic pressure on joints and on free faces below a level (water_level.hpp).
//
// A joint is the common part of two faces (common_faces.hpp); the rest of a face is free. Pressure acts on the whole
// area of a joint, open or closed, on both blocks alike, so that contact forces are effective. It acts on the faces as
// they are placed: neither areas nor directions change with the motion.
#pragma once

#include <functional>
#include <vector>

#include "mechanics/supports/loads.hpp"
#include "mechanics/supports/water_level.hpp"
#include "solver/ground/ground_block.hpp"

namespace ashlar {

/// Water with one level, and where it is.
struct GroundWater {
  WaterLevel level;
  double unit_weight = 0.0;  ///< N/m^3, > 0
  /// True for the joints that it fills, by the numbers of their blocks; empty: all
  std::function<bool(std::size_t a, std::size_t b)> joints = nullptr;
  std::vector<bool> faces = {};  ///< (#blocks) true: it presses on their free faces; empty: on those of all
};

/// A place that water presses on, and over which its level is not known.
struct UnknownLevel {
  std::size_t water;  ///< index
  std::size_t block;
  Vector3 place;  ///< m, corner of a face or joint
};

class WaterPressure {
 public:
  /// @param waters the last one that fills a joint, or presses on the free faces of a block, counts there
  /// @param blocks as placed, by number; not needed afterwards
  WaterPressure(std::vector<GroundWater> waters, const std::vector<GroundBlock>& blocks);

  /// Not empty: loads are incomplete, as the search ended with the first face and the first joint below no known level.
  [[nodiscard]] const std::vector<UnknownLevel>& unknown_levels() const { return unknown_; }
  /// Pressure on a block, to be added to its loads (BlockDefinition::loads); a load without parts if there is none.
  [[nodiscard]] Load of_block(std::size_t block) const;
  /// Pressure in the joint of two blocks at a place, Pa, >= 0; 0 in a dry joint and where its level is not known.
  /// @param place m
  [[nodiscard]] double in_joint(std::size_t a, std::size_t b, const Vector3& place) const;

 private:
  /// The last water of the joint of two blocks; -1: none.
  [[nodiscard]] int water_of_joint(std::size_t a, std::size_t b) const;
  void add_joints(const std::vector<GroundBlock>& blocks);
  void add_free_faces(const std::vector<GroundBlock>& blocks);
  /// @param sign -1 takes a part away
  void press(const std::vector<GroundBlock>& blocks, int water, std::size_t block,
             const std::vector<Vector3>& polygon, const Vector3& inward, double sign);

  std::vector<GroundWater> waters_;
  std::vector<int> faces_;                       ///< (#blocks) the last water on its free faces; -1: none
  std::vector<std::vector<PressedPart>> parts_;  ///< (#blocks)
  std::vector<UnknownLevel> unknown_;
};

}  // namespace ashlar
