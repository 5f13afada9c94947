#include "apps/scene/json/scene_json.hpp"

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/read/assignments.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

template <typename Entry>
void add_list(Json& json, const char* key, const keys::Keys<Entry>& keys, const std::vector<Entry>& entries) {
  if (!entries.empty()) json[key] = keys::json_of_list(keys, entries);
}

/// Assignments to pieces; those to blocks are included in the blocks.
std::vector<SceneAssign> assignments_to_pieces(const Scene& scene) {
  std::vector<SceneAssign> list;
  const std::vector<std::vector<std::size_t>> pieces = assigned_pieces(scene);
  for (std::size_t index = 0; index < pieces.size(); ++index) {
    if (pieces[index].empty()) continue;
    list.push_back(scene.assign[index]);
    list.back().blocks.clear();
    for (const std::size_t k : pieces[index]) list.back().blocks.push_back(pattern_of(scene.block[k].name));
  }
  return list;
}

/// `augmented` as it is chosen.
Json json_of_contact(const Scene& scene) {
  SceneContact contact = scene.contact;
  contact.augmented = has_multipliers(scene);
  return keys::contact_keys().json(contact);
}

}  // namespace

nlohmann::ordered_json blocks_to_json(const std::vector<SceneBlock>& blocks) {
  return keys::json_of_list(keys::block_keys(), blocks);
}

nlohmann::ordered_json to_json(const Scene& scene) {
  if (!scene.origin.isZero(0.0)) {
    Scene as_given = scene;
    move_to_user(as_given);
    as_given.origin.setZero();
    return to_json(as_given);
  }
  Json json = {{"title", scene.title},
               {"analysis", keys::analysis_keys().json(scene.analysis)},
               {"contact", json_of_contact(scene)}};
  std::vector<SceneJoint> joints = scene.joint;
  std::erase_if(joints, [](const SceneJoint& joint) { return joint.made_by_cut; });
  add_list(json, "joint", keys::joint_keys(), joints);
  json["material"] = keys::json_of_list(keys::material_keys(), scene.material);
  json["block"] = blocks_to_json(scene.rock ? scene.uncut : scene.block);
  add_list(json, "cut", keys::cut_keys(), scene.cut);
  add_list(json, "load", keys::moving_load_keys(), scene.load);
  add_list(json, "assign", keys::assign_keys(), assignments_to_pieces(scene));
  add_list(json, "bolt", keys::bolt_keys(), scene.bolt);
  add_list(json, "prop", keys::prop_keys(), scene.prop);
  add_list(json, "measure", keys::measure_keys(), scene.measure);
  add_list(json, "water", keys::water_keys(), scene.water);
  if (scene.initial_stress.given())
    json["initial_stress"] = keys::initial_stress_keys().json(scene.initial_stress);
  add_list(json, "boundary", keys::boundary_keys(), scene.boundary);
  add_list(json, "crack", keys::cracking_keys(), scene.crack);
  json["output"] = keys::output_keys().json(scene.output);
  add_list(json, "stage", keys::stage_keys(), scene.stage);
  return json;
}

}  // namespace ashlar
