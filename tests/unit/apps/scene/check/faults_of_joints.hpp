// Faults that a check of joints finds in the sample scene.
#pragma once

#include <string>
#include <vector>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test {

/// @param line of the sample that is replaced. @param check (scene, diagnostics)
template <class Check>
std::vector<std::string> faults_of_joints(Check check, int line, const std::string& replacement) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample_with(line, replacement), "s.toml", {}, diagnostics);
  check(scene, diagnostics);
  return printed(diagnostics);
}

}  // namespace ashlar::test
