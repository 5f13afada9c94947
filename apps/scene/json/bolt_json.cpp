#include "apps/scene/json/bolt_json.hpp"

#include "apps/scene/json/analysis_json.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

using ashlar::to_json;  // beside those below

Json to_json(const SceneBolt::Pattern& pattern) {
  Json json = {
      {"plane", {{"point", to_json(pattern.plane.point)}, {"normal", to_json(pattern.plane.normal)}}},
      {"spacing", pattern.spacing},
      {"length", pattern.length}};
  if (pattern.direction) json["direction"] = to_json(*pattern.direction);
  return json;
}

Json to_json(const SceneBolt& bolt) {
  Json json = {{"name", bolt.name}};
  if (bolt.pattern) {
    json["pattern"] = to_json(*bolt.pattern);
  } else {
    json["from"] = to_json(bolt.from);
    json["to"] = to_json(bolt.to);
  }
  json["area"] = bolt.area;
  json["young_modulus"] = bolt.young_modulus;
  if (bolt.yield_force) json["yield_force"] = *bolt.yield_force;
  if (bolt.rupture_strain) json["rupture_strain"] = *bolt.rupture_strain;
  json["anchored"] = name_of(anchorage_names, bolt.anchored);
  if (bolt.anchored == SceneBolt::Anchorage::grouted) {
    json["bond_stiffness"] = bolt.bond_stiffness;
    if (bolt.bond_strength) json["bond_strength"] = *bolt.bond_strength;
    json["shear_stiffness"] = bolt.shear_stiffness;
    if (bolt.shear_strength) json["shear_strength"] = *bolt.shear_strength;
  }
  json["pretension"] = bolt.pretension;
  return json;
}

Json to_json(const SceneProp& prop) {
  Json json = {{"name", prop.name},
               {"from", to_json(prop.from)},
               {"to", to_json(prop.to)},
               {"stiffness", prop.stiffness}};
  if (prop.yield_force) json["yield_force"] = *prop.yield_force;
  json["tension"] = prop.tension;
  return json;
}

}  // namespace

void add_supports(Json& json, const std::vector<SceneBolt>& bolts, const std::vector<SceneProp>& props) {
  for (const SceneBolt& bolt : bolts) json["bolt"].push_back(to_json(bolt));
  for (const SceneProp& prop : props) json["prop"].push_back(to_json(prop));
}

}  // namespace ashlar
