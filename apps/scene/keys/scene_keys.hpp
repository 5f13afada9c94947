// The tables of a scene whose keys are declared, each in a source of its own.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/keys/table_keys.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar::keys {

[[nodiscard]] const Keys<ScenePlane>& plane_keys();
[[nodiscard]] const Keys<SceneMaterial>& material_keys();
[[nodiscard]] const Keys<SceneBolt>& bolt_keys();
[[nodiscard]] const Keys<SceneProp>& prop_keys();
[[nodiscard]] const Keys<SceneWater>& water_keys();
[[nodiscard]] const Keys<SceneInitialStress>& initial_stress_keys();
[[nodiscard]] const Keys<SceneBoundary>& boundary_keys();
[[nodiscard]] const Keys<SceneMovingLoad>& moving_load_keys();
[[nodiscard]] const Keys<SceneMeasure>& measure_keys();
[[nodiscard]] const Keys<SceneBlock>& block_keys();
/// The part of it that says where the block is.
[[nodiscard]] const Keys<SceneBlock>& block_place_keys();
[[nodiscard]] const Keys<SceneAssign>& assign_keys();
[[nodiscard]] const Keys<SceneOutput>& output_keys();
[[nodiscard]] const Keys<SceneAnalysis>& analysis_keys();
[[nodiscard]] const Keys<SceneContact>& contact_keys();
[[nodiscard]] const Keys<SceneJoint>& joint_keys();
[[nodiscard]] const Keys<FractureEnergy>& fracture_energy_keys();
/// Both energies are needed.
[[nodiscard]] const Keys<FractureEnergy>& both_energies_keys();
/// Reads { tension, shear }, or a number for both.
[[nodiscard]] bool read_both_energies(TomlTableReader& table, const std::string& key, FractureEnergy& energy);
[[nodiscard]] const Keys<SceneCut>& cut_keys();
[[nodiscard]] const Keys<SceneCracking>& cracking_keys();
[[nodiscard]] const Keys<SceneStage>& stage_keys();

/// The keys of a scene outside of tables.
[[nodiscard]] const Keys<Scene>& top_keys();

struct SceneTable {
  std::string heading;  ///< "block.fix"; "": the top of the file
  const TableKeys& keys;
  bool list;  ///< a list of tables, [[block]]
};
/// All tables, in the order of the reference.
[[nodiscard]] const std::vector<SceneTable>& all_tables();

/// A list of tables as JSON.
template <class Struct>
[[nodiscard]] Json json_of_list(const Keys<Struct>& keys, const std::vector<Struct>& entries) {
  Json list = Json::array();
  for (const Struct& entry : entries) list.push_back(keys.json(entry));
  return list;
}

}  // namespace ashlar::keys
