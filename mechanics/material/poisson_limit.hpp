// How near to 0.5 Poisson's ratio may be: notes/poisson_limit.md.
#pragma once

namespace ashlar {

/// Largest Poisson's ratio at which rounding of coordinates leaves stresses right to 1 % where strains are
/// 1e-6.
/// @param order of the block, >= 1
[[nodiscard]] double largest_poisson_ratio(int order);

}  // namespace ashlar
