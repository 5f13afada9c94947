#include "apps/scene/read/assignments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/read/block_arrays.hpp"

namespace ashlar {
namespace {

/// About a second of work.
constexpr double most_tests = 1e7;
/// Memory for the places of values assigned by an entry to a block, bytes.
constexpr double memory_of_keys = 100.0;

bool is_glob(const std::string& pattern) {
  return pattern.find_first_of("*?[\\") != std::string::npos;
}

/// Marks the pieces matched by a pattern, see apply_assignments_to_pieces. @return true if it matches a block or a
/// piece
bool choose_pieces(const Scene& scene, const std::string& pattern, std::vector<bool>& chosen) {
  const bool glob = is_glob(pattern);
  const auto matches = [&](const std::string& name) {
    return glob ? pattern_matches(pattern, name) : pattern == name;
  };
  bool matched = false;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const bool of_block = matches(scene.uncut[scene.rock->origin[k].uncut].name);
    const std::vector<std::string>& others = scene.rock->other_names[k];
    const bool of_piece =
        !of_block && (matches(scene.block[k].name) || std::any_of(others.begin(), others.end(), matches));
    chosen[k] = chosen[k] || of_piece;
    matched = matched || of_block || of_piece;
  }
  return matched;
}

class Assigner {
 public:
  Assigner(Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
    for (std::size_t k = 0; k < scene.block.size(); ++k) by_name_.emplace(scene.block[k].name, k);
  }

  /// @return true if the limit is not reached
  bool apply(std::size_t index) {
    const SceneAssign& given = scene_.assign[index];
    std::vector<bool> chosen(scene_.block.size(), false);
    if (given.inside)
      for (const std::size_t k : given.inside->blocks) chosen[k] = true;
    for (const std::string& pattern : given.blocks) {
      if (given.inside) break;
      tests_ += static_cast<double>(chosen.size());
      if (tests_ > most_tests) return refuse_size(index);
      const bool matched = scene_.rock ? choose_pieces(scene_, pattern, chosen) : choose(pattern, chosen);
      // A pattern that matches no block may match a piece, once there are any.
      if (!matched && (scene_.rock || scene_.cut.empty())) refuse_pattern(index, pattern);
    }
    double memory = memory_of_keys;
    for (const SceneFix& fix : given.fix) memory += memory_of(fix) + memory_of_keys;
    for (const SceneLoad& load : given.load) memory += memory_of(load) + memory_of_keys;
    memory_ += memory * static_cast<double>(std::count(chosen.begin(), chosen.end(), true));
    if (memory_ > most_laid_memory) return refuse_size(index);
    bool refused = false;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (!chosen[k]) continue;
      assign(index, k);
      if (!refused && moves_although_fixed(scene_.block[k])) refuse_motion(index, k);
      refused = refused || moves_although_fixed(scene_.block[k]);
    }
    return true;
  }

 private:
  bool refuse_size(std::size_t index) {
    diagnostics_.error(scene_.places.key(fmt::format("assign.{}", index)),
                       fmt::format("assignments are too many for their blocks ({} entries, {} blocks), fewer "
                                   "patterns, supports or loads are needed",
                                   scene_.assign.size(), scene_.block.size()));
    return false;
  }

  bool choose(const std::string& pattern, std::vector<bool>& chosen) const {
    bool matched = false;
    if (!is_glob(pattern)) {
      const auto found = by_name_.find(pattern);
      matched = found != by_name_.end();
      if (matched) chosen[found->second] = true;
      return matched;
    }
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (!pattern_matches(pattern, scene_.block[k].name)) continue;
      chosen[k] = true;
      matched = true;
    }
    return matched;
  }

  void refuse_pattern(std::size_t index, const std::string& pattern) {
    std::vector<std::string> names;
    for (const SceneBlock& block : scene_.block) names.push_back(block.name);
    diagnostics_.error(scene_.places.value(fmt::format("assign.{}.blocks", index)),
                       fmt::format("assign names no block (\"{}\"), {}the name of a [[block]] or a glob that "
                                   "matches one is needed",
                                   pattern, guess_block(pattern, names)));
  }

  void assign(std::size_t index, std::size_t k) {
    const SceneAssign& given = scene_.assign[index];
    SceneBlock& block = scene_.block[k];
    const auto set = [&](const char* key, auto& member, const auto& value) {
      if (!value) return;
      member = *value;
      written(fmt::format("block.{}.{}", k, key), fmt::format("assign.{}.{}", index, key));
    };
    set("material", block.material, given.material);
    set("order", block.order, given.automatic_order ? std::optional(1) : given.order);
    if (given.order || given.automatic_order) block.automatic_order = given.automatic_order;
    set("fixed", block.fixed, given.fixed);
    set("velocity", block.velocity, given.velocity);
    set("angular_velocity", block.angular_velocity, given.angular_velocity);
    const auto add = [&](const char* key, auto& list, const auto& added) {
      for (std::size_t j = 0; j < added.size(); ++j) {
        written(fmt::format("block.{}.{}.{}", k, key, list.size()),
                fmt::format("assign.{}.{}.{}", index, key, j));
        list.push_back(added[j]);
      }
    };
    if (block.fixed) std::erase_if(block.load, [](const SceneLoad& load) { return load.of_fill; });
    add("fix", block.fix, given.fix);
    add("load", block.load, given.load);
  }

  static bool moves_although_fixed(const SceneBlock& block) {
    return block.fixed && (!block.fix.empty() || !block.load.empty() || !block.velocity.isZero(0.0) ||
                           !block.angular_velocity.isZero(0.0));
  }

  void refuse_motion(std::size_t index, std::size_t k) {
    diagnostics_.error(
        scene_.places.key(fmt::format("assign.{}", index)),
        fmt::format("motion of a fixed block ({}), a block with fixed = true takes no fix, load "
                    "or velocity",
                    scene_.block[k].name));
  }

  void written(const std::string& path, std::string origin) {
    scene_.places.record_origin(path, std::move(origin));
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::unordered_map<std::string, std::size_t> by_name_;
  double tests_ = 0.0;   ///< of names by patterns
  double memory_ = 0.0;  ///< bytes of assigned values
};

}  // namespace

void apply_assignments(Scene& scene, Diagnostics& diagnostics) {
  Assigner assigner(scene, diagnostics);
  for (std::size_t index = 0; index < scene.assign.size(); ++index)
    if (!scene.assign[index].inside && !assigner.apply(index)) return;
}

void apply_later_assignments(Scene& scene, Diagnostics& diagnostics) {
  Assigner assigner(scene, diagnostics);
  for (std::size_t index = 0; index < scene.assign.size(); ++index)
    if ((scene.rock || scene.assign[index].inside) && !assigner.apply(index)) return;
}

std::vector<std::vector<std::size_t>> assigned_pieces(const Scene& scene) {
  std::vector<std::vector<std::size_t>> pieces(scene.assign.size());
  if (!scene.rock) return pieces;
  for (std::size_t index = 0; index < scene.assign.size(); ++index) {
    if (scene.assign[index].inside) {
      pieces[index] = scene.assign[index].inside->blocks;
      continue;
    }
    std::vector<bool> chosen(scene.block.size(), false);
    for (const std::string& pattern : scene.assign[index].blocks) (void)choose_pieces(scene, pattern, chosen);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      if (chosen[k]) pieces[index].push_back(k);
  }
  return pieces;
}

}  // namespace ashlar
