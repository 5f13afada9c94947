#include "solver/limit/cone_program.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"
#include "solver/limit/cone_iteration.hpp"

namespace ashlar {
namespace {

/// Below this number of points several threads take longer than one.
constexpr std::size_t points_worth_a_thread = 5000;

}  // namespace

ConeProgram::ConeProgram(std::vector<int> freedom, std::vector<ConePair> pairs, std::vector<ConePoint> points,
                         int threads)
    : freedom_(std::move(freedom)),
      loaded_(freedom_.size()),
      pairs_(std::move(pairs)),
      points_(std::move(points)),
      pairs_of_body_(freedom_.size()),
      threads_(points_.size() < points_worth_a_thread ? 1 : threads),
      matrix_(freedom_, moving_pairs()) {
  for (std::size_t n = 0; n < pairs_.size(); ++n)
    for (const std::size_t side : {0U, 1U})
      if (pairs_[n].bodies[side] >= 0) pairs_of_body_[at(pairs_[n].bodies[side])].push_back({n, side});
}

std::vector<std::array<int, 2>> ConeProgram::moving_pairs() const {
  std::vector<std::array<int, 2>> moving;
  for (const ConePair& pair : pairs_) {
    const auto [a, b] = std::minmax(pair.bodies[0], pair.bodies[1]);
    if (a >= 0) moving.push_back({a, b});
  }
  return moving;
}

ConeAnswer ConeProgram::solve(const ConeQuestion& question) {
  return ConeIteration(*this, question).run();
}

Eigen::Vector3d ConeProgram::relative(std::size_t pair, std::size_t point,
                                      const std::vector<BodyVelocity>& velocity) const {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  const auto [a, b] = pairs_[pair].bodies;
  if (a >= 0) y += points_[point].first * velocity[at(a)];
  if (b >= 0) y -= points_[point].second * velocity[at(b)];
  return y;
}

}  // namespace ashlar
