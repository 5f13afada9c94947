#include "apps/scene/keys/scene_keys.hpp"

#include "apps/scene/keys/fix_keys.hpp"
#include "apps/scene/keys/masonry_keys.hpp"
#include "apps/scene/keys/values.hpp"

namespace ashlar::keys {
namespace {

/// The keys of a scene that are no tables.
const Keys<Scene> top_table("", {text("title", &Scene::title, "shown in results")});

}  // namespace

const Keys<Scene>& top_keys() {
  return top_table;
}

const std::vector<SceneTable>& all_tables() {
  static const std::vector<SceneTable> tables = {{"", top_keys().table(), false},
                                                 {"analysis", analysis_keys().table(), false},
                                                 {"contact", contact_keys().table(), false},
                                                 {"joint", joint_keys().table(), true},
                                                 {"material", material_keys().table(), true},
                                                 {"block", block_keys().table(), true},
                                                 {"block.fix", fix_keys().table(), true},
                                                 {"block.load", load_keys().table(), true},
                                                 {"load", moving_load_keys().table(), true},
                                                 {"masonry", any_masonry_keys(), true},
                                                 {"assign", assign_keys().table(), true},
                                                 {"cut", cut_keys().table(), true},
                                                 {"water", water_keys().table(), true},
                                                 {"initial_stress", initial_stress_keys().table(), false},
                                                 {"boundary", boundary_keys().table(), true},
                                                 {"crack", cracking_keys().table(), true},
                                                 {"bolt", bolt_keys().table(), true},
                                                 {"prop", prop_keys().table(), true},
                                                 {"measure", measure_keys().table(), true},
                                                 {"output", output_keys().table(), false},
                                                 {"stage", stage_keys().table(), true}};
  return tables;
}

}  // namespace ashlar::keys
