// Numbers of every block that a run needs before processes share the blocks.
#pragma once

#include "geometry/boxes/box.hpp"
#include "solver/state/automatic.hpp"
#include "solver/state/slowest_vibration.hpp"

namespace ashlar {

/// Numbers of a block as placed.
struct BlockSummary {
  Box box;                             ///< of the solid, m
  Vector3 centroid = Vector3::Zero();  ///< m
  StiffnessSource stiffness;
  int freedom = 0;  ///< BlockModel::freedom
  int order = 1;    ///< BlockModel::order
  bool incremental = false;
  double mass = 0.0;               ///< kg
  double slowest_vibration = 0.0;  ///< 1/s, ashlar::slowest_vibration, of motion

  [[nodiscard]] bool fixed() const { return stiffness.fixed; }
};

/// @param moves true: an analysis of motion
[[nodiscard]] inline BlockSummary summary_of(const BlockModel& block, bool moves) {
  return {box_of(block.solid().mesh().points),
          block.basis().centroid(),
          stiffness_source(block),
          block.freedom(),
          block.order(),
          block.incremental() != nullptr,
          block.mass(),
          moves ? slowest_vibration(block) : 0.0};
}

}  // namespace ashlar
