// Verdict on a run in time: blocks that have fallen, blocks out of their places, and rest or motion at its end.
#pragma once

#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// A block falls when its centroid is lower than it was placed, along gravity, by half its size (block_size).
inline constexpr double fallen_share = 0.5;
/// Speed of blocks at rest, of sqrt(g L) with the size L of the block: what it gains by falling 5e-7 of its size.
inline constexpr double resting_share = 1e-3;

struct BlockFall {
  int block;
  double time;  ///< s, of the run's stage, when it first was that low
};

/// Falls so far, in the order of time.
struct FallRecord {
  std::vector<BlockFall> falls;

  /// Notes the state after a step in time, of the blocks of this process. Nothing falls without gravity.
  void note(const Simulation& simulation);
};
/// The first falls of all processes, by time.
[[nodiscard]] FallRecord merged(const std::vector<FallRecord>& of_ranks);

struct MotionVerdict {
  struct Fallen {
    int block;
    double time;      ///< s
    double drop;      ///< m, at the end, along gravity
    double distance;  ///< m, of its centroid from where it was placed
    double runout;    ///< m, the part of it across gravity
    bool left;        ///< its centroid is below all blocks that are fixed or have supports
  };
  std::vector<Fallen> fallen;
  int all = 0;         ///< blocks that may move
  int displaced = 0;   ///< blocks more than a tenth of their size from their places, the fallen ones included
  int moving = 0;      ///< blocks faster than those at rest
  int fastest = -1;    ///< of these; -1: there is none
  double speed = 0.0;  ///< m/s, root mean square over it
  [[nodiscard]] bool at_rest() const { return moving == 0; }
};

/// On the blocks of this process.
[[nodiscard]] MotionVerdict verdict_of(const Simulation& simulation, const FallRecord& record);
/// On those of all processes.
[[nodiscard]] MotionVerdict merged(const std::vector<MotionVerdict>& of_ranks);

/// "at rest; 2 of 40 blocks have fallen: roof.1 at 0.42 s by 3.1 m, roof.2 at 0.6 s by 2.9 m", "3 of 8 blocks move, block
/// top fastest: 1.2 m/s"
[[nodiscard]] std::string describe(const MotionVerdict& verdict, const Simulation& simulation);

}  // namespace ashlar
