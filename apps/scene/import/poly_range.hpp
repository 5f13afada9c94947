// Ranges of a 3DEC data file: which blocks a command is for.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/import/poly_statement.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Properties of a block that ranges go by.
struct PolyPlace {
  int region = 0;
  Vector3 centroid;
};

/// Elements of a range: a block is in it if it is in all of them, with `union` in one of them.
class PolyRange {
 public:
  using Named = std::map<std::string, std::shared_ptr<const PolyRange>>;

  /// Reads the words after `range` up to the end of the command. @throws MeshFileError: an element of another kind, an
  /// unknown name
  PolyRange(PolyStatement& statement, const Named& named);

  /// @return (#places), true for those in it
  [[nodiscard]] std::vector<bool> select(const std::vector<PolyPlace>& places) const;

 private:
  /// Selections of ranges that others name, each made once.
  using Selections = std::map<const PolyRange*, std::vector<bool>>;

  struct Element {
    std::vector<int> regions;                             ///< one of these; or
    std::vector<std::shared_ptr<const PolyRange>> named;  ///< one of these; or
    int axis = 0;                                         ///< the centroid from low to high along it
    double low = 0.0, high = 0.0;
  };

  [[nodiscard]] const std::vector<bool>& select(const std::vector<PolyPlace>& places, Selections& made) const;

  std::vector<Element> elements_;
  bool any_ = false;
  int depth_ = 1;  ///< of ranges that name others
};

}  // namespace ashlar
