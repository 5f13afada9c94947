// What equal blocks share: basis, stiffness, supports. A thousand equal blocks take O(p^2) memory and time
// once and O(p) each.
//
// Blocks are equal if their points differ by one translation exactly (not but for rounding), their triangles,
// order, material and supports are the same. Since rounding makes translated coordinates differ, a block can
// be given with the shape it had before it was translated: then that is what is integrated, and its placed
// points are that shape's, rounded.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <memory>
#include <string>

#include "mechanics/basis/basis.hpp"
#include "mechanics/block/block_definition.hpp"
#include "mechanics/material/st_venant_kirchhoff.hpp"

namespace ashlar {

/// Of a block wherever it is. Constant after construction.
struct BlockParts {
  /// @throws as BlockModel does
  BlockParts(const Polyhedron& solid, const PolynomialBasis& basis, const BlockDefinition& definition,
             const std::vector<BlockSupport>& supports);

  AdmissibleSpace space;
  Eigen::MatrixX3d mean_gradients;
  Eigen::MatrixXd stiffness;  ///< K, (3p, 3p), of rigid blocks what order 1 has; empty for fixed blocks
  Eigen::MatrixXd reduced_stiffness;               ///< Z' K Z of a block that cannot turn
  std::shared_ptr<const StVenantKirchhoff> large;  ///< null for linear elasticity
};

/// Finds what a block has in common with those before it.
class BlockPartsLibrary {
 public:
  struct Found {
    PolynomialBasis basis;  ///< where the block is
    std::shared_ptr<const BlockParts> parts;
  };
  /// @throws as BlockModel does
  [[nodiscard]] Found find(const BlockDefinition& definition);
  /// Number of blocks that differed from all before them.
  [[nodiscard]] std::size_t size() const { return parts_.size(); }

 private:
  std::map<std::string, PolynomialBasis> bases_;  ///< by shape and order
  std::map<std::string, std::shared_ptr<const BlockParts>> parts_;
};

}  // namespace ashlar
