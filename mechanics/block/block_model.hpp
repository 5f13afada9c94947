// A block: constant data (BlockModel) and data changed by a step (BlockState). A step is a function of both.
//
//   x(X, t) = sum_a phi_a(X) q_a(t)      theory.md section 1
// A rigid block has the coefficients of order 1 with the constraints of rigid_body.hpp.
// In the total formulation X is the placed, undeformed block. In the incremental one X is the block at the
// start of the step: each step has a model of its own (carried_on), with q at the identity map in between.
// Coefficient arrays are (p, 3), see elasticity.hpp.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mechanics/basis/basis.hpp"
#include "mechanics/block/block_definition.hpp"
#include "mechanics/block/block_parts.hpp"
#include "mechanics/block/incremental_block.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "mechanics/material/elasticity.hpp"
#include "mechanics/material/st_venant_kirchhoff.hpp"
#include "mechanics/supports/support_motion.hpp"
#include "mechanics/supports/supports.hpp"

namespace ashlar {

/// Coefficients of position and velocity.
struct BlockState {
  Eigen::MatrixX3d position;  ///< q, m^5/2
  Eigen::MatrixX3d velocity;  ///< dq/dt
};

/// A material point in some state.
struct PointMotion {
  Vector3 place;           ///< m
  Vector3 displacement;    ///< from the placed, undeformed block, m
  Vector3 velocity;        ///< m/s
  Eigen::Matrix3d stress;  ///< Cauchy, Pa, tension positive
};

struct CarriedBlock;

/// Constant after construction, except for the factors of its loads.
class BlockModel {
 public:
  /// @throws std::invalid_argument, std::domain_error as PolynomialBasis, AdmissibleSpace,
  /// load_coefficients and IncrementalForm do, for a rigid block that has supports or is incremental, for initial
  /// stress in a block that is incremental or of St.-Venant-Kirchhoff elasticity, and for quiet faces of a block that
  /// is rigid or incremental or has moving supports
  explicit BlockModel(BlockDefinition definition);
  /// The same, with data shared with other blocks made with the library.
  BlockModel(BlockDefinition definition, BlockPartsLibrary& library);

  /// The same block of the total formulation with another order, >= 1. @throws std::invalid_argument for a fixed,
  /// incremental or rigid one, and for one whose quiet faces are released
  [[nodiscard]] BlockModel with_order(int order) const;
  /// The same, with data shared with other blocks made with the library.
  [[nodiscard]] BlockModel with_order(int order, BlockPartsLibrary& library) const;

  /// Null for blocks of the total formulation.
  [[nodiscard]] const IncrementalForm* incremental() const { return form_.get(); }
  /// Shape of an incremental block at the start of the step.
  [[nodiscard]] const CarriedShape& carried() const { return carried_; }
  /// The model of the next step of an incremental block. @param position at the end of this one
  /// @throws std::exception if the shape is no longer a valid block
  [[nodiscard]] CarriedBlock carried_on(const Eigen::MatrixX3d& position) const;
  /// An incremental block with another shape.
  [[nodiscard]] BlockModel with_shape(CarriedShape shape) const;

  [[nodiscard]] const std::string& name() const { return definition_.name; }
  [[nodiscard]] const Polyhedron& solid() const { return *definition_.solid; }
  [[nodiscard]] const Material& material() const { return definition_.material; }
  [[nodiscard]] bool fixed() const { return definition_.fixed; }
  [[nodiscard]] bool supported() const { return !definition_.supports.empty() || holds_quiet_faces(); }
  /// True if the block has quiet faces (quiet_faces.hpp).
  [[nodiscard]] bool quiet() const { return !definition_.quiet.empty(); }
  /// True if they are held: until motion begins.
  [[nodiscard]] bool holds_quiet_faces() const { return quiet() && !definition_.released; }
  /// The same block with quiet faces that are held, or have dashpots and no reaction. Only if quiet().
  [[nodiscard]] BlockModel with_quiet_faces(bool released, BlockPartsLibrary& library) const;
  /// Z' C Z of the dashpots, (unknowns, unknowns); null: none
  [[nodiscard]] const Eigen::MatrixXd* dashpots() const { return dashpots_.get(); }
  /// Constant force of the ground behind released quiet faces, (p, 3), a part of load_force(); empty: none
  [[nodiscard]] const Eigen::MatrixX3d& reaction() const { return reaction_; }
  /// @param reaction (p, 3). @throws std::invalid_argument unless quiet faces are released
  void set_reaction(Eigen::MatrixX3d reaction);
  /// Order of the basis: 1 for rigid blocks.
  [[nodiscard]] int order() const { return basis_.order(); }
  /// True if it does not deform: a moving block of order 0.
  [[nodiscard]] bool rigid() const { return definition_.order == 0 && !fixed(); }
  [[nodiscard]] const PolynomialBasis& basis() const { return basis_; }
  /// Data shared with equal blocks.
  [[nodiscard]] const std::shared_ptr<const BlockParts>& parts() const { return parts_; }
  [[nodiscard]] const AdmissibleSpace& space() const { return parts_->space; }
  /// Number of free coefficients; 0 for fixed blocks. Those of a rigid block depend on 6 of freedom().
  [[nodiscard]] int unknowns() const { return fixed() ? 0 : space().unknowns(); }
  /// Degrees of freedom of the motion: number of its equations.
  [[nodiscard]] int freedom() const { return rigid() ? rigid_freedom : unknowns(); }
  /// True if the frame of linear elasticity turns with the block (theory.md section 4).
  [[nodiscard]] bool corotational() const { return !form_ && parts_->turns; }
  [[nodiscard]] double mass() const { return material().density * basis_.volume(); }
  /// Cube root of the volume, m.
  [[nodiscard]] double size() const { return size_; }

  /// Undeformed and at rest.
  [[nodiscard]] BlockState initial_state() const;
  /// Coefficients of the velocity field  velocity + angular_velocity x (X - centroid), restricted to the motions
  /// allowed by supports.
  [[nodiscard]] Eigen::MatrixX3d rigid_velocity(const Vector3& velocity,
                                                const Vector3& angular_velocity) const;
  /// Equilibrium, without contacts, of a block whose supports prevent all rigid motions, under gravity and its loads
  /// at a time. For an incremental block it is that of a step, which ends a little off equilibrium. Empty if the
  /// supports allow a rigid motion, or if none is found for a St.-Venant-Kirchhoff block.
  [[nodiscard]] std::optional<Eigen::MatrixX3d> equilibrium(const Vector3& gravity, double time) const;

  /// Gravity and loads at a time. @return (p, 3), N m^-3/2
  [[nodiscard]] Eigen::MatrixX3d external_force(const Vector3& gravity, double time) const;
  /// Loads, waves and reaction, without gravity. @return (p, 3)
  [[nodiscard]] Eigen::MatrixX3d load_force(double time) const;
  /// Stress of the definition; empty: none, also if the block cannot have any.
  [[nodiscard]] const StressField& initial_stress() const { return definition_.initial_stress; }
  /// Loads in the order of the definition.
  [[nodiscard]] const std::vector<Load>& loads() const { return definition_.loads; }
  /// @param load index into loads(). @throws std::out_of_range
  void set_load_factor(std::size_t load, double factor) { definition_.loads.at(load).factor = factor; }
  /// True if a support of the block moves.
  [[nodiscard]] bool driven() const { return motion_.moves(); }
  /// Motion due to supports between two times, besides that of the unknowns. @param position at the first one.
  /// @return (p, 3), orthogonal to all motions of the unknowns; empty if not driven
  [[nodiscard]] Eigen::MatrixX3d prescribed_change(const Eigen::MatrixX3d& position, double from,
                                                   double to) const;
  /// Velocity of supports at the end of a step. @param change prescribed_change of the step
  /// @param step s, > 0. @return (p, 3); only if driven
  [[nodiscard]] Eigen::MatrixX3d prescribed_velocity(const Eigen::MatrixX3d& change, double from,
                                                     double step) const;
  /// True if any load, wave or support may differ between two times.
  [[nodiscard]] bool loads_change_between(double start, double end) const;
  /// Energy, force and frame of a configuration.
  [[nodiscard]] ElasticResponse elastic(const Eigen::MatrixX3d& position) const;
  /// The rigid motion nearest to a position. @param position (p, 3). @return (p, 3)
  [[nodiscard]] Eigen::MatrixX3d rigid_position(const Eigen::MatrixX3d& position) const;
  /// A block of the total formulation without strain, with its present rotation but at its reference place.
  /// @param position (p, 3). @return (p, 3)
  [[nodiscard]] Eigen::MatrixX3d unstrained(const Eigen::MatrixX3d& position) const;
  /// Tangent Z' R K R' Z of the internal force in the unknowns; of St.-Venant-Kirchhoff blocks the one of the
  /// undeformed block, turned. @return (unknowns, unknowns)
  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::Matrix3d& rotation) const;

  /// Tangent of the internal force at a configuration, in the unknowns. @param elastic its response
  /// @param positive leave out terms that may make it indefinite. @return (unknowns, unknowns), symmetric
  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::MatrixX3d& position, const ElasticResponse& elastic,
                                        bool positive = false) const;
  /// True if the tangent depends on the rotation only; false for St.-Venant-Kirchhoff blocks.
  [[nodiscard]] bool tangent_turns() const { return !parts_->large; }
  /// tangent(rotation) times a change, without the matrix. @param y (unknowns). @return (unknowns)
  [[nodiscard]] Eigen::VectorXd tangent_times(const Eigen::Matrix3d& rotation,
                                              const Eigen::VectorXd& y) const;
  /// Size of the rounding errors of the internal force of a block at rest, in the norm of the unknowns.
  [[nodiscard]] double force_rounding() const;

  /// Momentum and angular momentum about the origin, kg m/s and kg m^2/s.
  [[nodiscard]] Vector3 momentum(const BlockState& state) const;
  [[nodiscard]] Vector3 angular_momentum(const BlockState& state) const;
  /// 1/2 rho |v|^2, J.
  [[nodiscard]] double kinetic_energy(const BlockState& state) const;
  /// -m g . x_centroid, J.
  [[nodiscard]] double gravity_energy(const BlockState& state, const Vector3& gravity) const;
  /// Cauchy stress at a material point, Pa, tension positive.
  [[nodiscard]] Eigen::Matrix3d stress(const BlockState& state, const Vector3& point) const;
  /// Motion of a point of the placed, undeformed block. @param reference m; for an incremental block one of the
  /// points of IncrementalForm::place
  [[nodiscard]] PointMotion motion_of(const BlockState& state, const Vector3& reference) const;
  /// Many points at once: the cost per point is linear in the number of functions, not quadratic.
  [[nodiscard]] std::vector<PointMotion> motions_of(const BlockState& state,
                                                    const std::vector<Vector3>& references) const;

 private:
  /// Cauchy stresses where the functions have these values. @param phi (#points, p)
  [[nodiscard]] std::vector<Eigen::Matrix3d> stresses(const BlockState& state,
                                                      const Eigen::MatrixXd& phi) const;
  BlockModel(BlockDefinition definition, std::shared_ptr<const IncrementalForm> form, CarriedShape carried,
             const BlockPartsLibrary::Found& found);
  /// Dashpots and waves of released quiet faces.
  void start_quiet_faces();

  BlockDefinition definition_;
  PolynomialBasis basis_;
  double size_;  ///< m
  std::shared_ptr<const BlockParts> parts_;
  SupportMotion motion_;
  Eigen::MatrixX3d natural_;  ///< shape without strain, (p, 3): with initial stress not the placed one
  std::vector<Eigen::MatrixX3d> loads_;  ///< coefficients at factor 1, in the order of the definition
  std::shared_ptr<const IncrementalForm> form_;
  CarriedShape carried_;
  /// Traction of a wave at released quiet faces.
  struct Driving {
    Eigen::MatrixX3d force;  ///< (p, 3) at factor 1
    History history;
  };
  std::vector<Driving> driving_;
  std::shared_ptr<const Eigen::MatrixXd> dashpots_;  ///< null unless quiet faces are released
  Eigen::MatrixX3d reaction_;
};

/// The next step of an incremental block.
struct CarriedBlock {
  BlockModel model;
  Eigen::MatrixXd re_expansion;  ///< (p, p)

  /// Transfers a velocity or acceleration, restricted to the motions allowed by supports. @param field (p, 3)
  [[nodiscard]] Eigen::MatrixX3d taken_over(const Eigen::MatrixX3d& field) const;
};

}  // namespace ashlar
