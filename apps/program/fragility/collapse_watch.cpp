#include "apps/program/fragility/collapse_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/scene/check/water_checks.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Degrees between e and R e.
double tilt_of(const Vector3& turn, const Vector3& up) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double angle = turn.norm();
  if (!(angle > 0.0)) return 0.0;
  const double along = turn.dot(up) / angle;
  const double cosine = correctly_rounded::cos_of_degrees(angle);
  return correctly_rounded::acos(std::clamp(cosine + (1.0 - cosine) * along * along, -1.0, 1.0)) / degree;
}

}  // namespace

CollapseWatch::CollapseWatch(const Scene& scene, const Simulation& simulation) {
  double largest = 0.0;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& model = simulation.blocks()[k];
    if (model.fixed() || model.driven() || model.incremental() != nullptr) continue;
    Measure& block = blocks_.emplace_back();
    block.name = model.name();
    block.kind = Measure::Kind::block;
    block.block = static_cast<int>(k);
    block.point = model.basis().centroid();
    block.up = up_of(scene);
    largest = std::max(largest, model.size());
  }
  constexpr double times = 5.0;
  const double gravity = simulation.system().settings().largest_gravity();
  rest_duration_ =
      gravity > 0.0 ? times * std::sqrt(largest / gravity) : std::numeric_limits<double>::infinity();
}

std::optional<Collapse> CollapseWatch::collapse_in(const Simulation& simulation) const {
  FallRecord falls;
  falls.note(simulation);
  if (!falls.falls.empty())
    return Collapse{simulation.time(), simulation.blocks()[at(falls.falls.front().block)].name(), "fallen"};
  for (const Measure& block : blocks_) {
    if (!simulation.system().present(block.block)) continue;
    if (tilt_of(measured_turn(simulation, block), block.up) > overturned_tilt)
      return Collapse{simulation.time(), block.name, "overturned"};
  }
  return std::nullopt;
}

}  // namespace ashlar
