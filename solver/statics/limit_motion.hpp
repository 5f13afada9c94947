// How blocks set off beyond a limit: who moves, how fast, and what their joints do.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/statics/limit_trial.hpp"
#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// Behaviour of a joint between two blocks in a motion.
enum class JointMotion { sticks, slides, opens };
struct MovingJoint {
  std::array<int, 2> blocks;
  JointMotion motion;
};

struct LimitMotion {
  struct Block {
    int block;
    Vector3 about;                 ///< m, centre of gravity of the blocks that move as one with it
    Vector3 acceleration;          ///< of that, m/s^2
    Vector3 angular_acceleration;  ///< rad/s^2
  };
  std::vector<Block> blocks;        ///< by block number
  std::vector<MovingJoint> joints;  ///< with a moving block on either side
  std::string mode;  ///< in words, of the block that sets off fastest: "slides on one plane", "topples", ...
};

/// @param program of the model. @param trial that moves. @return no blocks if nothing moves
[[nodiscard]] LimitMotion limit_motion(const RigidModel& model, const ConeProgram& program,
                                       const LimitTrial& trial);

/// "slides", "sticks", "opens"
[[nodiscard]] const char* to_string(JointMotion motion);

}  // namespace ashlar
