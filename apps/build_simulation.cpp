#include "apps/build_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <type_traits>

#include "apps/name_pattern.hpp"
#include "solver/automatic.hpp"

namespace ashlar {
namespace {

template <class Where>
BlockPlace place_of(const Where& where) {
  if (const auto* plane = std::get_if<ScenePlane>(&where)) return Plane{plane->point, plane->normal};
  return std::get<Vector3>(where);
}

BlockDefinition define_block(const LoadedScene& loaded, std::size_t index) {
  const Scene& scene = loaded.scene;
  const SceneBlock& block = scene.block[index];
  BlockDefinition definition;
  definition.name = block.name;
  definition.shape = loaded.shapes[index];
  definition.solid = block.translate.isZero(0.0) ? loaded.shapes[index]
                                                 : std::make_shared<const Polyhedron>(loaded.solids[index]);
  definition.order = block.order;
  definition.fixed = block.fixed;
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental) {
    definition.formulation = Formulation::incremental;
    definition.sub_face_levels = scene.contact.subdivisions.value_or(definition.sub_face_levels);
    for (const SceneMeasure& measure : scene.measure) {
      if (measure.block == block.name) definition.followed.push_back(measure.point);
    }
  }
  if (const SceneMaterial* material = find_material(scene, block.material)) {
    definition.material = {material->density, material->young_modulus, material->poisson_ratio,
                           material->elasticity == SceneMaterial::Elasticity::linear
                               ? Elasticity::linear
                               : Elasticity::st_venant_kirchhoff};
  }
  for (const SceneFix& fix : block.fix) {
    SupportHistory history;
    for (const auto& point : fix.displacement_history) {
      history.times.push_back(point.time);
      history.displacements.push_back(point.displacement);
    }
    definition.supports.push_back({place_of(fix.where), fix.components, std::move(history)});
  }
  for (const SceneLoad& load : block.load) {
    History history;
    for (const auto& point : load.history) {
      history.times.push_back(point.time);
      history.values.push_back(point.factor);
    }
    definition.loads.push_back(
        {place_of(load.where), load.kind == SceneLoad::Kind::traction, load.vector, std::move(history)});
  }
  return definition;
}

Integrator integrator_of(SceneAnalysis::Integrator integrator) {
  switch (integrator) {
    case SceneAnalysis::Integrator::dda:
      return Integrator::dda;
    case SceneAnalysis::Integrator::average_acceleration:
      return Integrator::average_acceleration;
    case SceneAnalysis::Integrator::generalized_alpha:
      return Integrator::generalized_alpha;
  }
  return Integrator::dda;
}

SimulationSettings settings_of(const Scene& scene, const std::vector<BlockModel>& blocks, int threads,
                               std::vector<AutomaticChoice>& choices) {
  const AutomaticRatios ratios;
  SimulationSettings settings;
  settings.integrator = integrator_of(scene.analysis.integrator);
  settings.spectral_radius = scene.analysis.spectral_radius;
  settings.mass_damping = scene.analysis.mass_damping;
  settings.time_step = scene.analysis.time_step;
  settings.gravity = scene.analysis.gravity;
  settings.area_springs = scene.contact.springs == SceneContact::Springs::area;
  settings.curved_surface = scene.contact.surface == SceneContact::Surface::curved;
  settings.threads = threads;

  double smallest = std::numeric_limits<double>::infinity();
  for (const BlockModel& block : blocks) smallest = std::min(smallest, block_size(block));
  const auto choose = [&](const auto& given, auto automatic, const char* key, const char* unit) {
    if (given) return static_cast<double>(*given);
    choices.push_back({key, static_cast<double>(automatic), unit});
    return static_cast<double>(automatic);
  };
  settings.contact_distance =
      choose(scene.contact.distance, ratios.distance * smallest, "contact.distance", "m");
  settings.contact_angle =
      choose(scene.contact.angle, ratios.angle_degrees, "contact.angle", "deg") * std::numbers::pi / 180.0;
  const bool curved = std::any_of(blocks.begin(), blocks.end(), [](const BlockModel& block) {
    return !block.fixed() && block.order() >= 2 && block.incremental() == nullptr;
  });
  settings.subdivisions = scene.contact.subdivisions.value_or(0);
  if (curved && !scene.contact.subdivisions) {
    settings.chord_tolerance = choose(scene.contact.chord_tolerance, ratios.chord_tolerance * smallest,
                                      "contact.chord_tolerance", "m");
  }
  return settings;
}

/// Laws of all pairs, computed once.
class JointLaws {
 public:
  JointLaws(const Scene& scene, const std::vector<BlockModel>& blocks, std::vector<AutomaticChoice>& choices)
      : count_(blocks.size()), laws_(count_ * count_) {
    const bool area = scene.contact.springs == SceneContact::Springs::area;
    const AutomaticRatios ratios;
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t a = 0; a < count_; ++a) {
      for (std::size_t b = a + 1; b < count_; ++b) {
        if (blocks[a].fixed() && blocks[b].fixed()) continue;
        const SceneJointLaw scene_law = joint_law_between(scene, blocks[a].name(), blocks[b].name());
        JointLaw& law = laws_[a * count_ + b];
        law.area_springs = area;
        if (scene_law.normal_stiffness) {
          law.normal_stiffness = *scene_law.normal_stiffness;
        } else {
          law.normal_stiffness = automatic_normal_stiffness(blocks[a], blocks[b], area, ratios);
          least = std::min(least, law.normal_stiffness);
          most = std::max(most, law.normal_stiffness);
        }
        law.shear_stiffness =
            scene_law.shear_stiffness.value_or(ratios.shear_to_normal_stiffness * law.normal_stiffness);
        law.friction = std::tan(scene_law.friction_angle * std::numbers::pi / 180.0);
        law.cohesion = scene_law.cohesion;
        law.tensile_strength = scene_law.tensile_strength;
      }
    }
    const char* unit = area ? "Pa/m" : "N/m";
    if (most > 0.0) {
      choices.push_back({"contact.normal_stiffness (softest pair)", least, unit});
      if (most > least) choices.push_back({"contact.normal_stiffness (stiffest pair)", most, unit});
    }
  }
  JointLaw operator()(int a, int b) const {
    return laws_[static_cast<std::size_t>(a) * count_ + static_cast<std::size_t>(b)];
  }

 private:
  std::size_t count_;
  std::vector<JointLaw> laws_;
};

/// Ties every pair of blocks whose joint is tied; a [[joint]] that ties nothing is an error at its key.
void tie_joints(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics) {
  const AutomaticRatios ratios;
  const std::vector<BlockModel>& blocks = simulation.blocks();
  std::vector<bool> ties(scene.joint.size(), false);
  for (std::size_t a = 0; a < blocks.size(); ++a) {
    for (std::size_t b = a + 1; b < blocks.size(); ++b) {
      if (blocks[a].fixed() && blocks[b].fixed()) continue;
      if (!joint_law_between(scene, blocks[a].name(), blocks[b].name()).tied) continue;
      if (!simulation.tie_blocks(static_cast<int>(a), static_cast<int>(b),
                                 automatic_tie_stiffness(blocks[a], blocks[b], ratios)))
        continue;
      for (std::size_t k = 0; k < scene.joint.size(); ++k) {
        if (pattern_matches_pair(scene.joint[k].blocks, blocks[a].name(), blocks[b].name())) ties[k] = true;
      }
    }
  }
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    const SceneJoint& joint = scene.joint[k];
    if (!joint.tied.value_or(false) || ties[k]) continue;
    diagnostics.error(
        scene.places.key(fmt::format("joint.{}.tied", k)),
        fmt::format("tied blocks without a common face ({}, {}), blocks are tied over faces that "
                    "lie in one plane and overlap",
                    joint.blocks[0], joint.blocks[1]));
  }
}

}  // namespace

std::optional<BuiltSimulation> build_simulation(const LoadedScene& loaded, int threads,
                                                Diagnostics& diagnostics) {
  const Scene& scene = loaded.scene;
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  BlockPartsLibrary parts;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    try {
      blocks.emplace_back(define_block(loaded, k), parts);
    } catch (const std::exception& error) {
      diagnostics.error(scene.places.key(fmt::format("block.{}", k)),
                        fmt::format("block cannot be modelled ({}): {}", block.name, error.what()));
    }
    motions.push_back({block.velocity, block.angular_velocity});
  }
  if (!diagnostics.empty()) return std::nullopt;
  std::vector<AutomaticChoice> choices;
  const SimulationSettings settings = settings_of(scene, blocks, threads, choices);
  JointLaws laws(scene, blocks, choices);
  BuiltSimulation built{Simulation(std::move(blocks), std::move(motions), std::move(laws), settings),
                        std::move(choices), parts.size()};
  try {
    tie_joints(scene, built.simulation, diagnostics);
  } catch (const std::invalid_argument& error) {
    diagnostics.error(scene.places.key("analysis.formulation"), error.what());
  }
  if (!diagnostics.empty()) return std::nullopt;
  if (scene.analysis.initial_state == SceneAnalysis::InitialState::equilibrium) {
    built.simulation.settle_supported_blocks();
  }
  return built;
}

}  // namespace ashlar
