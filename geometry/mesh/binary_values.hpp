// Little- and big-endian values in the bytes of a file.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

namespace ashlar {

/// Value in the first sizeof(T) bytes, which must be there.
template <class T>
[[nodiscard]] T read_binary(std::string_view bytes, std::endian order) {
  std::array<char, sizeof(T)> copy;
  std::copy_n(bytes.begin(), sizeof(T), copy.begin());
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

}  // namespace ashlar
