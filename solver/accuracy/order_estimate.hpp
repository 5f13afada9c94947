// Errors of goals by the orders of blocks, from their changes over rounds of orders.
//
// A round raises orders by one. d(k) is the distance of a goal between the rounds k and k - 2: an even function has no odd
// part, so that one order may change nothing. With q = d(k) / d(k - 2), the changes that are left add up to
//     d q / (1 - q)   if they go on as a geometric series,                                                      (1)
//     d / ((n / m)^3 - 1)   if the error falls like n^-3 with the order n, m that of round k - 2                (2)
// Goals of a block with a clamped edge or a sharp corner fall like n^-4l, where the stress goes to infinity like
// r^(l - 1): I. Babuska and M. Suri, SIAM Review 36 (1994) 578; l = 0.71 at a clamped right angle. The larger one counts, as
// the first orders of such a block converge as fast as those of a smooth one.
//
// Notes: notes/accuracy.md.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/accuracy/static_accuracy.hpp"

namespace ashlar {

/// @param rounds at least one, of all goals. @param index of the goal
/// @return relative; infinite if nothing is known yet. If lacks of energy by the next orders are known of all blocks, not
/// more than the error in the norm of the energy
[[nodiscard]] double order_error_of(const std::vector<AccuracyRound>& rounds, std::size_t index,
                                    const Goal& goal);

/// Error of a goal at another order, if its changes fall no faster than n^-3.5 and have been seen to do so up to
/// order 6: slowly, as in (2). @param order >= that of the last round. @return relative; 0 if they fall faster, or
/// nothing is known yet
[[nodiscard]] double slow_error_at(const std::vector<AccuracyRound>& rounds, std::size_t index,
                                   const Goal& goal, int order);

/// Error of the energy of all estimated blocks, relative; 0 if none lacks any.
[[nodiscard]] double error_of_energy(const AccuracyRound& round);

/// The block with the largest lack, if the last order has reduced it by less than half; -1: none.
[[nodiscard]] int slow_block_of(const std::vector<AccuracyRound>& rounds);

/// Lacks by what the last orders have changed: 1/2 (F(u) - F(v)) . (u - v), the elastic forces F of the positions u now and v
/// two rounds ago. A block that has risen by fewer than two orders since, or did not deform then, keeps the larger lack
/// of the last round, and one without any estimate stays so.
/// @param rounds at least two, with positions. @param now with positions, and lacks of the last round
void take_missing_energy_of_changes(const Simulation& simulation, const std::vector<AccuracyRound>& rounds,
                                    AccuracyRound& now);

/// error over the length of a goal, or its least value; infinite if both are 0.
[[nodiscard]] double relative_to(double error, const Goal& goal);

}  // namespace ashlar
