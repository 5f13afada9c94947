#include "apps/scene/assemble/cracking_blocks.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "apps/scene/assemble/scene_models.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/state/automatic.hpp"

namespace ashlar {
namespace {

/// Length of a block along the principal axis along which it is longest, m.
double length_of(const BlockModel& block) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(block.basis().second_moment());
  const Vector3 axis = principal.eigenvectors().col(2);
  double low = 0.0, high = 0.0;
  for (const Vector3& point : block.solid().mesh().points) {
    const double height = axis.dot(point - block.basis().centroid());
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low;
}

/// Checks of a scene with [[crack]].
class CrackingCheck {
 public:
  CrackingCheck(const Scene& scene, const Simulation& run, Diagnostics& diagnostics)
      : scene_(scene), run_(run), diagnostics_(diagnostics) {
    for (const Bolt& bolt : run.system().bolts())
      for (const int block : present_blocks(bolt.chain)) bolted_.insert(block);
  }

  void check() {
    check_scene();
    for (std::size_t n = 0; n < scene_.crack.size(); ++n) check_entry(n);
  }

 private:
  void refuse(bool given, const std::string& key, const std::string& what, const char* remedy) {
    if (given)
      diagnostics_.error(scene_.places.key(key), fmt::format("{} beside [[crack]], {}", what, remedy));
  }

  void check_scene() {
    const SceneAnalysis& analysis = scene_.analysis;
    using Type = SceneAnalysis::Type;
    refuse(analysis.type != Type::dynamic && analysis.type != Type::statics, "analysis.type",
           fmt::format("a search for an answer (\"{}\")", name_of(analysis_type_names, analysis.type)),
           "\"static\" or \"dynamic\" is needed");
    refuse(analysis.accuracy.has_value(), "analysis.accuracy", "a choice for an accuracy",
           "give orders and steps");
    refuse(analysis.formulation == SceneAnalysis::Formulation::incremental, "analysis.formulation",
           "the incremental formulation", "\"total\" is needed");
    refuse(scene_.contact.springs == SceneContact::Springs::point, "contact.springs", "point springs",
           "\"area\" is needed");
    refuse(scene_.initial_stress.given(), "initial_stress", "initial stress",
           "leave it out: blocks that crack begin without stress");
    refuse(!scene_.water.empty(), "water.0", "water", "leave one of both out");
    refuse(!scene_.boundary.empty(), "boundary.0", "a boundary of the ground", "leave one of both out");
    for (std::size_t k = 0; k < scene_.measure.size(); ++k)
      refuse(scene_.measure[k].drift.has_value(), fmt::format("measure.{}.drift", k), "a drift",
             "measure points in its place");
    for (std::size_t s = 0; s < scene_.stage.size(); ++s)
      refuse(scene_.stage[s].reset_displacement, fmt::format("stage.{}.reset_displacement", s),
             "reset_displacement", "results of cracked blocks count from their placement: leave it out");
  }

  void check_entry(std::size_t n) {
    const SceneCracking& crack = scene_.crack[n];
    const auto key = [&](const char* name) {
      return scene_.places.value(fmt::format("crack.{}.{}", n, name));
    };
    for (const std::string& pattern : crack.blocks) {
      bool any = false;
      for (std::size_t k = 0; k < scene_.block.size() && !any; ++k) any = means_block(scene_, pattern, k);
      if (!any)
        diagnostics_.error(
            key("blocks"),
            fmt::format("crack names no block (\"{}\"), the name of a [[block]] or a glob that "
                        "matches one is needed",
                        pattern));
    }
    if (scene_.block.size() > static_cast<std::size_t>(crack.most_blocks))
      diagnostics_.error(key("most_blocks"),
                         fmt::format("most_blocks is below the number of blocks ({}), more than {} is needed",
                                     crack.most_blocks, scene_.block.size()));
    for (std::size_t k = 0; k < scene_.block.size(); ++k) {
      if (!means_block(scene_, crack.blocks, k)) continue;
      const std::string fault = fault_of(k, crack.least_size);
      if (!fault.empty())
        return diagnostics_.error(key(fault.starts_with("least_size") ? "least_size" : "blocks"), fault);
    }
  }

  [[nodiscard]] std::string fault_of(std::size_t k, double least_size) const {
    const BlockModel& block = run_.blocks()[k];
    const std::string& name = scene_.block[k].name;
    if (block.fixed())
      return fmt::format("block \"{}\" is fixed and cannot crack; name moving blocks only", name);
    if (block.rigid())
      return fmt::format("block \"{}\" is rigid (order 0) and has no stress, order 1 or higher is needed",
                         name);
    if (run_.system().is_tied(static_cast<int>(k)))
      return fmt::format("block \"{}\" is tied and cannot crack; give `tied` a strength", name);
    if (bolted_.contains(static_cast<int>(k)))
      return fmt::format(
          "a bolt or prop ends in or passes block \"{}\", which cannot crack then; name other "
          "blocks",
          name);
    if (const double length = length_of(block); !(length >= 2.0 * least_size))
      return fmt::format(
          "least_size is too large for block \"{}\" ({} m), it has no room for two parts; at "
          "most half of its length of {:.6g} m is needed",
          name, least_size, length);
    return {};
  }

  const Scene& scene_;
  const Simulation& run_;
  Diagnostics& diagnostics_;
  std::set<int> bolted_;
};

CrackLaw law_of(const SceneCracking& crack, const BlockModel& block) {
  const StiffnessSource source = stiffness_source(block);
  const double tie = automatic_tie_stiffness(source, source);
  const auto stiffness = [&](double strength, double energy) {
    return std::max(tie, automatic_bond_stiffness * least_bond_stiffness(strength, energy));
  };
  JointLaw joint;
  joint.normal_stiffness = stiffness(crack.tensile_strength, crack.fracture_energy.tension);
  joint.shear_stiffness = stiffness(crack.cohesion, crack.fracture_energy.shear);
  joint.friction = correctly_rounded::tan_of_degrees(crack.friction_angle);
  joint.cohesion = crack.cohesion;
  joint.tensile_strength = crack.tensile_strength;
  joint.rigid = true;
  joint.transmission = Transmission::springs;
  joint.residual = ResidualStrength{joint.friction, 0.0, 0.0};
  joint.fracture = crack.fracture_energy;
  return {crack.tensile_strength, crack.least_size, joint};
}

}  // namespace

void check_cracking(const Scene& scene, const Simulation& run, Diagnostics& diagnostics) {
  if (!scene.crack.empty()) CrackingCheck(scene, run, diagnostics).check();
}

std::unique_ptr<CrackedBlocks> cracked_blocks(std::shared_ptr<const LoadedScene> stage,
                                              const Simulation& run) {
  const Scene& scene = stage->scene;
  if (scene.crack.empty()) return nullptr;
  std::vector<std::optional<CrackLaw>> laws(scene.block.size());
  int most_blocks = 1;
  for (const SceneCracking& crack : scene.crack) {
    most_blocks = std::max(most_blocks, crack.most_blocks);
    for (std::size_t k = 0; k < laws.size(); ++k)
      if (means_block(scene, crack.blocks, k)) laws[k] = law_of(crack, run.blocks()[k]);
  }
  Diagnostics ignored;  // the simulation has been built of the same scene
  const auto models = std::make_shared<const SceneModels>(*stage, run.system().settings(), 1.0, ignored);
  const auto definition = [stage, models](int block) { return models->definition(at(block)); };
  return std::make_unique<CrackedBlocks>(std::move(laws), definition, run, most_blocks);
}

}  // namespace ashlar
