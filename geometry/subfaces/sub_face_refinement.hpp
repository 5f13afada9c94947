// Sub-faces of a curved block: triangles of its faces, divided as the certified chord error requires (theory.md
// section 6.2).
//
// Triangles of the mesh are bisected at their longest side in reference coordinates, neighbours along with
// them, so that the division stays conforming and its angles bounded. A triangle is divided while the bound
// of its chord error (bernstein_triangle.hpp) exceeds the tolerance and some neighbour is in its reach; it is
// joined again once the bound falls below half the tolerance or nothing is in reach any more. Since
// everything is in reference coordinates, dividing and joining lose nothing.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "geometry/subfaces/bernstein_triangle.hpp"
#include "geometry/subfaces/sub_face_forest.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"

namespace ashlar {

/// Demand for the division of the faces of a block.
struct DivisionDemand {
  double chord_tolerance;           ///< m, > 0; infinity: no division
  std::span<const Box> neighbours;  ///< along AdaptiveSurface's axes: only cells that meet one are divided
};

/// A division: all data that the next one depends on besides the shape and the demand.
struct SurfaceDivision {
  std::vector<std::uint64_t> cuts;    ///< names of the triangles that are cut, in order (SubFaceForest::cuts)
  std::vector<std::uint64_t> wanted;  ///< of them those divided by their own chord error
};

/// A cell's true, curved shape.
struct CellShape {
  Box box;             ///< contains the curved patch
  double chord_bound;  ///< BernsteinTriangle::chord_bound, m
};

/// Changes with every update.
class AdaptiveSurface {
 public:
  /// Limits of the division: at most so many cells, and SubFaceForest::max_bisections of one triangle; chord_bound()
  /// then gives the error reached.
  static constexpr int max_cells = 1 << 15;

  /// @param solid must outlive this. @param order of the block's motion, 1 to BernsteinForm::max_order
  /// @param levels uniform levels (0 to 8) the adaptive division starts from
  /// @param axes (3, 3), orthonormal columns, of the boxes used for reach: the division of a scene rotated together
  /// with its axes is unchanged
  AdaptiveSurface(const Polyhedron& solid, int order, int levels,
                  const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());

  /// Reference coordinates of the points whose current positions an update needs, m.
  [[nodiscard]] const std::vector<Vector3>& domain_points() const { return domain_points_; }

  /// Updates the surface to the block's present shape. @param values (3, #domain_points), current positions, m
  void move(const Eigen::Ref<const Eigen::Matrix3Xd>& values);
  /// Contains the curved surface, as moved last; along the axes.
  [[nodiscard]] const Box& box() const { return box_; }

  /// Divides and joins as demanded of the present shape. @return true if the cells changed
  bool divide(const DivisionDemand& demand);

  [[nodiscard]] const SubFaceSurface& surface() const { return surface_; }
  /// (#cells), as of the last division.
  [[nodiscard]] const std::vector<CellShape>& cell_shapes() const { return cell_shapes_; }
  /// The curved patch of a cell, as of the last division.
  [[nodiscard]] const BernsteinTriangle& patch(int cell) const;
  /// Largest of all cells, m, as of the last division.
  [[nodiscard]] double chord_bound() const;

  /// chord_bound() of the present cells in another shape. @param values as for move()
  [[nodiscard]] double chord_bound_in(const Eigen::Ref<const Eigen::Matrix3Xd>& values) const;

  /// Upper bound of the displacement of any surface point between two shapes, m. @param before, after as for move()
  [[nodiscard]] double motion_bound(const Eigen::Ref<const Eigen::Matrix3Xd>& before,
                                    const Eigen::Ref<const Eigen::Matrix3Xd>& after) const;

  /// Bounds of the magnitudes of polynomials of the surface's order anywhere on it.
  /// @param values (#domain_points, k) of k polynomials. @return (k)
  [[nodiscard]] Eigen::RowVectorXd largest_values(const Eigen::MatrixXd& values) const;

  /// The triangles divided by their own chord error, in the order of their names.
  [[nodiscard]] std::vector<std::uint64_t> wanted() const;
  [[nodiscard]] SurfaceDivision division() const { return {forest_.cuts(), wanted()}; }
  /// Restores the division of another surface of the same solid, order and levels, with the same numbers of cells and
  /// points. As a new one, it has no shape until move(). @throws std::invalid_argument if it does not belong to such a surface
  void restore(const SurfaceDivision& division);

 private:
  [[nodiscard]] bool needs_division(const SubFaceForest::Node& node, const BernsteinTriangle& patch,
                                    double tolerance, const DivisionDemand& demand) const;
  [[nodiscard]] bool division_fits(const DivisionDemand& demand);
  void divide_anew(const DivisionDemand& demand);
  void divide_to(double tolerance, const DivisionDemand& demand);
  [[nodiscard]] std::vector<BernsteinTriangle> root_patches(
      const Eigen::Ref<const Eigen::Matrix3Xd>& values) const;
  /// The chord bound of a node's patch.
  [[nodiscard]] static double bound_of(const SubFaceForest::Node& node, const BernsteinTriangle& patch);
  void take_leaves(std::vector<int> leaves);

  const Polyhedron* solid_;
  const BernsteinForm* form_;
  Eigen::Matrix3d axes_;
  std::vector<Vector3> domain_points_;
  std::vector<BernsteinTriangle> root_patches_;
  std::vector<int> leaves_;             ///< in the order of the cells
  std::set<std::uint64_t> remembered_;  ///< wanted nodes of the division before, while a new one is made
  SubFaceSurface surface_;
  SubFaceForest forest_;
  std::vector<CellShape> cell_shapes_;
  Box box_;
};

}  // namespace ashlar
