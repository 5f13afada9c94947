#include "apps/scene/expand/stage_supports.hpp"

#include <fmt/format.h>

namespace ashlar {
namespace {

template <class Entry>
void add(const std::vector<Entry>& given, std::size_t stage, const char* list, std::vector<Entry>& all,
         ScenePlaces& places) {
  for (std::size_t j = 0; j < given.size(); ++j) {
    places.record_origin(fmt::format("{}.{}", list, all.size()),
                         fmt::format("stage.{}.{}.{}", stage, list, j));
    all.push_back(given[j]);
    all.back().installed = false;
  }
}

/// Notes what a stage removes of the entries that are installed.
template <class Entry>
void remove(const std::vector<std::string>& names, std::vector<Entry>& all) {
  for (Entry& entry : all)
    if (entry.installed) entry.removed.insert(entry.removed.end(), names.begin(), names.end());
}

/// Installs the entries of a stage, which follow those of all earlier ones.
template <class Entry>
void install(const Scene& whole, std::size_t stage, const std::vector<Entry>& of_scene,
             std::vector<Entry> SceneStage::*member, std::vector<Entry>& all) {
  std::size_t first = of_scene.size();
  for (std::size_t s = 0; s < stage; ++s) first += (whole.stage[s].*member).size();
  for (std::size_t j = 0; j < (whole.stage[stage].*member).size(); ++j) all[first + j].installed = true;
}

}  // namespace

void add_later_supports(const Scene& whole, Scene& scene) {
  for (std::size_t s = 0; s < whole.stage.size(); ++s) {
    add(whole.stage[s].bolt, s, "bolt", scene.bolt, scene.places);
    add(whole.stage[s].prop, s, "prop", scene.prop, scene.places);
  }
}

void change_supports(const Scene& whole, std::size_t stage, Scene& scene) {
  remove(whole.stage[stage].remove_support, scene.bolt);
  remove(whole.stage[stage].remove_support, scene.prop);
  install(whole, stage, whole.bolt, &SceneStage::bolt, scene.bolt);
  install(whole, stage, whole.prop, &SceneStage::prop, scene.prop);
}

}  // namespace ashlar
