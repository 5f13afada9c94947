// Compact encoding of the numbers of a result for the page of `ashlar view`. page/numbers.js decodes them;
// apps/notes/view_page.md explains the format.
//
// All arrays are 16-bit integers, component by component, as differences to the preceding one (modulo 2^16), first
// the low bytes of all, then the high ones: equal or regular values become long runs of equal bytes, which deflate
// compresses well.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A stream of arrays, written and read in the same order; their lengths are known to both sides.
class PackedNumbers {
 public:
  /// Whole numbers, modulo 2^16.
  void add_integers(const std::vector<std::int32_t>& values);

  /// Reals of any magnitude: 4 bytes for the largest magnitude m (float), then for each value v the integer q =
  /// sign(v) 32767 sqrt(|v| / m), rounded, -32768 if not finite. The decoded value, sign(q) m (q / 32767)^2, has an
  /// error of at most sqrt(|v| m) / 32767 (and m / 32767^2 near zero): small values keep their digits beside large
  /// ones.
  /// @param values (#n x components), tuple after tuple
  void add_reals(const std::vector<double>& values, std::size_t components);

  /// Points in a box: its two corners (6 floats: low x, high x, ...), then their share of each side, 0 to 65535. The
  /// error is at most 1/131070 of the side. @param points finite
  void add_points(const std::vector<Vector3>& points);

  /// Displacements by block: for each block its mean displacement (3 floats; nan if the block is absent) and an
  /// integer e, for each point the difference to the mean over 2^e, with 32767 for 1. The smallest possible e is
  /// used, so that a block that flies away costs the others no accuracy: the error is at most 2^(e - 16).
  /// @param block_of_point 0-based numbers; points of a block are consecutive
  void add_displacements(const std::vector<Vector3>& displacements, std::span<const int> block_of_point);

  void add_float(double value);

  /// The bytes so far as a zlib stream, which browsers inflate ("deflate" of DecompressionStream), in base64.
  [[nodiscard]] std::string base64() const;
  [[nodiscard]] std::string_view bytes() const { return bytes_; }

 private:
  void add_words(const std::vector<std::uint16_t>& words);

  std::string bytes_;
};

/// The same for any bytes. @throws std::runtime_error if zlib has no memory
[[nodiscard]] std::string deflated_base64(std::string_view bytes);

}  // namespace ashlar
