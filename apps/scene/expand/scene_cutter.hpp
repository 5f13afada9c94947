// State of a scene during the cuts: the pieces of each block and their names.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/expand/joint_planes.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

class SceneCutter {
 public:
  /// @param solids placed, one per block; those without a solid are not cut
  SceneCutter(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
              Diagnostics& diagnostics);

  /// Makes one cut, or reports why it is impossible.
  void make_cut(std::size_t index);
  [[nodiscard]] CutRock&& take() { return std::move(rock_); }

 private:
  /// Pieces of one block affected by a cut.
  struct Target {
    std::size_t block;
    std::vector<int> pieces;  ///< increasing
    int newest;               ///< largest number of a piece before the cut
  };

  [[nodiscard]] std::vector<Target> targets_of(std::size_t cut);
  [[nodiscard]] CutSolid& solid_of(std::size_t block);
  /// Reports a cut that would make too many blocks. @return true if it is allowed
  bool check_number(std::size_t index, double added);
  /// Reports a set whose point is too far from the blocks, or with too many planes in them.
  bool check_distance(std::size_t index, const std::vector<PlaneRange>& ranges);
  bool check_planes(std::size_t index, const JointHeights& heights);
  void cut_by_planes(std::size_t index, const Target& target, const std::vector<JointHeight>& heights);
  [[nodiscard]] PlaneRange range_of(const SceneCut& cut, const Target& target);
  void cut_by_set(std::size_t index, const std::vector<Target>& targets);
  void cut_by_discs(std::size_t index, const std::vector<Target>& targets);
  /// True if a disc about the plane's point meets the section of a piece. Counts those that do not cover it.
  bool is_met(std::size_t cut, const CutSolid& solid, int piece, const CutPlane& plane, double radius);
  void cut_by_solid(std::size_t index, const std::vector<Target>& targets);
  void cut_by_points(std::size_t index, const std::vector<Target>& targets);
  int add_mark(std::size_t cut, int plane);
  /// Label of the pieces inside the solid of a cut that had another label before.
  int add_inside(std::size_t cut, int label);
  void error(std::size_t cut, const char* key, std::string message);

  const Scene& scene_;
  const std::vector<std::optional<Polyhedron>>& shapes_;
  Diagnostics& diagnostics_;
  CutRock rock_;
};

}  // namespace ashlar
