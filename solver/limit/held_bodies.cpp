#include "solver/limit/held_bodies.hpp"

#include <array>
#include <map>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// A point with its two sides exchanged: the fixed body of a pair is the second one.
RigidPoint exchanged(RigidPoint point) {
  std::swap(point.blocks[0], point.blocks[1]);
  std::swap(point.bodies[0], point.bodies[1]);
  point.frame.topRows<2>() *= -1.0;
  return point;
}

}  // namespace

HeldModel with_held_bodies(const RigidModel& model, const std::vector<bool>& free,
                           const std::vector<bool>& reduced) {
  HeldModel held;
  held.model.units = model.units;
  held.model.has_residual_strength = model.has_residual_strength;
  std::vector<int> number(model.bodies.size(), -1);
  held.model.body_of.assign(model.body_of.size(), -1);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!free[b]) continue;
    number[b] = static_cast<int>(held.model.bodies.size());
    held.model.bodies.push_back(model.bodies[b]);
    held.model.steady.push_back(model.steady[b]);
    held.model.multiplied.push_back(model.multiplied[b]);
    for (const int block : model.bodies[b].blocks) held.model.body_of[at(block)] = number[b];
  }
  const auto number_of = [&](int body) { return body < 0 ? -1 : number[at(body)]; };
  std::map<std::array<int, 2>, std::vector<std::pair<RigidPoint, bool>>> by_pair;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    RigidPoint point = model.points[k];
    point.bodies = {number_of(point.bodies[0]), number_of(point.bodies[1])};
    if (point.bodies[0] < 0 && point.bodies[1] < 0) continue;
    if (point.bodies[0] < 0) point = exchanged(std::move(point));
    const std::array<int, 2> key = point.bodies;
    by_pair[key].emplace_back(std::move(point), reduced[k]);
  }
  for (auto& [bodies, points] : by_pair) {
    const std::size_t begin = held.model.points.size();
    for (auto& [point, is_reduced] : points) {
      held.model.points.push_back(std::move(point));
      held.reduced.push_back(is_reduced);
    }
    held.model.pairs.push_back({bodies, begin, held.model.points.size()});
  }
  return held;
}

}  // namespace ashlar
