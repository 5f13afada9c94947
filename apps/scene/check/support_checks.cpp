#include "apps/scene/check/support_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/expand/support_lines.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "mechanics/bolt/bolt_strength.hpp"

namespace ashlar {
namespace {

void check_names(const Scene& scene, Diagnostics& diagnostics) {
  std::map<std::string, Place> first_places;
  const auto check = [&](const std::string& name, const std::string& path) {
    if (name.empty()) return;
    const Place place = scene.places.value(path + ".name");
    const auto [first, is_new] = first_places.emplace(name, place);
    if (!is_new)
      diagnostics.error(
          place, fmt::format("bolt or prop named twice (\"{}\", first at {}), each needs its own name", name,
                             to_string(first->second)));
  };
  for (std::size_t k = 0; k < scene.bolt.size(); ++k) check(scene.bolt[k].name, fmt::format("bolt.{}", k));
  for (std::size_t k = 0; k < scene.prop.size(); ++k) check(scene.prop[k].name, fmt::format("prop.{}", k));
}

void warn_of_idle_support_keys(const Scene& scene, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < scene.bolt.size(); ++k) {
    if (!scene.bolt[k].shear_strength || scene.bolt[k].shear_stiffness > 0.0) continue;
    diagnostics.warning(scene.places.key(fmt::format("bolt.{}.shear_strength", k)),
                        fmt::format("shear_strength has no effect ({} N): shear_stiffness is 0",
                                    *scene.bolt[k].shear_strength));
  }
}

void check_analysis(const Scene& scene, Diagnostics& diagnostics) {
  const SceneAnalysis& analysis = scene.analysis;
  if (analysis.type == SceneAnalysis::Type::thrust && !analysis.movement.supports.empty())
    diagnostics.error(
        scene.places.value("analysis.movement.supports"),
        fmt::format("movements of supports with bolts or props ({} named), leave out movement or them",
                    analysis.movement.supports.size()));
  if (analysis.type == SceneAnalysis::Type::pushover)
    diagnostics.error(
        scene.places.value("analysis.type"),
        fmt::format("a pushover with bolts or props ({}), which do not follow it: leave them out",
                    scene.bolt.size() + scene.prop.size()));
}

/// True if the analysis is one of plastic limits by the scene's own choice.
bool asks_for_limits(const SceneAnalysis& analysis) {
  const bool factor =
      analysis.type == SceneAnalysis::Type::safety || analysis.type == SceneAnalysis::Type::capacity;
  return analysis.type == SceneAnalysis::Type::thrust ||
         (factor && analysis.method == SceneAnalysis::Method::limit);
}

/// Warns of properties that the plastic limit of a bolt does not have (bolt_strength.hpp).
void warn_of_limits(const Scene& scene, const SupportLine& line, Diagnostics& diagnostics) {
  const auto warn = [&](const char* key, const std::string& what) {
    diagnostics.warning(scene.places.key(line.path + (*key != '\0' ? "." : "") + key),
                        fmt::format("\"{}\" in limit analysis: {}", line.name, what));
  };
  const BoltLaw& law = line.law;
  if (is_brittle(law)) {
    warn("rupture_strain",
         fmt::format("it has no force, as it breaks before it yields (rupture_strain {}); analysis.method = "
                     "\"elastic\" counts it",
                     law.rupture_strain));
    return;
  }
  if (law.rupture_strain != BoltLaw::unlimited)
    warn("rupture_strain",
         fmt::format("its full strength counts at any deformation, it breaks at {:.3g} times the "
                     "strain of yielding",
                     ductility(law)));
  if (is_unlimited(law))
    warn("", "its force has no limit, see yield_force, bond_strength and shear_strength");
  if (!(law.pretension > 0.0)) return;
  const bool thrust = scene.analysis.type == SceneAnalysis::Type::thrust;
  warn("pretension",
       fmt::format("pretension ({} N) {}", law.pretension,
                   thrust ? "does not count, its strength does"
                          : "counts along the path from rest, not in the value \"if joints do not wedge\""));
}

/// Reports removals that match no bolt or prop installed before.
void check_removals(const Scene& whole, const std::vector<SupportLine>& lines, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  names.reserve(lines.size());
  for (const SupportLine& line : lines) names.push_back(line.name);
  for (std::size_t s = 0; s < whole.stage.size(); ++s) {
    for (const std::string& pattern : whole.stage[s].remove_support) {
      if (std::any_of(names.begin(), names.end(),
                      [&](const std::string& name) { return pattern_matches(pattern, name); }))
        continue;
      diagnostics.error(
          whole.places.value(fmt::format("stage.{}.remove_support", s)),
          fmt::format(
              "stage removes no bolt or prop (\"{}\"), {}the name of a [[bolt]] or [[prop]] or a glob that "
              "matches one is needed",
              pattern, guess(pattern, names, "\"")));
    }
  }
}

void check_measures(const Scene& scene, const std::vector<SupportLine>& lines, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  names.reserve(lines.size());
  for (const SupportLine& line : lines) names.push_back(line.name);
  for (std::size_t k = 0; k < scene.measure.size(); ++k) {
    const std::string& name = scene.measure[k].bolt;
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) continue;
    diagnostics.error(scene.places.value(fmt::format("measure.{}.bolt", k)),
                      fmt::format("unknown bolt (\"{}\"), {}the name of a [[bolt]] or [[prop]] is needed",
                                  name, guess(name, names, "\"")));
  }
}

}  // namespace

void check_supports(const ExpandedScene& whole, const std::vector<std::optional<Polyhedron>>& solids,
                    Diagnostics& diagnostics) {
  const bool any =
      !whole.bolt.empty() || !whole.prop.empty() ||
      std::any_of(whole.stage.begin(), whole.stage.end(),
                  [](const SceneStage& stage) {
                    return !stage.bolt.empty() || !stage.prop.empty() || !stage.remove_support.empty();
                  }) ||
      std::any_of(whole.measure.begin(), whole.measure.end(),
                  [](const SceneMeasure& measure) { return !measure.bolt.empty(); });
  if (!any) return;
  std::vector<const Polyhedron*> built;
  built.reserve(solids.size());
  for (const std::optional<Polyhedron>& solid : solids) built.push_back(solid ? &*solid : nullptr);
  const Scene scene = scene_of_stage(whole, stage_count(whole) - 1);
  const std::vector<SupportLine> lines = support_lines(scene, built);
  check_measures(scene, lines, diagnostics);
  check_removals(whole, lines, diagnostics);
  if (scene.bolt.empty() && scene.prop.empty()) return;
  check_names(scene, diagnostics);
  check_analysis(scene, diagnostics);
  warn_of_idle_support_keys(scene, diagnostics);
  std::set<std::string> reported;
  for (const SupportLine& line : lines) {
    if (!line.fault.empty()) {
      diagnostics.error(scene.places.key(line.path), line.fault);
      continue;
    }
    const bool single = std::all_of(line.spans.begin(), line.spans.end(), [&](const BoltSpan& span) {
      return span.block == line.spans.front().block;
    });
    const bool is_first = reported.insert(line.path).second;
    if (is_first && asks_for_limits(scene.analysis)) warn_of_limits(scene, line, diagnostics);
    if (single && is_first)
      diagnostics.warning(scene.places.key(line.path),
                          fmt::format("bolt \"{}\" is in one block only (\"{}\"), it ties nothing", line.name,
                                      scene.block[static_cast<std::size_t>(line.spans.front().block)].name));
  }
}

}  // namespace ashlar
