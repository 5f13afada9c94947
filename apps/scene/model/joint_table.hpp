// Table of the joints between blocks, computed once: a scene may have thousands of both.
//
// A joint that matches a pair matches one of its blocks by its rarer glob, the one that matches fewer blocks. So it
// is listed with those blocks only, and a pair checks the few joints listed with either of its blocks.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/model/scene.hpp"

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
  /// Indices of the blocks matched by the first or the second glob of a joint, increasing. @param side 0 or 1
  [[nodiscard]] const std::vector<std::size_t>& matched(std::size_t joint, std::size_t side) const {
    return *matched_[2 * joint + side];
  }
  /// For each block the globs that match it, increasing, as 2 joint + side. Blocks with the same ones have the same joints:
  /// those that match every block are left out.
  [[nodiscard]] std::vector<std::vector<std::size_t>> globs_of_blocks() const;
  /// True if a joint applies to the faces made by a cut, not to all faces between the blocks it names.
  [[nodiscard]] bool is_of_cut(std::size_t joint) const { return !joints_[joint].cut.empty(); }
  /// Pairs (a < b) that match a joint and have a common face made by its cut, sorted.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_parted_by(std::size_t joint) const;
  /// True if any two different blocks are matched, regardless of cuts.
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
