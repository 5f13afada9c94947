#include "apps/scene/check/warnings/soft_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/model/block_names.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// A block with the data that determine its softness.
struct JudgedBlock {
  const SceneBlock& block;
  const SceneMaterial& material;
  double size;           ///< cube root of the volume, m
  double weight;         ///< N
  double weight_stress;  ///< density |gravity| height, Pa
  double load_stress;    ///< of the largest load, Pa
  double speed;          ///< of its fastest point, m/s
};

double extent_along(const Polyhedron& solid, const Vector3& direction) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector3& point : solid.mesh().points) {
    low = std::min(low, point.dot(direction));
    high = std::max(high, point.dot(direction));
  }
  return high - low;
}

double diagonal_of(const Polyhedron& solid) {
  return Vector3(extent_along(solid, Vector3::UnitX()), extent_along(solid, Vector3::UnitY()),
                 extent_along(solid, Vector3::UnitZ()))
      .norm();
}

double largest_factor(const SceneLoad& load) {
  double largest = load.history.empty() ? 1.0 : 0.0;
  for (const SceneLoad::Factor& factor : load.history) largest = std::max(largest, std::abs(factor.factor));
  return largest;
}

/// For a history: its longest row.
Vector3 largest_gravity(const SceneAnalysis& analysis) {
  if (analysis.gravity_history.empty()) return analysis.gravity;
  const auto shorter = [](const SceneAnalysis::Gravity& a, const SceneAnalysis::Gravity& b) {
    return a.value.norm() < b.value.norm();
  };
  return std::max_element(analysis.gravity_history.begin(), analysis.gravity_history.end(), shorter)->value;
}

JudgedBlock judged(const Scene& scene, const SceneBlock& block, const SceneMaterial& material,
                   const Polyhedron& solid) {
  const double size = correctly_rounded::cbrt(solid.volume());
  JudgedBlock result{block, material, size, 0.0, 0.0, 0.0, 0.0};
  const Vector3 gravity = largest_gravity(scene.analysis);
  result.weight = material.density * gravity.norm() * solid.volume();
  // The extent along gravity times its length.
  result.weight_stress = material.density * extent_along(solid, gravity);
  for (const SceneLoad& load : block.load) {
    const double area = load.kind == SceneLoad::Kind::traction ? 1.0 : size * size;
    result.load_stress = std::max(result.load_stress, largest_factor(load) * load.vector.stableNorm() / area);
  }
  result.speed = block.velocity.stableNorm() + 0.5 * block.angular_velocity.stableNorm() * diagonal_of(solid);
  return result;
}

/// A cause of deformation.
struct Cause {
  double strain = 0.0;
  const char* words = "";
  const SceneBlock* block = nullptr;
};

void take_larger(Cause& largest, const Cause& other) {
  if (other.strain > largest.strain) largest = other;
}

void warn_of_material(const Scene& scene, std::size_t index, const std::vector<JudgedBlock>& blocks,
                      Diagnostics& diagnostics) {
  const SceneMaterial& material = scene.material[index];
  const double modulus = material.young_modulus;
  Cause largest;
  for (const JudgedBlock& judged : blocks) {
    if (&judged.material != &material) continue;
    take_larger(largest, {judged.weight_stress / modulus, "under its own weight", &judged.block});
    take_larger(largest, {judged.load_stress / modulus, "under its load", &judged.block});
  }
  if (!(largest.strain > largest_ordinary_strain)) return;
  diagnostics.warning(
      scene.places.value(fmt::format("material.{}.young_modulus", index)),
      fmt::format("young_modulus is small ({:.10g} Pa): block \"{}\" is strained by {:.3g} {}, up to {} is "
                  "ordinary; rock has 1e9 to 1e11 Pa",
                  modulus, largest.block->name, largest.strain, largest.words, largest_ordinary_strain));
}

/// The strain of a body that hits something at a speed v is v / c, c the speed of sound in it.
void warn_of_speed(const Scene& scene, std::size_t k, const JudgedBlock& judged, Diagnostics& diagnostics) {
  const double sound = std::sqrt(judged.material.young_modulus / judged.material.density);
  const double strain = judged.speed / sound;
  if (!(strain > largest_ordinary_strain)) return;
  const bool turns = judged.block.angular_velocity.stableNorm() > 0.0 &&
                     judged.speed > 2.0 * judged.block.velocity.stableNorm();
  const char* key = turns ? "angular_velocity" : "velocity";
  diagnostics.warning(
      scene.places.value(fmt::format("block.{}.{}", k, key)),
      fmt::format("{} is large ({:.4g} m/s at the fastest point of block \"{}\"): an impact strains it by "
                  "{:.3g}, up to {} is ordinary, that of {:.3g} m/s in a material of young_modulus "
                  "{:.3g} Pa",
                  key, judged.speed, judged.block.name, strain, largest_ordinary_strain,
                  largest_ordinary_strain * sound, judged.material.young_modulus));
}

/// @param key of a normal stiffness. @param maximum_closure given with it. @param concerns true if a block has joints with it
template <class Concerns>
void warn_of_stiffness(const Scene& scene, const std::string& key, double stiffness,
                       const std::optional<double>& maximum_closure, const std::vector<JudgedBlock>& blocks,
                       Concerns concerns, Diagnostics& diagnostics) {
  constexpr double least_bearing_points = 3.0;
  const bool area = scene.contact.springs == SceneContact::Springs::area;
  Cause largest;
  for (const JudgedBlock& judged : blocks) {
    if (!concerns(judged.block)) continue;
    const double borne = area ? judged.weight_stress : judged.weight / least_bearing_points;
    const double sinks = borne / (stiffness + (maximum_closure ? borne / *maximum_closure : 0.0));
    take_larger(largest, {sinks / judged.size, "", &judged.block});
  }
  if (!(largest.strain > largest_ordinary_strain)) return;
  diagnostics.warning(
      scene.places.value(key),
      fmt::format("normal_stiffness is small ({:.10g} {}): block \"{}\" sinks by {:.3g} of its size under "
                  "its own weight, up to {} is ordinary",
                  stiffness, area ? "Pa/m" : "N/m", largest.block->name, largest.strain,
                  largest_ordinary_strain));
}

}  // namespace

void warn_of_soft_blocks(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                         Diagnostics& diagnostics) {
  std::vector<JudgedBlock> blocks;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    const SceneMaterial* material = find_material(scene, block.material);
    if (block.fixed || block.order == 0 || material == nullptr || !solids[k]) continue;
    blocks.push_back(judged(scene, block, *material, *solids[k]));
  }
  for (const JudgedBlock& block : blocks)
    warn_of_speed(scene, static_cast<std::size_t>(&block.block - scene.block.data()), block, diagnostics);
  for (std::size_t k = 0; k < scene.material.size(); ++k) warn_of_material(scene, k, blocks, diagnostics);
  if (scene.contact.law.normal_stiffness) {
    warn_of_stiffness(
        scene, "contact.normal_stiffness", *scene.contact.law.normal_stiffness,
        scene.contact.law.maximum_closure, blocks, [](const SceneBlock&) { return true; }, diagnostics);
  }
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    const SceneJoint& joint = scene.joint[k];
    if (!joint.normal_stiffness || !*joint.normal_stiffness) continue;
    warn_of_stiffness(
        scene, fmt::format("joint.{}.normal_stiffness", k), **joint.normal_stiffness, joint.maximum_closure,
        blocks,
        [&](const SceneBlock& block) {
          const auto index = static_cast<std::size_t>(&block - scene.block.data());
          if (joint.inside &&
              !std::binary_search(joint.inside->blocks.begin(), joint.inside->blocks.end(), index))
            return false;
          return pattern_names_block(scene, joint.blocks[0], index) ||
                 pattern_names_block(scene, joint.blocks[1], index);
        },
        diagnostics);
  }
}

}  // namespace ashlar
