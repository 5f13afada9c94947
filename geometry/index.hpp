// Numbers of points, faces and blocks as places in arrays.
#pragma once

#include <cstddef>

namespace ashlar {

/// @param index >= 0
[[nodiscard]] constexpr std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace ashlar
