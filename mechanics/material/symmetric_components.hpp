// The order in which the six components of symmetric tensors are counted.
#pragma once

#include <array>

namespace ashlar {

/// (row, column) of each component: xx, yy, zz, xy, yz, xz.
inline constexpr std::array<std::array<int, 2>, 6> symmetric_components = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

}  // namespace ashlar
