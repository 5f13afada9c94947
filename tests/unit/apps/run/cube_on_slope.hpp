// A scene of one block that slides.
#pragma once

#include <string>

namespace ashlar::test {

/// A cube on a plane inclined by 30 degrees: gravity is turned instead. tan(phi) = 1.2 tan(30).
inline std::string cube_on_slope(const std::string& analysis) {
  return "analysis = { gravity = [5, 0, -8.660254037844386], " + analysis + R"( }
contact = { friction_angle = 34.71500395421209 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-9, -9, -1], max = [9, 9, 0] }
[[block]]
name = "cube"
material = "stone"
box = { min = [-2, -2, 0], max = [2, 2, 1] }
)";
}

}  // namespace ashlar::test
