#include "apps/scene/expand/scene_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "apps/scene/expand/stage_supports.hpp"
#include "apps/scene/model/block_names.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "mechanics/supports/loads.hpp"

namespace ashlar {
namespace {

/// True if stages can begin or end with the states of an analysis.
bool is_run_of_stages(SceneAnalysis::Type type) {
  return type == SceneAnalysis::Type::dynamic || type == SceneAnalysis::Type::statics;
}

std::string key_of(std::size_t stage, const std::string& key) {
  return fmt::format("stage.{}.{}", stage, key);
}

/// Makes a load constant after its history has ended.
void stay(SceneLoad& load, double end_time) {
  History history;
  for (const auto& [time, factor] : load.history) {
    history.times.push_back(time);
    history.values.push_back(factor);
  }
  load.vector *= history.at(end_time);
  load.history.clear();
  load.file.reset();
}

/// Fixes a support after its history has ended.
void stay(SceneFix& fix) {
  fix.history.clear();
  fix.file.reset();
}

/// Waves act in the first dynamic stage.
void end_waves(Scene& scene) {
  for (SceneBoundary& boundary : scene.boundary) {
    boundary.wave.clear();
    boundary.file.reset();
  }
}

/// The scenes of all stages, each derived from the one before.
class StageScenes {
 public:
  /// @param whole has stages and must outlive this
  explicit StageScenes(const ExpandedScene& whole)
      : whole_(whole), scene_(whole), was_there_(whole.block.size(), false) {
    scene_.absent = held_back(whole);
    add_later_supports(whole, scene_);
  }

  /// Advances to the next stage, initially to the first one.
  void advance() {
    if (stage_) end_histories(*stage_);
    stage_ = stage_ ? *stage_ + 1 : 0;
    add_changes(*stage_);
    change_water(*stage_);
    scene_.analysis = whole_.stage[*stage_].analysis;
    // The initial state applies to the first stage only.
    if (*stage_ > 0) scene_.analysis.initial_state = SceneAnalysis::InitialState::as_placed;
    change_presence(whole_, whole_.stage[*stage_], scene_.absent);
    change_supports(whole_, *stage_, scene_);
    name_places(*stage_);
  }
  [[nodiscard]] const ExpandedScene& scene() const { return scene_; }
  [[nodiscard]] ExpandedScene&& take() { return std::move(scene_); }

 private:
  /// Histories of [[block]] end with the first stage of the block; those of a stage end with it.
  void end_histories(std::size_t ended) {
    const double end_time = whole_.stage[ended].analysis.end_time;
    if (!is_static(whole_.stage[ended].analysis)) end_waves(scene_);
    for (std::size_t k = 0; k < scene_.block.size(); ++k) {
      if (was_there_[k] || scene_.absent[k]) continue;
      was_there_[k] = true;
      SceneBlock& block = scene_.block[k];
      // Entries of stages follow the block's own.
      for (std::size_t n = 0; n < whole_.block[k].fix.size(); ++n) stay(block.fix[n]);
      for (std::size_t n = 0; n < whole_.block[k].load.size(); ++n) stay(block.load[n], end_time);
    }
    for (const auto& [k, n] : added_fixes_) stay(scene_.block[k].fix[n]);
    for (const auto& [k, n] : added_loads_) stay(scene_.block[k].load[n], end_time);
    added_fixes_.clear();
    added_loads_.clear();
  }

  /// Index of a block, and of an entry in it.
  using Added = std::vector<std::pair<std::size_t, std::size_t>>;

  void add_changes(std::size_t s) {
    const SceneStage& given = whole_.stage[s];
    const auto add = [&](const char* list, auto SceneBlock::*member, const auto& entries, const auto& what,
                         Added& added) {
      for (std::size_t j = 0; j < entries.size(); ++j) {
        for (std::size_t k = 0; k < scene_.block.size(); ++k) {
          if (!means_block(whole_, entries[j].blocks, k)) continue;
          auto& of_block = scene_.block[k].*member;
          scene_.places.record_origin(fmt::format("block.{}.{}.{}", k, list, of_block.size()),
                                      key_of(s, fmt::format("{}.{}", list, j)));
          added.emplace_back(k, of_block.size());
          of_block.push_back(what(entries[j]));
        }
      }
    };
    add(
        "fix", &SceneBlock::fix, given.fix, [](const SceneStage::Fix& entry) { return entry.fix; },
        added_fixes_);
    add(
        "load", &SceneBlock::load, given.load, [](const SceneStage::Load& entry) { return entry.load; },
        added_loads_);
    for (std::size_t j = 0; j < given.joint.size(); ++j) {
      scene_.places.record_origin(fmt::format("joint.{}", scene_.joint.size()),
                                  key_of(s, fmt::format("joint.{}", j)));
      scene_.joint.push_back(given.joint[j]);
    }
    for (std::size_t j = 0; j < given.material.size(); ++j) {
      for (std::size_t k = 0; k < scene_.material.size(); ++k) {
        if (scene_.material[k].name != given.material[j].name) continue;
        scene_.material[k] = given.material[j];
        scene_.places.record_origin(fmt::format("material.{}", k), key_of(s, fmt::format("material.{}", j)));
      }
    }
  }

  void change_water(std::size_t s) {
    const std::vector<SceneWater>& given = whole_.stage[s].water;
    for (std::size_t j = 0; j < given.size(); ++j) {
      const auto same = std::find_if(scene_.water.begin(), scene_.water.end(),
                                     [&](const SceneWater& water) { return water.name == given[j].name; });
      const auto index = static_cast<std::size_t>(same - scene_.water.begin());
      if (same == scene_.water.end())
        scene_.water.push_back(given[j]);
      else
        *same = given[j];
      scene_.places.record_origin(fmt::format("water.{}", index), key_of(s, fmt::format("water.{}", j)));
    }
  }

  /// Keys of the stage's analysis refer to their place there, no longer to those of the stage before.
  void name_places(std::size_t s) {
    for (const std::string& path : named_) scene_.places.remove_origin(path);
    named_.clear();
    const std::string start = key_of(s, "analysis.");
    const auto& given = whole_.places.all();
    for (auto place = given.lower_bound(start); place != given.end() && place->first.starts_with(start);
         ++place) {
      named_.push_back("analysis." + place->first.substr(start.size()));
      scene_.places.record_origin(named_.back(), place->first);
    }
  }

  const ExpandedScene& whole_;
  ExpandedScene scene_;
  std::optional<std::size_t> stage_;  ///< stage of scene_; empty: before the first
  std::vector<bool> was_there_;       ///< by block, true if present in a stage that has ended
  Added added_fixes_, added_loads_;   ///< by the present stage
  std::vector<std::string> named_;    ///< keys of the present stage's analysis
};

class StageCheck {
 public:
  StageCheck(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
    for (const SceneBlock& block : scene.block) names_.push_back(block.name);
  }

  void run() {
    check_names();
    std::vector<bool> absent = held_back(scene_);
    for (std::size_t s = 0; s < scene_.stage.size(); ++s) {
      check_presence(s, absent);
      change_presence(scene_, scene_.stage[s], absent);
      check_changes(s);
      check_analysis(s);
    }
  }

 private:
  void error(std::size_t stage, const std::string& key, std::string message) {
    diagnostics_.error(scene_.places.value(key_of(stage, key)), std::move(message));
  }

  void check_names() {
    std::set<std::string> names;
    for (std::size_t s = 0; s < scene_.stage.size(); ++s) {
      const std::string& name = scene_.stage[s].name;
      if (!name.empty() && !names.insert(name).second)
        error(s, "name", fmt::format("stage named twice (\"{}\"), every stage needs its own name", name));
    }
  }

  /// @param key of the list. @return the matching blocks; patterns without one are reported
  std::vector<std::size_t> blocks_of(std::size_t stage, const std::string& key,
                                     const std::vector<std::string>& patterns) {
    std::set<std::size_t> found;
    for (const std::string& pattern : patterns) {
      bool any = false;
      for (std::size_t k = 0; k < names_.size(); ++k) {
        if (!ashlar::means_block(scene_, pattern, k)) continue;
        any = true;
        found.insert(k);
      }
      if (!any)
        error(
            stage, key,
            fmt::format("stage names no block (\"{}\"), {}the name of a [[block]] or a glob that matches one "
                        "is needed",
                        pattern, guess_block(pattern, names_)));
    }
    return {found.begin(), found.end()};
  }

  /// @param absent before the stage
  void check_presence(std::size_t s, const std::vector<bool>& absent) {
    const SceneStage& stage = scene_.stage[s];
    const auto check = [&](const char* key, const std::vector<std::string>& patterns, bool needs_absent,
                           const char* words) {
      const std::vector<std::size_t> blocks = blocks_of(s, key, patterns);
      const auto wrong = std::find_if(blocks.begin(), blocks.end(),
                                      [&](std::size_t k) { return absent[k] != needs_absent; });
      if (wrong != blocks.end()) error(s, key, fmt::format("block \"{}\" {}", names_[*wrong], words));
      return blocks;
    };
    const auto removed = check("remove", stage.remove, false,
                               "is absent before this stage (remove); name a block of the stage before");
    const auto added =
        check("add", stage.add, true,
              "is present before this stage (add); name a block that is added later or was removed");
    std::vector<std::size_t> both;
    std::set_intersection(removed.begin(), removed.end(), added.begin(), added.end(),
                          std::back_inserter(both));
    if (!both.empty())
      error(s, "add",
            fmt::format("block \"{}\" is removed and added in one stage (add); name it in one of both lists",
                        names_[both.front()]));
  }

  void check_changes(std::size_t s) {
    const SceneStage& stage = scene_.stage[s];
    const auto check_moving = [&](const std::string& key, const std::vector<std::string>& patterns) {
      for (const std::size_t k : blocks_of(s, key + ".blocks", patterns)) {
        if (!scene_.block[k].fixed) continue;
        error(s, key + ".blocks",
              fmt::format("motion of a fixed block ({}), a block with fixed = true takes no fix or load",
                          names_[k]));
        return;
      }
    };
    for (std::size_t j = 0; j < stage.fix.size(); ++j)
      check_moving(fmt::format("fix.{}", j), stage.fix[j].blocks);
    for (std::size_t j = 0; j < stage.load.size(); ++j)
      check_moving(fmt::format("load.{}", j), stage.load[j].blocks);
    for (std::size_t j = 0; j < stage.joint.size(); ++j) {
      if (stage.joint[j].tied.value_or(false) || stage.joint[j].tie)
        error(s, fmt::format("joint.{}.tied", j),
              "blocks cannot be tied in a stage (true or a strength); tie them by a [[joint]] of the scene");
    }
    std::vector<std::string> materials;
    for (const SceneMaterial& material : scene_.material) materials.push_back(material.name);
    for (std::size_t j = 0; j < stage.material.size(); ++j) {
      const std::string& name = stage.material[j].name;
      if (!name.empty() && std::find(materials.begin(), materials.end(), name) == materials.end())
        error(s, fmt::format("material.{}.name", j),
              fmt::format(
                  "unknown material of a stage (\"{}\"), {}the name of the [[material]] that it replaces "
                  "is needed",
                  name, guess(name, materials, "\"")));
    }
  }

  void check_analysis(std::size_t s) {
    const SceneAnalysis& analysis = scene_.stage[s].analysis;
    const SceneAnalysis& first = scene_.stage.front().analysis;
    if (!is_run_of_stages(analysis.type))
      error(s, "analysis.type",
            fmt::format("limit analysis in a stage (\"{}\"), \"static\" or \"dynamic\" is needed",
                        name_of(analysis_type_names, analysis.type)));
    if (analysis.formulation != first.formulation || analysis.paper != first.paper)
      error(s, "analysis.formulation",
            fmt::format("formulation changes between stages (\"{}\"), that of the first stage is needed",
                        formulation_name(analysis)));
    if (s > 0 && scene_.places.contains(key_of(s, "analysis.initial_state")))
      error(s, "analysis.initial_state",
            fmt::format(
                "initial_state of a later stage (\"{}\"), which starts from the stage before; leave it out",
                name_of(initial_state_names, analysis.initial_state)));
  }

  const Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
};

}  // namespace

bool means_block(const Scene& scene, const std::string& pattern, std::size_t block) {
  if (pattern_names_block(scene, pattern, block)) return true;
  return scene.rock != nullptr && pattern_matches(pattern, scene.uncut[scene.rock->origin[block].uncut].name);
}

bool means_block(const Scene& scene, const std::vector<std::string>& patterns, std::size_t block) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return ashlar::means_block(scene, pattern, block); });
}

std::vector<bool> held_back(const Scene& scene) {
  std::vector<bool> absent(scene.block.size(), false);
  for (std::size_t k = 0; k < absent.size(); ++k) {
    for (const SceneStage& stage : scene.stage) {
      if (!stage.remove_inside && means_block(scene, stage.remove, k)) break;
      absent[k] = !stage.add_inside && means_block(scene, stage.add, k);
      if (absent[k]) break;
    }
  }
  return absent;
}

void change_presence(const Scene& scene, const SceneStage& stage, std::vector<bool>& absent) {
  for (std::size_t k = 0; k < absent.size(); ++k) {
    if (means_block(scene, stage.remove, k)) absent[k] = true;
    if (means_block(scene, stage.add, k)) absent[k] = false;
  }
}

ExpandedScene scene_of_stage(const ExpandedScene& whole, std::size_t stage) {
  if (whole.stage.empty()) return whole;
  StageScenes scenes(whole);
  for (std::size_t s = 0; s <= stage; ++s) scenes.advance();
  return scenes.take();
}

void for_each_stage(const ExpandedScene& whole, const std::function<void(const ExpandedScene&)>& look) {
  if (whole.stage.empty()) {
    look(whole);
    return;
  }
  StageScenes scenes(whole);
  for (std::size_t s = 0; s < whole.stage.size(); ++s) {
    scenes.advance();
    look(scenes.scene());
  }
}

std::size_t stage_count(const Scene& scene) {
  return std::max<std::size_t>(scene.stage.size(), 1);
}

void check_stages(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.stage.empty()) StageCheck(scene, diagnostics).run();
}

}  // namespace ashlar
