#include "apps/scene/assemble/build_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "apps/scene/assemble/block_survey.hpp"
#include "apps/scene/assemble/bolts_of_scene.hpp"
#include "apps/scene/assemble/chosen_restitution.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/assemble/scene_models.hpp"
#include "apps/scene/assemble/stress_field.hpp"
#include "apps/scene/assemble/tied_joints.hpp"
#include "apps/scene/check/rank_checks.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

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

/// Settings of a step in time.
SimulationSettings time_settings(const SceneAnalysis& analysis) {
  SimulationSettings settings;
  settings.integrator = integrator_of(analysis.integrator);
  settings.spectral_radius = analysis.spectral_radius;
  settings.mass_damping = analysis.mass_damping;
  settings.stiffness_damping = analysis.stiffness_damping;
  settings.time_step = analysis.time_step;
  return settings;
}

SimulationSettings settings_of(const Scene& scene, const std::vector<BlockSummary>& blocks, int threads,
                               std::vector<AutomaticChoice>& choices) {
  const AutomaticRatios ratios;
  SimulationSettings settings = time_settings(scene.analysis);
  if (scene.analysis.solver == SceneAnalysis::Solver::cg)
    settings.linear_method = LinearMethod::conjugate_gradients;
  settings.rest.sleeps = scene.analysis.sleeping;
  settings.gravity = scene.analysis.gravity;
  for (const auto& [time, value] : scene.analysis.gravity_history) {
    settings.gravity_history.times.push_back(time);
    settings.gravity_history.values.push_back(value);
  }
  settings.area_springs = scene.contact.springs == SceneContact::Springs::area;
  settings.curved_surface = scene.contact.surface == SceneContact::Surface::curved;
  settings.threads = threads;

  double smallest = std::numeric_limits<double>::infinity();
  for (const BlockSummary& block : blocks) smallest = std::min(smallest, block.stiffness.size);
  const auto choose = [&](const auto& given, auto automatic, const char* key, const char* unit) {
    if (given) return static_cast<double>(*given);
    choices.push_back({key, static_cast<double>(automatic), unit});
    return static_cast<double>(automatic);
  };
  settings.contact_distance =
      choose(scene.contact.distance, ratios.distance * smallest, "contact.distance", "m");
  settings.search.contact_angle =
      choose(scene.contact.angle, ratios.angle_degrees, "contact.angle", "deg") * std::numbers::pi / 180.0;
  settings.augmented = has_multipliers(scene);
  if (settings.augmented) {
    if (!scene.contact.augmented) choices.push_back({"contact.augmented", true, ""});
    settings.multipliers.penetration_tolerance =
        choose(scene.contact.penetration_tolerance, ratios.penetration_tolerance * settings.contact_distance,
               "contact.penetration_tolerance", "m");
  }
  settings.depth.allowed_depth = scene.contact.allowed_depth.value_or(0.0);
  const bool curved = std::any_of(blocks.begin(), blocks.end(), [](const BlockSummary& block) {
    return !block.fixed() && block.order >= 2 && !block.incremental;
  });
  // Springs at corners alone would miss bending between them.
  settings.search.subdivisions =
      scene.contact.subdivisions.value_or(curved && !settings.area_springs ? 1 : 0);
  if (curved && !scene.contact.subdivisions) {
    settings.search.chord_tolerance = choose(scene.contact.chord_tolerance, ratios.chord_tolerance * smallest,
                                             "contact.chord_tolerance", "m");
  }
  return settings;
}

/// @param worn tan(phi_r)
Roughness roughness_of(const SceneRoughness& given, double worn) {
  Roughness roughness{given.jrc, given.jcs, worn};
  if (given.length) roughness.peak_slip = peak_slip_of(given.jrc, *given.length);
  return roughness;
}

/// The law with its strength divided by a factor.
JointLaw reduced(JointLaw law, double factor) {
  for (double* strength : {&law.friction, &law.cohesion, &law.tensile_strength, &law.compressive_strength,
                           &law.residual->friction, &law.residual->cohesion, &law.residual->tensile_strength})
    *strength /= factor;
  law.roughness.share /= factor;
  // The dilation of a joint is limited by its friction.
  law.dilation = std::min(law.dilation, law.residual->friction);
  return law;
}

/// Laws between blocks.
class JointLaws {
 public:
  JointLaws(const Scene& scene, const std::vector<BlockSummary>& blocks,
            std::shared_ptr<const JointTable> table, double strength_factor,
            std::vector<AutomaticChoice>& choices)
      : area_(scene.contact.springs == SceneContact::Springs::area),
        multipliers_(has_multipliers(scene)),
        asked_for_(scene.contact.augmented.value_or(false)),
        table_(std::move(table)),
        strength_factor_(strength_factor),
        reduced_(scene, scene.analysis.safety.of),
        summaries_(std::make_shared<const std::vector<BlockSummary>>(blocks)),
        restitution_(scene, *summaries_) {
    source_.reserve(blocks.size());
    for (const BlockSummary& block : blocks) source_.push_back(block.stiffness);
    note_tangents({scene.contact.law.friction_angle, scene.contact.law.friction_angle_residual,
                   scene.contact.law.dilation_angle});
    for (const SceneJoint& joint : scene.joint)
      note_tangents({joint.friction_angle, joint.friction_angle_residual, joint.dilation_angle});
    const std::vector<std::vector<std::size_t>> kinds = kinds_of_blocks();
    if (!multipliers_ || asked_for_) note_choices(kinds, choices);
    if (restitution_.chooses()) note_restitution(kinds, choices);
  }

  JointLaw operator()(int a, int b) const {
    const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
    const JointLaw whole = law(first, second);
    return strength_factor_ != 1.0 && reduced_.contains(first, second) ? reduced(whole, strength_factor_)
                                                                       : whole;
  }

 private:
  [[nodiscard]] JointLaw law(std::size_t a, std::size_t b) const {
    const SceneJointLaw given = table_->law_between(a, b);
    JointLaw result;
    result.area_springs = area_;
    result.normal_stiffness = given.normal_stiffness
                                  ? *given.normal_stiffness
                                  : automatic_normal_stiffness(source_[a], source_[b], area_, ratios_);
    result.rigid = !given.normal_stiffness;
    if (given.keeps_springs(asked_for_)) result.transmission = Transmission::springs;
    result.shear_stiffness =
        given.shear_stiffness.value_or(ratios_.shear_to_normal_stiffness * result.normal_stiffness);
    if (given.tie || given.fracture_energy) set_springs_of_bond(a, b, given, result);
    result.friction = tangent_of(given.friction_angle);
    result.cohesion = given.cohesion;
    result.tensile_strength = given.tensile_strength;
    if (given.compressive_strength) result.compressive_strength = *given.compressive_strength;
    if (given.maximum_closure) result.largest_closure = *given.maximum_closure;
    if (given.roughness) result.roughness = roughness_of(*given.roughness, result.friction);
    // One entry may give the residual and a later one a smaller strength.
    result.residual = {
        std::min(result.friction, tangent_of(given.friction_angle_residual.value_or(given.friction_angle))),
        std::min(result.cohesion, given.cohesion_residual.value_or(0.0)),
        std::min(result.tensile_strength, given.tensile_strength_residual.value_or(0.0))};
    // Several entries together must not generate energy either.
    result.dilation = std::min(tangent_of(given.dilation_angle), result.residual->friction);
    result.damping = given.damping;
    result.restitution = restitution_.of(a, b, given);
    result.fracture = given.fracture_energy.value_or(FractureEnergy{});
    return result;
  }

  /// Laws are asked for by the thousand in each step: tangents of the angles of a scene are computed once.
  void note_tangents(std::initializer_list<std::optional<double>> angles) {
    for (const std::optional<double>& degrees : angles)
      if (degrees) tangents_.try_emplace(*degrees, correctly_rounded::tan_of_degrees(*degrees));
  }
  [[nodiscard]] double tangent_of(double degrees) const {
    const auto known = tangents_.find(degrees);
    return known != tangents_.end() ? known->second : correctly_rounded::tan_of_degrees(degrees);
  }

  /// Stiffnesses that are not given: of a tie, and as much as the fracture energy needs.
  void set_springs_of_bond(std::size_t a, std::size_t b, const SceneJointLaw& given, JointLaw& law) const {
    const auto stiffness = [&](double automatic, double strength, double energy) {
      const double least = energy > 0.0 ? least_bond_stiffness(strength, energy) : 0.0;
      return std::max(automatic, automatic_bond_stiffness * least);
    };
    const FractureEnergy energy = given.fracture_energy.value_or(FractureEnergy{});
    const double tie = given.tie ? automatic_tie_stiffness(source_[a], source_[b], ratios_) : 0.0;
    if (!given.normal_stiffness)
      law.normal_stiffness =
          stiffness(std::max(tie, law.normal_stiffness), given.tensile_strength, energy.tension);
    if (!given.shear_stiffness)
      law.shear_stiffness = stiffness(std::max(tie, law.shear_stiffness), given.cohesion, energy.shear);
  }

  /// Two blocks, or one, of each kind: equal blocks matched by the same globs have the same joints.
  [[nodiscard]] std::vector<std::vector<std::size_t>> kinds_of_blocks() const {
    std::vector<std::vector<std::size_t>> globs = table_->globs_of_blocks();
    std::map<std::pair<std::vector<std::size_t>, StiffnessSource>, std::vector<std::size_t>> kinds;
    for (std::size_t k = 0; k < source_.size(); ++k) {
      std::vector<std::size_t>& blocks = kinds[{std::move(globs[k]), source_[k]}];
      if (blocks.size() < 2) blocks.push_back(k);
    }
    std::vector<std::vector<std::size_t>> result;
    for (auto& [kind, blocks] : kinds) result.push_back(std::move(blocks));
    return result;
  }

  /// The softest and the stiffest pair with automatic stiffness.
  void note_choices(const std::vector<std::vector<std::size_t>>& kinds,
                    std::vector<AutomaticChoice>& choices) const {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t m = 0; m < kinds.size(); ++m) {
      for (std::size_t n = m; n < kinds.size(); ++n) {
        const std::size_t a = kinds[m].front(), b = kinds[n].back();
        if (a == b || (source_[a].fixed && source_[b].fixed)) continue;
        const double stiffness = automatic_normal_stiffness(source_[a], source_[b], area_, ratios_);
        if (stiffness >= least && stiffness <= most) continue;
        if (table_->law_between(a, b).normal_stiffness) continue;
        least = std::min(least, stiffness);
        most = std::max(most, stiffness);
      }
    }
    const char* unit = area_ ? "Pa/m" : "N/m";
    if (most > 0.0) {
      choices.push_back({"contact.normal_stiffness (softest pair)", least, unit});
      if (most > least) choices.push_back({"contact.normal_stiffness (stiffest pair)", most, unit});
    }
  }

  /// Of pairs for which the scene gives no restitution: whether all are plastic, some, or none.
  void note_restitution(const std::vector<std::vector<std::size_t>>& kinds,
                        std::vector<AutomaticChoice>& choices) const {
    bool plastic = false, springs = false;
    for (std::size_t m = 0; m < kinds.size(); ++m) {
      for (std::size_t n = m; n < kinds.size(); ++n) {
        const std::size_t a = kinds[m].front(), b = kinds[n].back();
        if (a == b || (source_[a].fixed && source_[b].fixed)) continue;
        const SceneJointLaw law = table_->law_between(a, b);
        if (law.restitution) continue;
        (restitution_.of(a, b, law) ? plastic : springs) = true;
      }
    }
    const std::string key = plastic && springs ? "contact.restitution (stiff pairs)" : "contact.restitution";
    if (plastic) choices.push_back({key, 0.0, "", "a step does not resolve how they rebound"});
    if (springs && !plastic)
      choices.push_back({key, std::string("springs"), "", "steps resolve them, or damping has the loss"});
  }

  bool area_;
  bool multipliers_;
  bool asked_for_;  ///< for all joints, with any given stiffness
  AutomaticRatios ratios_;
  std::shared_ptr<const JointTable> table_;
  double strength_factor_;
  JointSelection reduced_;
  std::vector<StiffnessSource> source_;  ///< (#blocks)
  std::map<double, double> tangents_;    ///< by angle, degrees
  std::shared_ptr<const std::vector<BlockSummary>> summaries_;
  ChosenRestitution restitution_;
};

/// Depth up to which contacts start without force, m, for all blocks whose boxes intersect.
std::map<PairKey, double> depths_without_force(const LoadedScene& loaded) {
  std::map<PairKey, double> depths;
  const double allowed = loaded.scene.contact.allowed_overlap;
  if (allowed == 0.0) return depths;
  std::vector<Box> boxes;
  for (const Polyhedron& solid : loaded.solids) boxes.push_back(box_of(solid.mesh().points));
  for (const PairKey& pair : meeting_boxes(boxes)) depths[pair] = allowed;
  return depths;
}

std::optional<BuiltSimulation> built_of(const LoadedScene& loaded, int threads, Diagnostics& diagnostics,
                                        Preparation* preparation, const TrialFactors& factors,
                                        const RunRanks* ranks) {
  const Scene& scene = loaded.scene;
  if (ranks != nullptr && ranks->several()) check_for_ranks(scene, diagnostics);
  if (preparation != nullptr && !scene.water.empty()) preparation->phase("pressure of water");
  const auto models =
      std::make_shared<const SceneModels>(loaded, time_settings(scene.analysis), factors.load, diagnostics);
  if (!diagnostics.good()) return std::nullopt;
  std::optional<BlockSurvey> survey = survey_blocks(*models, ranks, diagnostics, preparation);
  if (!survey) return std::nullopt;
  const std::vector<BlockSummary>& blocks = survey->blocks;
  std::vector<InitialMotion> motions;
  for (const SceneBlock& block : scene.block) motions.push_back({block.velocity, block.angular_velocity});
  if (preparation != nullptr) preparation->phase("surfaces and neighbours of all blocks");
  std::vector<AutomaticChoice> choices;
  const SimulationSettings settings = settings_of(scene, blocks, threads, choices);
  const auto table = std::make_shared<const JointTable>(scene);
  JointLaws laws(scene, blocks, table, factors.strength, choices);
  const std::vector<TieRequest> ties = ties_of(scene, *table, blocks);
  if (!ties.empty() && scene.analysis.formulation == SceneAnalysis::Formulation::incremental) {
    diagnostics.error(scene.places.key("analysis.formulation"),
                      "blocks of the incremental formulation cannot be tied");
    return std::nullopt;
  }
  const BlockLoader load = [models, library = std::make_shared<BlockPartsLibrary>()](int block) {
    return models->model(at(block), *library);
  };
  std::vector<Bolt> bolts;
  if (!scene.bolt.empty() || !scene.prop.empty()) bolts = bolts_of(loaded);
  std::vector<std::vector<int>> bolted;
  for (const Bolt& bolt : bolts) bolted.push_back(present_blocks(bolt.chain));
  BuiltSimulation built{
      simulation_of(ranks,
                    {std::move(survey->blocks), std::move(survey->models), std::move(motions),
                     std::move(laws), settings, ties, scene.absent, std::move(bolted)},
                    load),
      std::move(choices),
      survey->different,
      {},
      loaded.overlaps};
  built.simulation.start_overlapping(depths_without_force(loaded));
  if (!scene.water.empty())
    built.simulation.set_joint_pressure([water = models->water()](int a, int b, const Vector3& place) {
      return water->in_joint(at(a), at(b), place);
    });
  // Later stages begin with the contacts of the one before.
  if (scene.initial_stress.given() && loaded.stage == 0)
    start_under_stress(scene, built.simulation, diagnostics);
  check_ties(scene, *table, built.simulation.system(), diagnostics);
  if (!diagnostics.good()) return std::nullopt;
  if (scene.analysis.initial_state == SceneAnalysis::InitialState::equilibrium) {
    built.as_placed = start_in_equilibrium(scene, built.simulation, diagnostics);
    if (!diagnostics.good()) return std::nullopt;
  }
  if (!bolts.empty()) built.simulation.add_bolts(std::move(bolts));
  return built;
}

}  // namespace

std::optional<BuiltSimulation> build_simulation(const LoadedScene& loaded, int threads,
                                                Diagnostics& diagnostics, Preparation* preparation,
                                                const TrialFactors& factors, const RunRanks* ranks) {
  const auto refuse = [&](const std::exception& error) {
    // All ranks end together where one throws.
    if (ranks != nullptr && ranks->several()) throw;
    diagnostics.error(
        loaded.scene.places.key(""),
        fmt::format("no model can be made of the scene ({}), other values are needed", error.what()));
    return std::nullopt;
  };
  // Checks of scenes name the key; values that they do not foresee end here.
  try {
    return built_of(loaded, threads, diagnostics, preparation, factors, ranks);
  } catch (const std::invalid_argument& error) {
    return refuse(error);
  } catch (const std::domain_error& error) {
    return refuse(error);
  }
}

}  // namespace ashlar
