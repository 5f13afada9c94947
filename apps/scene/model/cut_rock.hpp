// Result of the cuts of a scene: origin of each piece, and the cut that made the faces between two.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/cutting/cut_solid.hpp"

namespace ashlar {

struct CutRock {
  struct Origin {
    std::size_t uncut;  ///< index into Scene::uncut
    int piece = -1;     ///< of its CutSolid; -1: no cut divided the block
  };
  /// Origin of a mark on a face.
  struct Mark {
    std::size_t cut;  ///< index into Scene::cut
    int plane;        ///< number of the plane among those of the cut; 0 if it has none
  };
  /// A plane of a cut that contains a face of a block.
  struct Side {
    std::size_t uncut;
    int plane;
    bool below;
    std::size_t cut;
    friend auto operator<=>(const Side&, const Side&) = default;
  };

  std::vector<std::optional<CutSolid>> solids;  ///< by uncut block; empty where no cut matched
  std::vector<Origin> origin;                   ///< by block
  std::vector<Mark> marks;                      ///< by mark
  std::vector<int> glued;                       ///< by cut: number of pieces glued to others
  std::vector<int> extended;  ///< by cut: number of pieces divided by a joint that ends inside
  std::vector<std::vector<std::size_t>> insides;  ///< by label of a piece - 1: cuts by solids that contain it
  std::vector<std::vector<std::string>> other_names;  ///< by block: names of a piece beside its own
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> common;  ///< see cuts_between
  std::vector<std::vector<Side>> sides;                                            ///< by block, sorted

  /// The cuts that made common faces of two blocks. If there are none, the cuts on whose planes they have faces on
  /// opposite sides, where they may come into contact. Increasing.
  [[nodiscard]] std::vector<std::size_t> cuts_between(std::size_t a, std::size_t b) const;
  /// Computes `common` and `sides` from the other members.
  void find_borders();
};

}  // namespace ashlar
