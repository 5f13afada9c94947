#include "apps/scene/check/accuracy_checks.hpp"

#include <fmt/format.h>

#include <set>

#include "apps/scene/model/scene_names.hpp"

namespace ashlar {
namespace {

void check_orders(const Scene& scene, Diagnostics& diagnostics) {
  std::set<std::string> told;  // an entry may be that of many blocks
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const std::string key = fmt::format("block.{}.order", k);
    if (!scene.block[k].automatic_order || !told.insert(to_string(scene.places.value(key))).second) continue;
    diagnostics.error(scene.places.value(key),
                      "order = \"auto\" without analysis.accuracy, a number from 0 to 12, or an accuracy, is "
                      "needed");
  }
}

}  // namespace

void check_accuracy(const Scene& scene, Diagnostics& diagnostics) {
  const SceneAnalysis& analysis = scene.analysis;
  if (!analysis.accuracy) {
    check_orders(scene, diagnostics);
    if (analysis.automatic_step)
      diagnostics.error(
          scene.places.value("analysis.time_step"),
          "time_step = \"auto\" without analysis.accuracy, a number > 0, or an accuracy, is needed");
    return;
  }
  const auto refuse = [&](const std::string& message) {
    diagnostics.error(scene.places.value("analysis.accuracy"), message);
  };
  if (analysis.type != SceneAnalysis::Type::dynamic && analysis.type != SceneAnalysis::Type::statics)
    refuse(
        fmt::format("accuracy of a search (type = \"{}\"), only \"static\" and \"dynamic\" have one: its "
                    "tolerance is a key of the search",
                    name_of(analysis_type_names, analysis.type)));
  if (!scene.stage.empty())
    refuse(
        fmt::format("accuracy of an analysis with stages ({}), one without stages is needed: choose `order` "
                    "and `time_step`",
                    scene.stage.size()));
  if (analysis.automatic_step && !scene.boundary.empty())
    diagnostics.error(
        scene.places.value("boundary.0"),
        "boundary beside an automatic time_step (\"auto\"), a given time_step is needed: the ground "
        "is computed with it beforehand");
}

}  // namespace ashlar
