// Rock to be cut by tests.
#pragma once

#include <string>

namespace ashlar::test {

/// A cube of 2 m on a slab; additions of a test start at line 17.
inline const std::string rock_scene = R"(analysis = { end_time = 0.01, time_step = 1e-3 }
contact = { friction_angle = 30 }
[[material]]
name = "rock"
density = 2700
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -1], max = [3, 3, 0] }
[[block]]
name = "rock"
material = "rock"
box = { min = [0, 0, 0], max = [2, 2, 2] }
velocity = [1, 0, 0]
)";

}  // namespace ashlar::test
