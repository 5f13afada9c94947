// Numbers of the unknowns of bodies that are shared out among ranks: those of rank 0 first, by body, then of rank 1.
//
// No rank holds the numbers of all bodies: each body has a home rank, which is told its number by the owner, and tells it
// to those who ask.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// Place of a body in a system.
struct BodyPlace {
  std::int64_t first = -1;  ///< number of its first unknown
  int size = 0;             ///< unknowns
};

/// Places of bodies on one rank.
struct RowNumbering {
  std::int64_t first_own = 0;    ///< first unknown of this rank
  std::int64_t own = 0;          ///< unknowns of this rank
  std::int64_t all = 0;          ///< of all ranks
  int common_size = 0;           ///< of all bodies of all ranks; 0: they differ, or there are none
  std::vector<BodyPlace> asked;  ///< by body asked for
};

/// Collective. @param bodies of this rank, global, increasing. @param sizes unknowns of each, > 0
/// @param asked global bodies whose places this rank needs, in any order
/// @throws std::invalid_argument, on the rank that asks, for a body that no rank has
[[nodiscard]] RowNumbering number_rows(Ranks& ranks, const std::vector<int>& bodies,
                                       const std::vector<int>& sizes, const std::vector<int>& asked);

}  // namespace ashlar
