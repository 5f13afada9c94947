#include "apps/results/json_text.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_reader.hpp"
#include "fuzz/targets.hpp"

namespace ashlar::fuzz {

bool scene(std::string_view bytes) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(bytes, "scene.toml", {}, diagnostics);
  for (const Diagnostic& fault : diagnostics.sorted())
    require(fault.place.line >= 1 && fault.place.column >= 1, "every fault has a place");
  if (!diagnostics.good()) return false;
  // The scene as used goes into summary.json, which `ashlar view` reads.
  (void)parse_json(json_text(to_json(scene)));
  return true;
}

}  // namespace ashlar::fuzz
