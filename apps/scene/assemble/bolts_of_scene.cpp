#include "apps/scene/assemble/bolts_of_scene.hpp"

#include "apps/scene/expand/support_lines.hpp"
#include "geometry/index.hpp"

namespace ashlar {

std::vector<Bolt> bolts_of(const LoadedScene& loaded) {
  std::vector<const Polyhedron*> solids;
  for (const Polyhedron& solid : loaded.solids) solids.push_back(&solid);
  std::vector<Bolt> bolts;
  for (SupportLine& line : support_lines(loaded.scene, solids)) {
    std::vector<bool> present;
    for (const BoltSpan& span : line.spans)
      present.push_back(loaded.scene.absent.empty() || !loaded.scene.absent[at(span.block)]);
    bolts.push_back({std::move(line.name),
                     BoltChain(line.law, BoltShape(line.law, line.from, line.to, line.spans, line.thickness),
                               std::move(present)),
                     line.installed});
  }
  return bolts;
}

}  // namespace ashlar
