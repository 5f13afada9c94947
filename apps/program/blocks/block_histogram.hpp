// Size distribution of the blocks of a scene, as a table and as a picture.
#pragma once

#include <string>
#include <vector>

#include "apps/program/plot/plot.hpp"

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

/// Size distribution: shares of volume and of number, in %, in blocks up to a size. Each block is a step.
/// @param volumes m^3, > 0
[[nodiscard]] Plot size_plot(const std::string& title, std::vector<double> volumes);

}  // namespace ashlar
