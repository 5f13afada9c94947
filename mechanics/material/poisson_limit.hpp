// Upper limit of Poisson's ratio: notes/poisson_limit.md.
#pragma once

namespace ashlar {

/// Largest Poisson's ratio at which rounding of coordinates changes stresses by at most 1 % for strains of 1e-6.
/// @param order of the block, >= 1
[[nodiscard]] double largest_poisson_ratio(int order);

}  // namespace ashlar
