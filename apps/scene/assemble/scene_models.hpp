// Models of the blocks of a scene, each made when it is asked for: supports, loads, water, stress of the ground and quiet
// faces. Nothing is kept of a model, so that a process may look at all blocks of a scene without having them.
#pragma once

#include <memory>
#include <vector>

#include "apps/scene/assemble/quiet_boundaries.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "mechanics/block/block_model.hpp"
#include "solver/ground/water_pressure.hpp"
#include "solver/settings.hpp"

namespace ashlar {

class SceneModels {
 public:
  /// @param loaded must outlive this. @param time settings of steps of the run
  /// @param load_factor > 0, of the loads that a search for a capacity multiplies
  /// @param diagnostics receives faults of water and of boundaries; no model is to be made then
  SceneModels(const LoadedScene& loaded, const SimulationSettings& time, double load_factor,
              Diagnostics& diagnostics);

  /// The model of a block as the run starts, the same each time. @param block index in scene.block
  /// @param library data that the model shares with others
  /// @throws as BlockModel does
  [[nodiscard]] BlockModel model(std::size_t block, BlockPartsLibrary& library) const;

  /// Its definition. @param block index in scene.block
  [[nodiscard]] BlockDefinition definition(std::size_t block) const;
  [[nodiscard]] std::size_t count() const { return loaded_.scene.block.size(); }
  [[nodiscard]] const ExpandedScene& scene() const { return loaded_.scene; }
  /// Does not need the scene any more.
  [[nodiscard]] const std::shared_ptr<const WaterPressure>& water() const { return water_; }

 private:
  const LoadedScene& loaded_;
  double load_factor_;
  std::vector<bool> multiplied_;  ///< (#blocks) loads have the factor
  std::shared_ptr<const WaterPressure> water_;
  QuietBoundaries boundaries_;
};

}  // namespace ashlar
