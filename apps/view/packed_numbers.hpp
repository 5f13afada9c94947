// Numbers of a result as few bytes: what the page of `ashlar view` holds. page/numbers.js reads them back;
// apps/notes/view_page.md says why they are written so.
//
// All arrays are 16-bit whole numbers, component by component, each less the one before it (modulo 2^16), first the low
// bytes of all, then the high ones: what is equal or regular becomes long runs of equal bytes, which deflate likes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A stream of arrays that one side writes and the other reads in the same order; their lengths are known to both.
class PackedNumbers {
 public:
  /// Whole numbers, modulo 2^16.
  void add_integers(const std::vector<std::int32_t>& values);

  /// Reals of any sizes: 4 bytes for the largest size m (float), then for each value v the whole number
  /// q = sign(v) 32767 sqrt(|v| / m), rounded, -32768 for what is not finite. What is read back, sign(q) m (q / 32767)^2,
  /// is off by sqrt(|v| m) / 32767 at most (and m / 32767^2 near zero): small values keep their digits beside large ones.
  /// @param values (#n x components), tuple after tuple
  void add_reals(const std::vector<double>& values, std::size_t components);

  /// Points in a box: its two corners (6 floats: low x, high x, ...), then their share of each side, 0 to 65535. Off by
  /// 1/131070 of the side at most. @param points finite
  void add_points(const std::vector<Vector3>& points);

  /// Displacements by block: for each block its mean displacement (3 floats; nan if the block is absent) and a whole number
  /// e, for each point the difference to the mean over 2^e, 32767 for 1. The smallest such e is taken, so that a block
  /// that flies away costs the others no digit: off by 2^(e - 16) of its own spread at most.
  /// @param block_of_point 0-based numbers; points of a block lie together
  void add_displacements(const std::vector<Vector3>& displacements, std::span<const int> block_of_point);

  void add_float(double value);

  /// The bytes so far as a zlib stream, which browsers inflate ("deflate" of DecompressionStream), in base64.
  [[nodiscard]] std::string base64() const;
  [[nodiscard]] std::string_view bytes() const { return bytes_; }

 private:
  void add_words(const std::vector<std::uint16_t>& words);

  std::string bytes_;
};

/// A text or any bytes, likewise. @throws std::runtime_error if zlib has no memory
[[nodiscard]] std::string deflated_base64(std::string_view bytes);

}  // namespace ashlar
