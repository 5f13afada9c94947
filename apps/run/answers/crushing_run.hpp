// Compressive strength in the answers of limit analysis: what joints without one need, and those that crush under loads
// without a factor.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/run/answers/answer.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/limit/limit_analysis.hpp"

namespace ashlar {

/// Warns of compressive strength of joints without an area.
/// @param model of limit_model
void warn_of_idle_crushing(const Scene& scene, const std::optional<RigidModel>& model,
                           Diagnostics& diagnostics);

/// @param path the factor that stands, with the strength that it needs on springs. Of few blocks the strength is that of
/// the plastic limit, which takes longer
[[nodiscard]] CrushingFindings find_crushing(const LimitAnalysis& analysis, const PathAnswer& path,
                                             const SceneAnalysis& asked, int threads);

/// Joints that crush under loads without a factor; empty: none do.
[[nodiscard]] std::string crushing_in_words(const CrushingFindings& findings, const Simulation& simulation);

/// A warning of strength that must not be taken for granted; empty: none.
[[nodiscard]] std::string strength_warning(const CrushingFindings& findings, const Simulation& simulation);

/// least_strength: value (Pa) and joint (two blocks); null: not found, or a strength was given.
[[nodiscard]] nlohmann::ordered_json least_strength_json(const CrushingFindings& findings,
                                                         const Simulation& simulation);

}  // namespace ashlar
