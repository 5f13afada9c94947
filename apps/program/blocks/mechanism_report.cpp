#include "apps/program/blocks/mechanism_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/results/text/csv_text.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/json/value_json.hpp"
#include "apps/scene/model/preparation.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

double volume_of(const BlockReport& report, const KeyGroup& group) {
  double volume = 0.0;
  for (const int block : group.blocks) volume += report.blocks()[at(block)].volume;
  return volume;
}

/// m, centroid of the largest block.
Vector3 place_of(const BlockReport& report, const KeyGroup& group) {
  const int largest = *std::max_element(group.blocks.begin(), group.blocks.end(), [&](int a, int b) {
    return report.blocks()[at(a)].volume < report.blocks()[at(b)].volume;
  });
  return report.loaded().scene.origin + centroid_of(report.loaded().solids[at(largest)]);
}

std::string names_of(const Scene& scene, const KeyGroup& group) {
  std::string names;
  for (const int block : group.blocks) names += (names.empty() ? "" : " ") + scene.block[at(block)].name;
  return names;
}

}  // namespace

std::vector<KeyGroup> find_mechanisms(const LoadedScene& loaded, const RemovableSearch& search, int most,
                                      Preparation& progress) {
  LoadedScene turned = loaded;
  SceneAnalysis& analysis = turned.scene.analysis;
  if (analysis.gravity.norm() > 0.0) analysis.gravity = analysis.gravity.norm() * search.force.normalized();
  const BuiltSimulation built = built_or_thrown(turned, 1);
  RigidModel model = built.simulation.rigid_model(analysis.end_time);
  keep_residual_strength(model);
  const JointSelection joints(turned.scene, analysis.safety.of);
  const std::vector<bool> reduced = reduced_points(model, [&](int a, int b) {
    return joints.contains(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  });
  KeyGroupSearch wanted;
  wanted.factors = {analysis.safety.lower, analysis.safety.upper, analysis.safety.tolerance};
  wanted.wanted = search.wanted;
  wanted.most = most;
  wanted.may_continue = [&progress, analyses = 0]() mutable {
    progress.phase(fmt::format("mechanisms, limit analysis {}", ++analyses));
    return true;
  };
  return key_groups(model, reduced, wanted);
}

std::string mechanisms_text(const BlockReport& report, const std::vector<KeyGroup>& groups) {
  const Scene& scene = report.loaded().scene;
  std::string text = fmt::format(
      "{} mechanisms by limit analysis up to a factor of {:.4g} (analysis.safety.upper), each with those "
      "before it held\n",
      groups.size(), scene.analysis.safety.upper);
  if (!groups.empty())
    text += "volume, m^3   factor               force, kN   centroid, m                blocks\n";
  for (const KeyGroup& group : groups) {
    const Vector3 at = place_of(report, group);
    const std::string factor = group.lower ? fmt::format("{:.4g} to {:.4g}", *group.lower, group.upper)
                                           : fmt::format("below {:.4g}", group.upper);
    text +=
        fmt::format("{:>11.4g}   {:<18} {:>11.4g}   {:<24}   {}: {}\n", volume_of(report, group), factor,
                    1e-3 * group.needed.norm(), fmt::format("{:.4g}, {:.4g}, {:.4g}", at.x(), at.y(), at.z()),
                    names_of(scene, group), group.motion.mode);
  }
  return text;
}

std::string mechanisms_csv(const BlockReport& report, const std::vector<KeyGroup>& groups) {
  std::string text = "blocks,volume,x,y,z,factor_lower,factor_upper,force_x,force_y,force_z,mode\n";
  for (const KeyGroup& group : groups) {
    text += quote_csv_field(names_of(report.loaded().scene, group));
    const auto add = [&text](double value) {
      text += ',';
      append_csv_number(text, value);
    };
    add(volume_of(report, group));
    const Vector3 at = place_of(report, group);
    for (const double value : {at.x(), at.y(), at.z()}) add(value);
    group.lower ? add(*group.lower) : text.push_back(',');
    add(group.upper);
    for (const double value : group.needed) add(value);
    text += ',' + quote_csv_field(group.motion.mode) + '\n';
  }
  return text;
}

Json mechanisms_json(const BlockReport& report, const std::vector<KeyGroup>& groups) {
  Json json = Json::array();
  for (const KeyGroup& group : groups) {
    Json names = Json::array();
    for (const int block : group.blocks) names.push_back(report.loaded().scene.block[at(block)].name);
    json.push_back({{"blocks", names},
                    {"volume", volume_of(report, group)},
                    {"place", to_json(place_of(report, group))},
                    {"lower", group.lower ? Json(*group.lower) : Json(nullptr)},
                    {"upper", group.upper},
                    {"needed_force", to_json(group.needed)},
                    {"mode", group.motion.mode}});
  }
  return json;
}

}  // namespace ashlar
