// Size distribution of the blocks of a scene, as a table and as a picture.
#pragma once

#include <string>
#include <vector>

namespace ashlar {

/// Size classes with bounds 1, 2 and 5 times powers of ten, or powers of ten alone if these would be too many,
/// without empty classes at the ends.
struct SizeClass {
  double from, to;  ///< m^3; a volume equal to `to` belongs to the next class
  int blocks = 0;
  double volume = 0.0;  ///< m^3, of all of them
};

/// @param volumes m^3, > 0
[[nodiscard]] std::vector<SizeClass> size_classes(const std::vector<double>& volumes);

inline constexpr int histogram_width = 800;
inline constexpr int histogram_height = 480;

/// A self-contained SVG: bars of the number of blocks, and the share of volume in blocks of up to a size.
[[nodiscard]] std::string histogram_svg(const std::string& title, const std::vector<SizeClass>& classes);

}  // namespace ashlar
