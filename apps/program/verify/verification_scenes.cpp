#include "apps/program/verify/verification_scenes.hpp"

#include <stdexcept>
#include <utility>

namespace ashlar {

Simulation simulation_of(const std::string& text, const TrialFactors& factors) {
  Diagnostics diagnostics;
  const auto loaded = load_scene_text(text, "verify.toml", {}, diagnostics);
  if (loaded) {
    if (auto built = build_simulation(*loaded, 1, diagnostics, nullptr, factors))
      return std::move(built->simulation);
  }
  std::string faults;
  for (const Diagnostic& fault : diagnostics.sorted()) faults += fault.message + "; ";
  throw std::runtime_error(faults);
}

}  // namespace ashlar
