// Blocks and groups of blocks that can leave a structure, each at its own factor on strengths.
//
// The mechanism of limit analysis is that of the least factor; what moves at larger ones stays hidden behind it. So the blocks
// of a mechanism are held where they are, and the rest is analysed again, until nothing moves up to the largest factor. Each
// block belongs to one group. Factors are those of motion that starts without forces in joints (LimitAnalysis, `released`),
// with all strengths of joints and bolts; held blocks support the others, as bolted ones do.
#pragma once

#include <functional>
#include <vector>

#include "solver/limit/limit_analysis.hpp"

namespace ashlar {

struct KeyGroup {
  std::vector<int> blocks;      ///< by number
  std::optional<double> lower;  ///< largest factor that stands; empty: it moves at all factors of the search
  double upper = 0.0;           ///< smallest factor that moves
  LimitMotion motion;           ///< there
  /// N, against the motion at factor `wanted`: the sum of masses times accelerations of its blocks; zero: they stand
  Vector3 needed = Vector3::Zero();
};

struct KeyGroupSearch {
  LimitSearch factors;
  double wanted = 1.0;  ///< > 0, factor for which the needed force is told
  int most = 50;        ///< groups
  int threads = 1;
  std::function<bool()> may_continue = [] {
    return true;
  };  ///< called before each analysis; false ends the search
};

/// By increasing factor. @param reduced by point of the model: its strength is divided
[[nodiscard]] std::vector<KeyGroup> key_groups(const RigidModel& model, const std::vector<bool>& reduced,
                                               const KeyGroupSearch& search);

}  // namespace ashlar
