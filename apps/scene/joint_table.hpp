// Which joints hold between which blocks, found once: a scene may have thousands of both.
//
// A joint that matches a pair matches one of its blocks by its rarer glob, the one that fewer blocks match.
// So it is listed with those blocks only, and a pair asks the few joints that are listed with either of its
// blocks.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/scene.hpp"

namespace ashlar {

class JointTable {
 public:
  explicit JointTable(const Scene& scene);
  JointTable(const JointTable&) = delete;
  JointTable& operator=(const JointTable&) = delete;

  /// Joints that match a pair, in file order. @param a,b indices of scene.block, different
  [[nodiscard]] std::vector<std::size_t> joints_between(std::size_t a, std::size_t b) const;
  /// As joint_law_between(scene, name, name).
  [[nodiscard]] SceneJointLaw law_between(std::size_t a, std::size_t b) const;
  /// Indices of the blocks that the first or the second glob of a joint matches, increasing. @param side 0 or
  /// 1
  [[nodiscard]] const std::vector<std::size_t>& matched(std::size_t joint, std::size_t side) const {
    return *matched_[2 * joint + side];
  }
  /// Whether a joint is of the faces that a cut made, not of all between the blocks it names.
  [[nodiscard]] bool is_of_cut(std::size_t joint) const { return !joints_[joint].cut.empty(); }
  /// Pairs (a < b) that a joint matches and its cut has given a common face, sorted.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_parted_by(std::size_t joint) const;
  /// Whether some two different blocks are matched, cuts aside.
  [[nodiscard]] bool matches_a_pair(std::size_t joint) const;

 private:
  [[nodiscard]] bool matches(std::size_t joint, std::size_t side, std::size_t block) const;

  SceneJointLaw law_;  ///< of [contact]
  std::vector<SceneJoint> joints_;
  std::shared_ptr<const CutRock> rock_;
  std::vector<std::string> cut_names_;
  std::map<std::string, std::vector<std::size_t>> blocks_of_;  ///< by glob: indices of the blocks, increasing
  std::vector<const std::vector<std::size_t>*> matched_;       ///< (2 #joints) into blocks_of_
  std::vector<std::vector<std::size_t>> listed_;               ///< (#blocks) joints whose rarer glob matches
};

}  // namespace ashlar
