#include "apps/turned_supports.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mechanics/elasticity.hpp"

namespace ashlar {
namespace {

/// By which supports have turned a block until a time, rad.
double turn_until(const BlockModel& block, double time) {
  const Eigen::MatrixX3d place = block.basis().identity_map();
  const Eigen::MatrixX3d moved = place + block.prescribed_change(place, 0.0, time);
  const Eigen::Matrix3d gradient = moved.transpose() * block.parts()->mean_gradients;
  return Eigen::AngleAxisd(polar_decomposition(gradient).rotation).angle();
}

}  // namespace

void warn_of_turned_supports(const Scene& scene, const std::vector<BlockModel>& blocks,
                             Diagnostics& diagnostics) {
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental) return;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const BlockModel& block = blocks[k];
    if (!block.driven() || block.space().can_turn() || block.material().elasticity != Elasticity::linear)
      continue;
    double most = 0.0;
    std::size_t widest = 0;
    for (std::size_t n = 0; n < scene.block[k].fix.size(); ++n) {
      for (const SceneFix::Motion& motion : scene.block[k].fix[n].displacement_history) {
        const double turn = turn_until(block, std::min(motion.time, scene.analysis.end_time));
        if (turn > most) widest = n;
        most = std::max(most, turn);
      }
    }
    if (most <= largest_ordinary_turn) continue;
    diagnostics.warning(
        scene.places.value(fmt::format("block.{}.fix.{}.displacement_history", k, widest)),
        fmt::format("displacement_history turns block \"{}\" by {:.3g} rad, which strains it: elasticity "
                    "\"linear\" does not turn with a block that is held, \"st-venant-kirchhoff\" does",
                    block.name(), most));
  }
}

}  // namespace ashlar
