// Error of a block's order, from the residual on the functions of the next orders.
//
// With u of order n and K the stiffness of order m at the present state, m = n + 2 (an even or odd solution has
// nothing in the next order) or the largest order, the residual of the present forces
//     r = F_external + F_contact - F_elastic(u)
// is zero on the functions of order n, but for inertia, which is orthogonal to the others. Then
//     eta^2 = r' K^-1 r                                              r on the functions of degree n + 1 to m alone
// is the square of the distance to the solution of order m in the norm of the strain energy, with the forces of
// contacts and ties as they are; eta^2 / 2 is the strain energy that the block lacks. R. E. Bank and R. K. Smith, SIAM J. Numer.
// Anal. 30 (1993) 921: it is a lower bound of the error if higher orders matter less than the next one. Compliance of
// the contacts and errors of their forces are not in it.
//
// The force of a tie is its stiffness times the gap over the common faces (mechanics/contact/laws/tie.hpp), and so is known on
// the functions of all orders. Nothing is estimated for rigid blocks, incremental ones, blocks of the largest order or
// whose shape allows no higher one, and those with bolts or quiet faces, whose forces are not recorded, with supports that
// move, or with initial stress, whose energy is not that of their deformation.
//
// A block that is neither supported, tied nor loaded, whose contacts have no force and whose elastic force is within
// rounding error has no error, and needs no model of higher order: gravity acts on the mean function alone, and a rigid
// motion has no elastic force, in any order.
#pragma once

#include <optional>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

struct OrderError {
  int block = -1;
  double energy = 0.0;          ///< strain energy, J, >= 0
  double missing_energy = 0.0;  ///< strain energy that its order lacks, J, >= 0; 0 within rounding error

  /// Error over the solution, in the norm of the energy, 0 to 1.
  [[nodiscard]] double relative() const;
};

/// Estimates of some blocks.
struct OrderErrors {
  std::vector<OrderError> errors;  ///< in the order of the blocks
  int blocks = 0;                  ///< that can be estimated, >= errors.size()
};

/// Of all blocks, in their order. After a step or an iteration, at its contact forces.
[[nodiscard]] std::vector<OrderError> order_errors(const Simulation& simulation);

/// The same within a limit of work: of blocks without any error, and then of those with the largest forces that fit in.
/// Each is as that of order_errors(), to the bit. @param most_work >= 0, see order_error_work.hpp
[[nodiscard]] OrderErrors order_errors_within(const Simulation& simulation, double most_work);

/// The block with the functions of the next two orders, or of the next one where its shape does not allow two; where its
/// supports leave these no motion, of the first order that has any. Empty: none is allowed, or the block is fixed, rigid,
/// incremental or has dashpots.
[[nodiscard]] std::optional<BlockModel> with_further_orders(const BlockModel& block);
/// The same, with data shared with other blocks made with the library.
[[nodiscard]] std::optional<BlockModel> with_further_orders(const BlockModel& block,
                                                            BlockPartsLibrary& library);

/// The part of a force on functions of the higher order that those of the lower one do not have. @param low,high one
/// block in two orders. @param force (p of high, 3). @return (unknowns of high)
[[nodiscard]] Eigen::VectorXd part_on_new_functions(const BlockModel& low, const BlockModel& high,
                                                    const Eigen::MatrixX3d& force);

/// All blocks together; 0 if there are none or none deforms. @return as OrderError::relative
[[nodiscard]] double relative_error(const std::vector<OrderError>& errors);

}  // namespace ashlar
