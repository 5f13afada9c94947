// Onset of motion beyond a limit: moving blocks, their accelerations and the behaviour of their joints.
#pragma once

#include <string>
#include <vector>

#include "solver/block_pair.hpp"
#include "solver/limit/limit_trial.hpp"
#include "solver/limit/rigid_bolts.hpp"
#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// Behaviour of a joint between two blocks in a motion.
enum class JointMotion { sticks, slides, opens };
struct MovingJoint {
  PairKey blocks;
  JointMotion motion;
};

struct LimitMotion {
  struct Block {
    int block;
    Vector3 about;                 ///< m, centre of gravity of the blocks that move as one with it
    Vector3 acceleration;          ///< of that centre, m/s^2
    Vector3 angular_acceleration;  ///< rad/s^2
  };
  std::vector<Block> blocks;        ///< by block number
  std::vector<MovingJoint> joints;  ///< of at least one moving block
  std::vector<BarForce> bars;       ///< all forces of bolts and props
  std::string mode;  ///< description of the fastest block: "slides on one plane", "topples", ...
};

/// @param program of the model. @param trial with a motion. @return no blocks if nothing moves
[[nodiscard]] LimitMotion limit_motion(const RigidModel& model, const ConeProgram& program,
                                       const LimitTrial& trial);

/// "slides", "sticks", "opens"
[[nodiscard]] const char* to_string(JointMotion motion);

}  // namespace ashlar
