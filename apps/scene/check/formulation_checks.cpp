#include "apps/scene/check/formulation_checks.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "apps/scene/model/scene_names.hpp"

namespace ashlar {
namespace {

class IncrementalFaults {
 public:
  IncrementalFaults(const Scene& scene, Diagnostics& diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  void check_analysis() {
    const SceneAnalysis& analysis = scene_.analysis;
    if (is_static(analysis))
      refuse("analysis.type", fmt::format("static analysis of incremental blocks (type = \"{}\")",
                                          name_of(analysis_type_names, analysis.type)));
    if (analysis.initial_state == SceneAnalysis::InitialState::statics)
      refuse("analysis.initial_state", "static analysis of incremental blocks (initial_state = \"static\")");
    if (analysis.accuracy)
      refuse("analysis.accuracy", fmt::format("accuracy of incremental blocks ({})", *analysis.accuracy));
  }

  void check_output() {
    if (scene_.output.curved)
      refuse("output.curved", "the surface of an incremental block is its flat sub-faces (true)");
    if (scene_.output.solid)
      refuse("output.solid", "points inside an incremental block are not tracked (true)");
    for (std::size_t i = 0; i < scene_.measure.size(); ++i) {
      const SceneMeasure& measure = scene_.measure[i];
      if (!measure.block.empty() && !measure.point)
        refuse(
            fmt::format("measure.{}.block", i),
            fmt::format("an incremental block is measured at points only (\"{}\" has none)", measure.name));
      if (measure.drift || measure.crack)
        refuse(fmt::format("measure.{}.{}", i, measure.drift ? "drift" : "crack"),
               fmt::format("measure of {} of incremental blocks (\"{}\")",
                           measure.drift ? "the drift" : "cracks", measure.name));
    }
  }

  void check_blocks() {
    for (std::size_t i = 0; i < scene_.block.size(); ++i)
      if (scene_.block[i].order == 0 && !scene_.block[i].fixed)
        refuse(
            fmt::format("block.{}.order", i),
            fmt::format("a block of order 0 has no incremental formulation (\"{}\")", scene_.block[i].name));
    for (std::size_t i = 0; i < scene_.material.size(); ++i)
      if (scene_.material[i].elasticity == SceneMaterial::Elasticity::st_venant_kirchhoff)
        refuse(fmt::format("material.{}.elasticity", i),
               "an incremental block accumulates linear stress (\"st-venant-kirchhoff\")");
  }

  void check_contact() {
    const SceneContact& contact = scene_.contact;
    if (contact.chord_tolerance)
      refuse("contact.chord_tolerance",
             fmt::format("the sub-faces of an incremental block are fixed, see contact.subdivisions ({})",
                         *contact.chord_tolerance));
    if (contact.allowed_overlap > 0.0)
      refuse("contact.allowed_overlap",
             fmt::format(
                 "allowed_overlap of incremental blocks, which do not keep where they were placed ({} m)",
                 contact.allowed_overlap));
    check_restitution("contact.restitution", contact.law.restitution);
    for (std::size_t i = 0; i < scene_.joint.size(); ++i)
      check_restitution(fmt::format("joint.{}.restitution", i), scene_.joint[i].restitution);
  }

  void check_tables() {
    refuse_any(scene_.bolt.size(), "bolt.0", "bolts");
    refuse_any(scene_.prop.size(), "prop.0", "props");
    refuse_any(scene_.water.size(), "water.0", "water");
    refuse_any(scene_.boundary.size(), "boundary.0", "a boundary");
    refuse_any(scene_.initial_stress.given() ? 1 : 0, "initial_stress", "initial stress");
  }

 private:
  void refuse(const std::string& key, const std::string& what) {
    diagnostics_.error(scene_.places.value(key), with_remedy(what));
  }

  /// Reports a table, or the first one of a list. @param count of them
  void refuse_any(std::size_t count, const std::string& path, const char* what) {
    if (count == 0) return;
    diagnostics_.error(scene_.places.key(path),
                       with_remedy(fmt::format("{} of incremental blocks (formulation = \"{}\")", what,
                                               formulation_name(scene_.analysis))));
  }

  /// @param restitution inner optional empty: as "springs" rebound
  void check_restitution(const std::string& key, const std::optional<std::optional<double>>& restitution) {
    if (const std::optional<double> share = restitution.value_or(std::nullopt))
      refuse(key, fmt::format("restitution of incremental blocks ({})", *share));
  }

  static std::string with_remedy(const std::string& what) {
    return what + ", leave it out or choose analysis.formulation = \"total\"";
  }

  const Scene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_formulation(const Scene& scene, Diagnostics& diagnostics) {
  if (scene.analysis.formulation != SceneAnalysis::Formulation::incremental) return;
  IncrementalFaults faults(scene, diagnostics);
  faults.check_analysis();
  faults.check_output();
  faults.check_blocks();
  faults.check_contact();
  faults.check_tables();
}

}  // namespace ashlar
