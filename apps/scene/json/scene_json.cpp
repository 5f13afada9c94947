#include "apps/scene/json/scene_json.hpp"

#include "apps/scene/json/analysis_json.hpp"
#include "apps/scene/json/bolt_json.hpp"
#include "apps/scene/json/ground_json.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/read/assignments.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;
using ashlar::to_json;  // beside those below

/// @param law a SceneJointLaw or a SceneJoint
template <class Law>
void add_residuals(Json& json, const Law& law) {
  if (law.friction_angle_residual) json["friction_angle_residual"] = *law.friction_angle_residual;
  if (law.cohesion_residual) json["cohesion_residual"] = *law.cohesion_residual;
  if (law.tensile_strength_residual) json["tensile_strength_residual"] = *law.tensile_strength_residual;
}

Json to_json(const FractureEnergy& energy) {
  Json json = Json::object();
  if (energy.tension > 0.0) json["tension"] = energy.tension;
  if (energy.shear > 0.0) json["shear"] = energy.shear;
  return json;
}

/// @param law a SceneJointLaw or a SceneJoint
template <class Law>
void add_impact_and_fracture(Json& json, const Law& law) {
  if (law.restitution) {
    if (*law.restitution)
      json["restitution"] = **law.restitution;
    else
      json["restitution"] = "springs";
  }
  if (law.fracture_energy) json["fracture_energy"] = to_json(*law.fracture_energy);
}

Json to_json(const SceneContact& contact, bool augmented) {
  Json json = {{"springs", name_of(springs_names, contact.springs)},
               {"surface", name_of(surface_names, contact.surface)},
               {"normal_stiffness", or_auto(contact.law.normal_stiffness)},
               {"shear_stiffness", or_auto(contact.law.shear_stiffness)},
               {"friction_angle", contact.law.friction_angle},
               {"cohesion", contact.law.cohesion},
               {"tensile_strength", contact.law.tensile_strength},
               {"distance", or_auto(contact.distance)},
               {"angle", or_auto(contact.angle)}};
  if (contact.law.compressive_strength) json["compressive_strength"] = *contact.law.compressive_strength;
  add_residuals(json, contact.law);
  json["dilation_angle"] = contact.law.dilation_angle;
  json["damping"] = contact.law.damping;
  add_impact_and_fracture(json, contact.law);
  if (contact.subdivisions)
    json["subdivisions"] = *contact.subdivisions;
  else
    json["chord_tolerance"] = or_auto(contact.chord_tolerance);
  json["augmented"] = augmented;
  json["penetration_tolerance"] = or_auto(contact.penetration_tolerance);
  json["allowed_depth"] = or_auto(contact.allowed_depth);
  json["allowed_overlap"] = contact.allowed_overlap;
  return json;
}

Json to_json(const SceneRegion& region);

Json to_json(const SceneJoint& joint) {
  Json json = {{"blocks", joint.blocks}};
  if (joint.inside) json["inside"] = to_json(*joint.inside);
  if (!joint.cut.empty()) json["cut"] = joint.cut;
  if (joint.normal_stiffness) json["normal_stiffness"] = or_auto(*joint.normal_stiffness);
  if (joint.shear_stiffness) json["shear_stiffness"] = or_auto(*joint.shear_stiffness);
  if (joint.friction_angle) json["friction_angle"] = *joint.friction_angle;
  if (joint.cohesion) json["cohesion"] = *joint.cohesion;
  if (joint.tensile_strength) json["tensile_strength"] = *joint.tensile_strength;
  if (joint.compressive_strength) json["compressive_strength"] = *joint.compressive_strength;
  add_residuals(json, joint);
  if (joint.dilation_angle) json["dilation_angle"] = *joint.dilation_angle;
  if (joint.damping) json["damping"] = *joint.damping;
  add_impact_and_fracture(json, joint);
  if (joint.tied) json["tied"] = *joint.tied;
  if (joint.tie) json["tied"] = {{"tension", joint.tie->tension}, {"shear", joint.tie->shear}};
  return json;
}

Json to_json(const SceneMaterial& material) {
  return {{"name", material.name},
          {"density", material.density},
          {"young_modulus", material.young_modulus},
          {"poisson_ratio", material.poisson_ratio},
          {"elasticity", name_of(elasticity_names, material.elasticity)}};
}

struct ShapeToJson {
  Json& json;

  void operator()(std::monostate) const {}
  void operator()(const SceneBox& box) const {
    json["box"] = {{"min", to_json(box.min)}, {"max", to_json(box.max)}};
  }
  void operator()(const SceneMesh& mesh) const {
    Json keys = {{"file", mesh.file.string()},
                 {"scale", mesh.scale},
                 {"split", name_of(split_names, mesh.split)},
                 {"weld", mesh.weld}};
    if (mesh.flip == SceneMesh::Flip::automatic)
      keys["flip"] = "auto";
    else
      keys["flip"] = mesh.flip == SceneMesh::Flip::always;
    if (mesh.close_below) keys["close_below"] = *mesh.close_below;
    keys["repair"] = mesh.repair;
    if (!mesh.group.empty()) keys["group"] = mesh.group;
    if (mesh.number > 0) keys["number"] = mesh.number;
    json["mesh"] = std::move(keys);
  }
  void operator()(const SceneHull& hull) const {
    Json points = Json::array();
    for (const Vector3& point : hull.points) points.push_back(to_json(point));
    json["hull"] = {{"points", points}};
  }
  void operator()(const SceneSphere& sphere) const {
    json["sphere"] = {
        {"center", to_json(sphere.center)}, {"radius", sphere.radius}, {"subdivisions", sphere.subdivisions}};
  }
  void operator()(const ScenePiece&) const {}
};

Json to_json(const SceneRegion& region) {
  Json json = Json::object();
  if (const auto* half = std::get_if<SceneHalfspace>(&region.space))
    json["halfspace"] = {{"point", to_json(half->point)}, {"normal", to_json(half->normal)}};
  else
    std::visit(ShapeToJson{json}, std::get<SceneShape>(region.space));
  return json;
}

void add_where(Json& json, const std::variant<ScenePlane, Vector3>& where) {
  if (const Vector3* point = std::get_if<Vector3>(&where)) {
    json["point"] = to_json(*point);
    return;
  }
  const ScenePlane& plane = std::get<ScenePlane>(where);
  json["plane"] = {{"point", to_json(plane.point)}, {"normal", to_json(plane.normal)}};
}

Json to_json(const SceneFix& fix) {
  Json json = Json::object();
  add_where(json, fix.where);
  json["components"] = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (fix.components[axis]) json["components"].push_back(std::string(1, "xyz"[axis]));
  if (fix.record == MotionRecord::smooth_displacement) json["interpolation"] = "cubic";
  if (fix.file) {
    json[history_key(fix)] = to_json(*fix.file);
    return json;
  }
  if (!fix.history.empty()) json[history_key(fix)] = Json::array();
  for (const auto& [time, value] : fix.history)
    json[history_key(fix)].push_back({time, value.x(), value.y(), value.z()});
  return json;
}

Json to_json(const SceneLoad& load) {
  Json json = Json::object();
  add_where(json, load.where);
  json[load.kind == SceneLoad::Kind::traction ? "traction" : "force"] =
      load.field.given() ? to_json(load.field) : to_json(load.vector);
  if (load.file) {
    json["history"] = to_json(*load.file);
    return json;
  }
  if (!load.history.empty()) json["history"] = Json::array();
  for (const SceneLoad::Factor& factor : load.history)
    json["history"].push_back({factor.time, factor.factor});
  return json;
}

Json to_json(const SceneBlock& block);
Json to_json(const SceneCut& cut);
Json to_json(const SceneMeasure& measure);
Json to_json(const SceneMovingLoad& load);
Json to_json(const SceneStage::Fix& entry);
Json to_json(const SceneStage::Load& entry);
Json to_json(const SceneStage& stage);

template <typename Entry>
Json list_to_json(const std::vector<Entry>& entries) {
  Json json = Json::array();
  for (const Entry& entry : entries) json.push_back(to_json(entry));
  return json;
}

Json to_json(const SceneBlock& block) {
  Json json = {{"name", block.name}};
  if (!block.material.empty()) json["material"] = block.material;
  json["order"] = block.automatic_order ? Json("auto") : Json(block.order);
  std::visit(ShapeToJson{json}, block.shape);
  if (block.rotate)
    json["rotate"] = {{"axis", to_json(block.rotate->axis)},
                      {"angle", block.rotate->angle},
                      {"about", to_json(block.rotate->about)}};
  json["translate"] = to_json(block.translate);
  json["velocity"] = to_json(block.velocity);
  json["angular_velocity"] = to_json(block.angular_velocity);
  json["fixed"] = block.fixed;
  if (!block.fix.empty()) json["fix"] = list_to_json(block.fix);
  std::vector<SceneLoad> loads = block.load;
  std::erase_if(loads, [](const SceneLoad& load) { return load.of_path; });
  if (!loads.empty()) json["load"] = list_to_json(loads);
  return json;
}

Json to_json(const SceneBond& bond) {
  Json json = {{"tensile_strength", bond.tensile_strength}, {"cohesion", bond.cohesion}};
  if (bond.friction_angle) json["friction_angle"] = *bond.friction_angle;
  if (bond.fracture_energy) json["fracture_energy"] = to_json(*bond.fracture_energy);
  return json;
}

void add_planes(Json& json, const SceneCut& cut) {
  json["dip"] = cut.dip;
  json["dip_direction"] = cut.dip_direction;
  json["point"] = to_json(cut.point);
  if (cut.spacing)
    json["spacing"] = {{"mean", *cut.spacing},
                       {"deviation", cut.deviation},
                       {"distribution", name_of(spacing_names, cut.law)}};
  json["fisher"] = cut.fisher;
  json["persistence"] = cut.persistence;
  if (cut.radius) json["radius"] = *cut.radius;
  if (cut.number) json["number"] = *cut.number;
}

Json to_json(const SceneCut& cut) {
  Json json = {{"name", cut.name}, {"blocks", cut.blocks}};
  if (cut.inside) json["inside"] = to_json(*cut.inside);
  if (cut.kind == SceneCut::Kind::planes) add_planes(json, cut);
  if (cut.kind == SceneCut::Kind::discs) json["file"] = cut.file.string();
  if (cut.kind == SceneCut::Kind::solid) {
    json["solid"] = Json::object();
    std::visit(ShapeToJson{json["solid"]}, cut.solid);
  }
  if (cut.kind == SceneCut::Kind::voronoi)
    json["voronoi"] = {{"count", cut.count}, {"seed", cut.seed}};
  else
    json["seed"] = cut.seed;
  json["min_volume"] = cut.min_volume;
  json["glued"] = cut.glued;
  if (cut.bonded) json["bonded"] = to_json(*cut.bonded);
  json["most_blocks"] = cut.most_blocks;
  return json;
}

Json to_json(const SceneMovingLoad& load) {
  Json json = {{"blocks", load.blocks}, {"force", to_json(load.force)}};
  if (load.spacing) json["spacing"] = *load.spacing;
  if (load.file) {
    json["path"] = to_json(*load.file);
    return json;
  }
  json["path"] = Json::array();
  for (const auto& [time, place] : load.path) json["path"].push_back({time, place.x(), place.y(), place.z()});
  return json;
}

Json to_json(const SceneCrack& crack) {
  Json json = {{"joints", crack.joints}};
  if (!crack.to.empty()) json["to"] = crack.to;
  return json;
}

Json to_json(const SceneMeasure& measure) {
  Json json = {{"name", measure.name}};
  if (!measure.bolt.empty())
    json["bolt"] = measure.bolt;
  else if (measure.drift)
    json["drift"] = {{"blocks", measure.drift->blocks}, {"heights", measure.drift->heights}};
  else if (measure.crack)
    json["crack"] = to_json(*measure.crack);
  else if (measure.block.empty())
    json["pair"] = measure.pair;
  else
    json["block"] = measure.block;
  if (measure.point) json["point"] = to_json(*measure.point);
  return json;
}

template <typename Entry>
void add_list(Json& json, const char* key, const std::vector<Entry>& entries) {
  if (!entries.empty()) json[key] = list_to_json(entries);
}

Json to_json(const SceneStage::Fix& entry) {
  Json json = {{"blocks", entry.blocks}};
  json.update(to_json(entry.fix));
  return json;
}

Json to_json(const SceneStage::Load& entry) {
  Json json = {{"blocks", entry.blocks}};
  json.update(to_json(entry.load));
  return json;
}

Json to_json(const SceneStage& stage) {
  Json json = {{"name", stage.name}};
  if (!stage.remove.empty()) json["remove"] = stage.remove;
  if (!stage.add.empty()) json["add"] = stage.add;
  add_list(json, "fix", stage.fix);
  add_list(json, "load", stage.load);
  add_list(json, "joint", stage.joint);
  add_list(json, "material", stage.material);
  add_list(json, "water", stage.water);
  add_supports(json, stage.bolt, stage.prop);
  if (!stage.remove_support.empty()) json["remove_support"] = stage.remove_support;
  json["reset_displacement"] = stage.reset_displacement;
  json["analysis"] = to_json(stage.analysis);
  return json;
}

/// Assignments to pieces; those to blocks are included in the blocks.
Json assignments_to_pieces(const Scene& scene) {
  Json list = Json::array();
  const std::vector<std::vector<std::size_t>> pieces = assigned_pieces(scene);
  for (std::size_t index = 0; index < pieces.size(); ++index) {
    if (pieces[index].empty()) continue;
    const SceneAssign& given = scene.assign[index];
    Json json = {{"blocks", Json::array()}};
    for (const std::size_t k : pieces[index]) json["blocks"].push_back(pattern_of(scene.block[k].name));
    if (given.material) json["material"] = *given.material;
    if (given.order) json["order"] = *given.order;
    if (given.automatic_order) json["order"] = "auto";
    if (given.fixed) json["fixed"] = *given.fixed;
    if (given.velocity) json["velocity"] = to_json(*given.velocity);
    if (given.angular_velocity) json["angular_velocity"] = to_json(*given.angular_velocity);
    if (!given.fix.empty()) json["fix"] = list_to_json(given.fix);
    if (!given.load.empty()) json["load"] = list_to_json(given.load);
    list.push_back(std::move(json));
  }
  return list;
}

Json to_json(const SceneOutput& output) {
  Json json = Json::object();
  if (output.every) json["every"] = *output.every;
  if (output.interval) json["interval"] = *output.interval;
  json["history_every"] = output.history_every;
  json["fields"] = Json::array();
  for (const auto& [name, member] : field_names)
    if (output.fields.*member) json["fields"].push_back(name);
  json["curved"] = output.curved;
  json["solid"] = output.solid;
  json["format"] = name_of(frame_format_names, output.format);
  json["precision"] = name_of(precision_names, output.precision);
  return json;
}

}  // namespace

nlohmann::ordered_json blocks_to_json(const std::vector<SceneBlock>& blocks) {
  return list_to_json(blocks);
}

nlohmann::ordered_json to_json(const Scene& scene) {
  if (!scene.origin.isZero(0.0)) {
    Scene as_given = scene;
    move_to_user(as_given);
    as_given.origin.setZero();
    return to_json(as_given);
  }
  Json json = {{"title", scene.title},
               {"analysis", to_json(scene.analysis)},
               {"contact", to_json(scene.contact, has_multipliers(scene))}};
  std::vector<SceneJoint> joints = scene.joint;
  std::erase_if(joints, [](const SceneJoint& joint) { return joint.made_by_cut; });
  if (!joints.empty()) json["joint"] = list_to_json(joints);
  json["material"] = list_to_json(scene.material);
  json["block"] = blocks_to_json(scene.rock ? scene.uncut : scene.block);
  if (!scene.cut.empty()) json["cut"] = list_to_json(scene.cut);
  add_list(json, "load", scene.load);
  if (const Json assignments = assignments_to_pieces(scene); !assignments.empty())
    json["assign"] = assignments;
  add_supports(json, scene.bolt, scene.prop);
  if (!scene.measure.empty()) json["measure"] = list_to_json(scene.measure);
  add_list(json, "water", scene.water);
  if (scene.initial_stress.given()) json["initial_stress"] = to_json(scene.initial_stress);
  add_list(json, "boundary", scene.boundary);
  json["output"] = to_json(scene.output);
  add_list(json, "stage", scene.stage);
  return json;
}

}  // namespace ashlar
