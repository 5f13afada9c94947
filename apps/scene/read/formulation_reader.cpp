#include "apps/scene/read/formulation_reader.hpp"

#include <fmt/format.h>

#include <string>

#include "apps/scene/model/scene_names.hpp"

namespace ashlar {

void imply_contact(Scene& scene, Diagnostics& diagnostics) {
  const auto imply = [&](const std::string& key, auto& value, auto implied, const auto& names) {
    const std::string path = "contact." + key;
    if (value != implied && scene.places.contains(path))
      diagnostics.error(
          scene.places.value(path),
          fmt::format("{} is not that of formulation = \"{}\" (\"{}\"), \"{}\" or no {} is needed", key,
                      formulation_name(scene.analysis), name_of(names, value), name_of(names, implied), key));
    value = implied;
  };
  if (scene.analysis.formulation != SceneAnalysis::Formulation::incremental) return;
  imply("surface", scene.contact.surface, SceneContact::Surface::flat, surface_names);
  if (scene.analysis.paper)
    imply("springs", scene.contact.springs, SceneContact::Springs::point, springs_names);
}

}  // namespace ashlar
