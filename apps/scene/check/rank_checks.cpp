#include "apps/scene/check/rank_checks.hpp"

#include <fmt/format.h>

#include <string>

namespace ashlar {

void check_for_ranks(const Scene& scene, Diagnostics& diagnostics) {
  const auto refuse = [&](bool given, const std::string& key, const char* what) {
    if (given)
      diagnostics.error(
          scene.places.key(key),
          fmt::format("{} on several ranks, only one is allowed so far: run it without mpiexec", what));
  };
  refuse(scene.analysis.accuracy.has_value(), "analysis.accuracy", "a choice for an accuracy");
  refuse(!scene.crack.empty(), "crack.0", "cracks that appear");
}

}  // namespace ashlar
