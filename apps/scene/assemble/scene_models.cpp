#include "apps/scene/assemble/scene_models.hpp"

#include <memory>
#include <utility>
#include <variant>

#include "apps/scene/assemble/block_material.hpp"
#include "apps/scene/assemble/limit_choices.hpp"
#include "apps/scene/assemble/stress_field.hpp"
#include "apps/scene/assemble/water_loads.hpp"
#include "apps/scene/model/support_history.hpp"
#include "apps/scene/toml/formulas.hpp"

namespace ashlar {
namespace {

template <class Where>
BlockPlace place_of(const Where& where) {
  if (const auto* plane = std::get_if<ScenePlane>(&where)) return Plane{plane->point, plane->normal};
  return std::get<Vector3>(where);
}

/// @param factor of the load
Load load_of(const SceneLoad& load, double factor) {
  History history;
  for (const auto& point : load.history) {
    history.times.push_back(point.time);
    history.values.push_back(point.factor);
  }
  Load result{place_of(load.where), load.kind == SceneLoad::Kind::traction, factor * load.vector,
              std::move(history)};
  if (load.field.given())
    result.field = [factor, at = load.field.at](const Vector3& place) {
      const std::vector<double> value = at(place);
      return Vector3(factor * Vector3(value[0], value[1], value[2]));
    };
  return result;
}

}  // namespace

SceneModels::SceneModels(const LoadedScene& loaded, const SimulationSettings& time, double load_factor,
                         Diagnostics& diagnostics)
    : loaded_(loaded),
      load_factor_(load_factor),
      multiplied_(multiplied_blocks(loaded.scene)),
      water_(std::make_shared<const WaterPressure>(water_pressure_of(loaded, diagnostics))),
      boundaries_(loaded.scene, loaded.solids, time, diagnostics) {}

BlockModel SceneModels::model(std::size_t block, BlockPartsLibrary& library) const {
  return {definition(block), library};
}

BlockDefinition SceneModels::definition(std::size_t index) const {
  const Scene& scene = loaded_.scene;
  const SceneBlock& block = scene.block[index];
  BlockDefinition definition;
  definition.name = block.name;
  definition.shape = loaded_.shapes[index];
  definition.solid = block.translate.isZero(0.0) ? loaded_.shapes[index]
                                                 : std::make_shared<const Polyhedron>(loaded_.solids[index]);
  definition.order = block.order;
  definition.fixed = block.fixed;
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental) {
    definition.formulation = Formulation::incremental;
    definition.sub_face_levels = scene.contact.subdivisions.value_or(definition.sub_face_levels);
    for (const SceneMeasure& measure : scene.measure) {
      if (measure.block == block.name && measure.point) definition.followed.push_back(*measure.point);
    }
  }
  definition.material = material_of(scene, index);
  for (const SceneFix& fix : block.fix) {
    definition.supports.push_back({place_of(fix.where), fix.components, support_history(fix)});
  }
  for (const SceneLoad& load : block.load)
    definition.loads.push_back(load_of(load, multiplied_[index] ? load_factor_ : 1.0));
  if (!block.fixed) definition.initial_stress = initial_stress_of(scene, index, loaded_.stage);
  definition.quiet = boundaries_.of_block(scene, loaded_.solids[index], index);
  // After those of the scene, whose numbers stay.
  if (Load pressure = water_->of_block(index); !pressure.parts.empty())
    definition.loads.push_back(std::move(pressure));
  return definition;
}

}  // namespace ashlar
