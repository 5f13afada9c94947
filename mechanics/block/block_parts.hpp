// Data shared by equal blocks: basis, stiffness, supports. A thousand equal blocks need O(p^2) memory and time once
// and O(p) each.
//
// Blocks are equal if their points differ by exactly one translation (without rounding), and their triangles, order,
// material and supports are the same. Since rounding makes translated coordinates differ, a block can be given with
// its shape before translation. Integrals are then those of the shape, and the placed points are those of the shape,
// rounded.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/basis/basis.hpp"
#include "mechanics/block/block_definition.hpp"
#include "mechanics/material/st_venant_kirchhoff.hpp"

namespace ashlar {

/// Data of a block that do not depend on its place. Constant after construction.
struct BlockParts {
  /// @throws as BlockModel does
  BlockParts(const Polyhedron& solid, const PolynomialBasis& basis, const BlockDefinition& definition,
             const std::vector<BlockSupport>& supports);

  AdmissibleSpace space;
  bool turns;  ///< the frame of linear elasticity turns with the block
  Eigen::MatrixX3d mean_gradients;
  Eigen::MatrixXd stiffness;  ///< K, (3p, 3p), for rigid blocks that of order 1; empty for fixed blocks
  Eigen::MatrixXd reduced_stiffness;               ///< Z' K Z of a block whose frame does not turn
  std::shared_ptr<const StVenantKirchhoff> large;  ///< null for linear elasticity
};

/// Finds data of a block that earlier blocks share.
class BlockPartsLibrary {
 public:
  struct Found {
    PolynomialBasis basis;  ///< at the place of the block
    std::shared_ptr<const BlockParts> parts;
  };
  /// @throws as BlockModel does
  [[nodiscard]] Found find(const BlockDefinition& definition);
  /// Number of blocks that differed from all before them.
  [[nodiscard]] std::size_t size() const { return parts_.size(); }
  /// A hash of each of those: equal blocks have equal ones in all libraries of one program.
  [[nodiscard]] std::vector<std::size_t> kinds() const;

 private:
  std::map<std::string, PolynomialBasis> bases_;  ///< by shape and order
  std::map<std::string, std::shared_ptr<const BlockParts>> parts_;
};

}  // namespace ashlar
