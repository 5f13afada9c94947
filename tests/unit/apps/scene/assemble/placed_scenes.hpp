// Placements and parts of scenes for tests of scene_placement.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "apps/scene/assemble/scene_placement.hpp"
#include "apps/scene/assemble/scene_reader.hpp"

namespace ashlar::test_support {

/// A quarter turn about z and (1, 2, 3): (x, y, z) -> (1 - y, 2 + x, 3 + z).
inline ScenePlacement about_z() {
  ScenePlacement placement;
  placement.turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  placement.shift = {1, 2, 3};
  return placement;
}

/// A quarter turn about x and (1, 2, 3): (x, y, z) -> (1 + x, 2 - z, 3 + y).
inline ScenePlacement about_x() {
  ScenePlacement placement;
  placement.turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  placement.shift = {1, 2, 3};
  return placement;
}

inline const std::string start = R"(
material = [{ name = "rock", density = 2000, young_modulus = 1e10, poisson_ratio = 0.2 }]
)";
inline const std::string statics = start + "analysis = { type = \"static\" }\n";
inline const std::string cube =
    "[[block]]\nname = \"A\"\nmaterial = \"rock\"\nbox = { min = [0, 0, 0], max = [2, 4, 6] }\n";

inline Scene scene_of(const std::string& text, const std::string& file = "scene.toml") {
  Diagnostics faults;
  Scene scene = parse_scene(text, file, {}, faults);
  for (const Diagnostic& fault : faults.sorted()) ADD_FAILURE() << fault.message;
  return scene;
}

}  // namespace ashlar::test_support
