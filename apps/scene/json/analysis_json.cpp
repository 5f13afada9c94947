#include "apps/scene/json/analysis_json.hpp"

#include "apps/scene/model/scene_names.hpp"

namespace ashlar {

using Json = nlohmann::ordered_json;

Json to_json(const Vector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json to_json(const SceneRecord& record) {
  Json json = {{"file", record.file.string()}};
  if (!record.time.empty()) json["time"] = record.time;
  json["values"] = record.values;
  json["scale"] = record.scale;
  if (record.baseline) json["baseline"] = *record.baseline;
  if (record.resample) json["resample"] = *record.resample;
  json["sha256"] = record.sha256;
  return json;
}

namespace {

using ashlar::to_json;  // beside those below

void add_gravity(Json& json, const SceneAnalysis& analysis) {
  if (analysis.gravity_history.empty()) {
    json["gravity"] = to_json(analysis.gravity);
  } else if (analysis.gravity_file) {
    json["gravity_history"] = to_json(*analysis.gravity_file);
  } else {
    json["gravity_history"] = Json::array();
    for (const auto& [time, value] : analysis.gravity_history)
      json["gravity_history"].push_back({time, value.x(), value.y(), value.z()});
  }
}

Json to_json(const SceneAnalysis::FactorSearch& search, const char* of) {
  return {{of, search.of}, {"tolerance", search.tolerance}, {"lower", search.lower}, {"upper", search.upper}};
}

Json to_json(const SceneAnalysis::SupportSearch& search) {
  Json json = {{"supports", search.supports}};
  if (search.direction) json["direction"] = to_json(*search.direction);
  json["limit"] = or_auto(search.limit);
  json["tolerance"] = or_auto(search.tolerance);
  return json;
}

template <class Value>
void add_given(Json& json, const char* key, const std::optional<Value>& value) {
  if (value) json[key] = *value;
}

Json to_json(const ScenePushover& pushover) {
  Json json = Json::object();
  if (pushover.direction) json["direction"] = to_json(*pushover.direction);
  add_given(json, "directions", pushover.directions);
  if (!pushover.control.empty()) json["control"] = pushover.control;
  json["limit"] = or_auto(pushover.limit);
  if (!pushover.blocks.empty()) json["blocks"] = pushover.blocks;
  add_given(json, "confidence_factor", pushover.confidence_factor);
  add_given(json, "behaviour_factor", pushover.behaviour_factor);
  add_given(json, "height", pushover.height);
  add_given(json, "building_height", pushover.building_height);
  add_given(json, "storeys", pushover.storeys);
  add_given(json, "period", pushover.period);
  return json;
}

Json to_json(const SceneSpectrum& spectrum) {
  Json json = Json::object();
  switch (spectrum.source) {
    case SceneSpectrum::Source::none:
      return json;
    case SceneSpectrum::Source::points:
      if (!spectrum.file.empty())
        return {{"file", spectrum.file.string()}, {"scale", spectrum.scale}, {"sha256", spectrum.sha256}};
      json["points"] = Json::array();
      for (const auto& [period, acceleration] : spectrum.points)
        json["points"].push_back({period, acceleration});
      return json;
    case SceneSpectrum::Source::ec8:
    case SceneSpectrum::Source::ntc2018:
      break;
  }
  json = {{"code", name_of(spectrum_code_names, spectrum.source)},
          {"ag", spectrum.ground_acceleration},
          {"soil", name_of(soil_names, spectrum.soil)}};
  if (spectrum.source == SceneSpectrum::Source::ec8) {
    json["type"] = spectrum.type;
  } else {
    json["f0"] = spectrum.amplification;
    json["tc_star"] = spectrum.corner_period;
    json["topography"] = spectrum.topography;
  }
  add_given(json, "damping", spectrum.damping);
  return json;
}

}  // namespace

Json to_json(const SceneAnalysis& analysis) {
  Json json = {{"type", name_of(analysis_type_names, analysis.type)},
               {"end_time", analysis.end_time},
               {"time_step", analysis.automatic_step ? Json("auto") : Json(analysis.time_step)},
               {"integrator", name_of(integrator_names, analysis.integrator)},
               {"spectral_radius", analysis.spectral_radius},
               {"formulation", formulation_name(analysis)},
               {"initial_state", name_of(initial_state_names, analysis.initial_state)}};
  if (analysis.accuracy) json["accuracy"] = *analysis.accuracy;
  if (analysis.allowed_displacement) json["allowed_displacement"] = *analysis.allowed_displacement;
  add_gravity(json, analysis);
  json["solver"] = name_of(solver_names, analysis.solver);
  json["mass_damping"] = analysis.mass_damping;
  json["stiffness_damping"] = analysis.stiffness_damping;
  json["method"] = name_of(method_names, analysis.method);
  json["safety"] = to_json(analysis.safety, "joints");
  json["capacity"] = to_json(analysis.capacity, "blocks");
  json["movement"] = to_json(analysis.movement);
  if (analysis.type == SceneAnalysis::Type::pushover) {
    json["pushover"] = to_json(analysis.pushover);
    if (analysis.spectrum.source != SceneSpectrum::Source::none)
      json["spectrum"] = to_json(analysis.spectrum);
  }
  json["sleeping"] = analysis.sleeping;
  json["memory_limit"] = or_auto(analysis.memory_limit);
  return json;
}

}  // namespace ashlar
