#include "apps/scene/check/scene_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "apps/scene/check/accuracy_checks.hpp"
#include "apps/scene/check/formulation_checks.hpp"
#include "apps/scene/check/joint_checks.hpp"
#include "apps/scene/check/joint_rules.hpp"
#include "apps/scene/check/measure_checks.hpp"
#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/model/block_names.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "mechanics/material/poisson_limit.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

std::string entry_key(const char* table, std::size_t index, const char* key) {
  return fmt::format("{}.{}.{}", table, index, key);
}

// Reports repeated names. A name that was not read is empty and has been reported already.
template <typename Entry>
void check_names(const Scene& scene, const std::vector<Entry>& entries, const char* table,
                 Diagnostics& diagnostics) {
  std::map<std::string, Place> first_places;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string key = entry_key(table, i, "name");
    const std::string& name = entries[i].name;
    if (name.empty()) continue;
    const Place place = scene.places.value(key);
    const auto [first, is_new] = first_places.emplace(name, place);
    if (!is_new)
      diagnostics.error(
          place, fmt::format("{} named twice (\"{}\", first at {}), every {} needs its own name", table, name,
                             to_string(first->second), table));
  }
}

template <typename Entry>
std::vector<std::string> names_of(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries)
    if (!entry.name.empty()) names.push_back(entry.name);
  return names;
}

// Reports an unknown name; an empty one was not read.
void check_known(const Scene& scene, const std::string& key, const char* what, const std::string& name,
                 const std::vector<std::string>& known, Diagnostics& diagnostics) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string allowed =
      known.empty() ? fmt::format("there is no [[{}]]", what)
                    : fmt::format("{}the name of a [[{}]] is needed", guess(name, known, "\""), what);
  diagnostics.error(scene.places.value(key), fmt::format("unknown {} (\"{}\"), {}", what, name, allowed));
}

void check_materials(const Scene& scene, const std::vector<std::string>& known, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.block.size(); ++i) {
    const SceneBlock& block = scene.block[i];
    const std::string key = entry_key("block", i, "material");
    check_known(scene, key, "material", block.material, known, diagnostics);
    if (block.fixed || !block.material.empty() || scene.places.contains(key) ||
        !scene.places.contains(fmt::format("block.{}", i)))
      continue;
    const std::string allowed = known.empty()
                                    ? "there is no [[material]]"
                                    : fmt::format("one of \"{}\" is needed", fmt::join(known, "\", \""));
    diagnostics.error(scene.places.key(fmt::format("block.{}", i)),
                      fmt::format("missing key (material), block \"{}\" has none, {}", block.name, allowed));
  }
}

// Reports nearly incompressible materials, whose pressures are dominated by rounding errors, the more so the higher
// the order.
void check_poisson_ratios(const Scene& scene, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const SceneMaterial& material = scene.material[i];
    const SceneBlock* highest = nullptr;
    for (const SceneBlock& block : scene.block) {
      if (block.fixed || block.material != material.name) continue;
      if (highest == nullptr || block.order > highest->order) highest = &block;
    }
    if (highest == nullptr || material.poisson_ratio <= largest_poisson_ratio(highest->order)) continue;
    diagnostics.error(
        scene.places.value(entry_key("material", i, "poisson_ratio")),
        fmt::format(
            "poisson_ratio is too near 0.5 for order {} of block \"{}\" in double precision ({}), at most "
            "{:.8g} is allowed",
            highest->order, highest->name, material.poisson_ratio, largest_poisson_ratio(highest->order)));
  }
}

void check_joints(const Scene& scene, const std::vector<std::string>& blocks, Diagnostics& diagnostics) {
  const JointTable table(scene);
  for (std::size_t i = 0; i < scene.joint.size(); ++i) {
    const SceneJoint& joint = scene.joint[i];
    if (joint.blocks[0].empty() && joint.blocks[1].empty()) continue;  // not read
    if (joint.made_by_cut) continue;
    const Place place = scene.places.value(entry_key("joint", i, "blocks"));
    bool all_match = true;
    for (const std::size_t side : {0U, 1U}) {
      if (!table.matched(i, side).empty()) continue;
      all_match = false;
      const std::string& pattern = joint.blocks[side];
      diagnostics.error(place,
                        fmt::format("joint names no block (\"{}\"), {}the name of a [[block]] or a glob "
                                    "that matches one is needed",
                                    pattern, guess_block(pattern, blocks)));
    }
    if (all_match && !table.matches_a_pair(i))
      diagnostics.error(place,
                        fmt::format("joint between a block and itself (\"{}\", \"{}\"), two different blocks "
                                    "are needed",
                                    joint.blocks[0], joint.blocks[1]));
  }
}

/// Checks the targets of a search for a factor.
void check_factor_search(const Scene& scene, Diagnostics& diagnostics) {
  const bool of_joints = scene.analysis.type == SceneAnalysis::Type::safety;
  if (!of_joints && scene.analysis.type != SceneAnalysis::Type::capacity) return;
  std::vector<std::string> names;
  for (const SceneBlock& block : scene.block)
    if (of_joints || !block.load.empty() || !scene.load.empty()) names.push_back(block.name);
  if (of_joints)
    for (const SceneCut& cut : scene.cut) names.push_back(cut.name);
  const std::string key = of_joints ? "analysis.safety.joints" : "analysis.capacity.blocks";
  const char* needed =
      of_joints ? "the name of a [[block]] or a [[cut]]" : "the name of a [[block]] with loads";
  for (const std::string& pattern : (of_joints ? scene.analysis.safety : scene.analysis.capacity).of) {
    if (std::any_of(names.begin(), names.end(),
                    [&](const std::string& name) { return pattern_matches(pattern, name); }))
      continue;
    bool of_piece = false;
    for (std::size_t k = 0; k < scene.block.size() && !of_piece; ++k)
      of_piece = (of_joints || !scene.block[k].load.empty() || !scene.load.empty()) &&
                 pattern_names_block(scene, pattern, k);
    if (of_piece) continue;
    diagnostics.error(
        scene.places.value(key),
        fmt::format("search for a factor names no {} (\"{}\"), {}{} or a glob that matches one "
                    "is needed",
                    of_joints ? "joint" : "load", pattern, guess(pattern, names, "\""), needed));
  }
}

// Reports keys that have no meaning for rigid blocks.
void check_rigid_blocks(const Scene& scene, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.block.size(); ++i) {
    const SceneBlock& block = scene.block[i];
    if (block.order != 0 || block.fixed) continue;
    const auto refuse = [&](const char* key, const std::string& what, const char* allowed) {
      diagnostics.error(scene.places.value(entry_key("block", i, key)),
                        fmt::format("{} (\"{}\"), {}", what, block.name, allowed));
    };
    if (!block.fix.empty())
      refuse("fix", "a block of order 0 has no supports", "fixed = true, or an order from 1 on is needed");
    if (scene.analysis.integrator == SceneAnalysis::Integrator::generalized_alpha)
      refuse("order", "generalized-alpha does not move blocks of order 0",
             "integrator = \"dda\" or \"average-acceleration\", or an order from 1 on is needed");
  }
}

// A measure's name is used in columns of history.csv beside those of the totals.
void check_measure_names(const Scene& scene, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.measure.size(); ++i) {
    const std::string& name = scene.measure[i].name;
    const Place place = scene.places.value(entry_key("measure", i, "name"));
    if (name == "momentum" || name == "angular_momentum")
      diagnostics.error(
          place, fmt::format("measure name is taken (\"{}\"), history.csv has columns of that name for "
                             "the whole scene",
                             name));
  }
}

std::string in_words(const Vector3& vector) {
  return fmt::format("[{}, {}, {}]", vector.x(), vector.y(), vector.z());
}

struct NearFace {
  ScenePlane plane;
  double offset;  ///< largest distance of its corners from the required plane, m
};

NearFace nearest_face(const Polyhedron& solid, const ScenePlane& plane) {
  const Vector3 normal = plane.normal.stableNormalized();
  NearFace nearest{{}, std::numeric_limits<double>::infinity()};
  for (const PolyhedronFace& face : solid.faces()) {
    double offset = 0.0;
    for (const auto& loop : face.loops)
      for (const int corner : loop) {
        const Vector3& point = solid.mesh().points[static_cast<std::size_t>(corner)];
        offset = std::max(offset, std::abs(normal.dot(point - plane.point)));
      }
    const Vector3& first = solid.mesh().points[static_cast<std::size_t>(face.loops.front().front())];
    if (offset < nearest.offset) nearest = {{first, face.normal}, offset};
  }
  return nearest;
}

class PlacementCheck {
 public:
  PlacementCheck(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void check_point(const std::string& key, const SceneBlock& block, const Polyhedron& solid,
                   const Vector3& point) {
    if (!point.allFinite()) return;
    Vector3 low = solid.mesh().points.front(), high = low;
    for (const Vector3& corner : solid.mesh().points) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const Vector3 outside = (low - point).cwiseMax(point - high).cwiseMax(0.0);
    if (outside.norm() <= allowed_offset(solid)) return;
    low += scene_.origin;
    high += scene_.origin;
    error(key,
          fmt::format("point is not in block \"{}\" ({}), a point of the placed block is needed: x {} to {}, "
                      "y {} to {}, "
                      "z {} to {}",
                      block.name, in_words(scene_.origin + point), low.x(), high.x(), low.y(), high.y(),
                      low.z(), high.z()));
  }

  void check_where(const std::string& key, const SceneBlock& block, const Polyhedron& solid,
                   const std::variant<ScenePlane, Vector3>& where) {
    if (const Vector3* point = std::get_if<Vector3>(&where)) {
      check_point(key + ".point", block, solid, *point);
      return;
    }
    const ScenePlane& plane = std::get<ScenePlane>(where);
    // A plane refused by the reader has been reported already.
    if (!plane.point.allFinite() || !plane.normal.allFinite() || plane.normal.isZero(0.0)) return;
    if (!faces_in_plane(solid, {plane.point, plane.normal}).empty()) return;
    const NearFace nearest = nearest_face(solid, plane);
    error(
        key + ".plane",
        fmt::format(
            "no face of block \"{}\" lies in the plane (point {}, normal {}), a plane within {:.2g} m "
            "of all corners of a face is needed; the nearest face is {:.2g} m off, its plane has "
            "point {}, normal {}",
            block.name, in_words(scene_.origin + plane.point), in_words(plane.normal), allowed_offset(solid),
            nearest.offset, in_words(scene_.origin + nearest.plane.point), in_words(nearest.plane.normal)));
  }

 private:
  void error(const std::string& key, std::string message) {
    diagnostics_.error(scene_.places.value(key), std::move(message));
  }

  const Scene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_references(const Scene& scene, Diagnostics& diagnostics) {
  check_references(scene, diagnostics, diagnostics);
}

void check_references(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks) {
  const SceneAnalysis& analysis = scene.analysis;
  // Zero: not read.
  if (analysis.end_time > 0.0 && analysis.time_step > analysis.end_time)
    diagnostics.error(
        scene.places.value("analysis.time_step"),
        fmt::format("time_step is longer than the analysis ({}), at most end_time ({}) is needed",
                    analysis.time_step, analysis.end_time));
  // Beyond this the step of generalized-alpha is unstable in contact (time_scheme.hpp).
  constexpr double most_damping_per_step = 3.0;
  if (analysis.integrator == SceneAnalysis::Integrator::generalized_alpha &&
      analysis.mass_damping * analysis.time_step > most_damping_per_step)
    diagnostics.error(
        scene.places.value("analysis.mass_damping"),
        fmt::format("mass_damping is too large for this time_step with generalized-alpha ({}), at "
                    "most {} / time_step = {} is allowed",
                    analysis.mass_damping, most_damping_per_step,
                    most_damping_per_step / analysis.time_step));
  check_formulation(scene, diagnostics);
  check_accuracy(scene, diagnostics);
  check_rigid_blocks(scene, diagnostics);
  check_names(scene, scene.material, "material", diagnostics);
  check_names(scene, scene.block, "block", diagnostics);
  check_names(scene, scene.measure, "measure", diagnostics);
  check_measure_names(scene, diagnostics);
  const std::vector<std::string> materials = names_of(scene.material), blocks = names_of(scene.block);
  check_materials(scene, materials, diagnostics);
  check_poisson_ratios(scene, diagnostics);
  for (std::size_t i = 0; i < scene.measure.size(); ++i) {
    const SceneMeasure& measure = scene.measure[i];
    check_known(scene, entry_key("measure", i, "block"), "block", measure.block, blocks, of_blocks);
    const std::string key = entry_key("measure", i, "pair");
    for (const std::string& name : measure.pair) check_known(scene, key, "block", name, blocks, of_blocks);
    if (!measure.pair[0].empty() && measure.pair[0] == measure.pair[1])
      diagnostics.error(scene.places.value(key),
                        fmt::format("measure of a block and itself (\"{}\"), two different blocks are needed",
                                    measure.pair[0]));
  }
  check_group_measures(scene, of_blocks);
  check_joints(scene, blocks, of_blocks);
  check_joint_laws(scene, diagnostics);
  check_joint_rules(scene, diagnostics);
  check_factor_search(scene, diagnostics);
  check_names(scene, scene.water, "water", diagnostics);
  check_water(scene, diagnostics, of_blocks);
  check_initial_stress(scene, diagnostics, of_blocks);
}

void check_cuts(const Scene& scene, Diagnostics& diagnostics) {
  check_names(scene, scene.block, "block", diagnostics);
  check_names(scene, scene.cut, "cut", diagnostics);
  const std::vector<std::string> cuts = names_of(scene.cut);
  for (std::size_t i = 0; i < scene.joint.size(); ++i)
    check_known(scene, entry_key("joint", i, "cut"), "cut", scene.joint[i].cut, cuts, diagnostics);
}

void check_placement(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                     Diagnostics& diagnostics) {
  check_levels(scene, solids, diagnostics);
  PlacementCheck check(scene, diagnostics);
  for (std::size_t i = 0; i < scene.block.size(); ++i) {
    const SceneBlock& block = scene.block[i];
    if (!solids[i]) continue;
    for (std::size_t j = 0; j < block.fix.size(); ++j)
      check.check_where(fmt::format("block.{}.fix.{}", i, j), block, *solids[i], block.fix[j].where);
    for (std::size_t j = 0; j < block.load.size(); ++j)
      check.check_where(fmt::format("block.{}.load.{}", i, j), block, *solids[i], block.load[j].where);
    for (std::size_t j = 0; j < scene.measure.size(); ++j)
      if (scene.measure[j].block == block.name && scene.measure[j].point)
        check.check_point(entry_key("measure", j, "point"), block, *solids[i], *scene.measure[j].point);
  }
}

}  // namespace ashlar
