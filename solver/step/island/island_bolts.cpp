#include "solver/step/island/island_bolts.hpp"

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"
#include "solver/step/island/island.hpp"

namespace ashlar {
namespace {

const Eigen::VectorXd no_change;

}  // namespace

IslandBolts::IslandBolts(const Island& island, std::vector<BodyStep>& bodies, const std::vector<int>& place)
    : bodies_(&bodies), bolts_(island.bolts), island_bodies_(island.bodies) {
  for (const StepBolt* bolt : bolts_) {
    std::vector<int>& places = places_.emplace_back();
    for (const int block : bolt->blocks()) places.push_back(place[at(block)]);
  }
}

const StepBolt& IslandBolts::bolt(std::size_t k) const {
  const auto followed = followed_.find(k);
  return followed != followed_.end() ? followed->second : *bolts_[k];
}

std::vector<const Eigen::VectorXd*> IslandBolts::changes(std::size_t k) const {
  std::vector<const Eigen::VectorXd*> result;
  for (const int block : bolts_[k]->blocks()) result.push_back(&(*bodies_)[at(block)].change);
  return result;
}

std::vector<const Eigen::VectorXd*> IslandBolts::changes(
    std::size_t k, const std::vector<Eigen::VectorXd>& of_bodies) const {
  std::vector<const Eigen::VectorXd*> result;
  for (const int place : places_[k]) result.push_back(place < 0 ? &no_change : &of_bodies[at(place)]);
  return result;
}

void IslandBolts::respond(bool averaged, int threads) {
  responses_.resize(size());
  parallel_for(threads, size(), [&](std::size_t k) { bolt(k).respond(changes(k), averaged, responses_[k]); });
}

bool IslandBolts::follow(double tolerance) {
  bool any = false;
  const auto position = [&](double share) {
    return [this, share](int block) -> Eigen::MatrixX3d {
      const BodyStep& body = (*bodies_)[at(block)];
      if (body.model->fixed()) return body.state->position;
      return body.state->position + share * body.motion();
    };
  };
  for (std::size_t k = 0; k < size(); ++k) {
    if (!bolt(k).needs_following(position(0.5), position(1.0), changes(k), tolerance)) continue;
    StepBolt moved = *bolts_[k];
    moved.follow(position(0.5), position(1.0), changes(k));
    followed_.insert_or_assign(k, std::move(moved));
    any = true;
  }
  return any;
}

void IslandBolts::add_tangents(BlockMatrix& matrix) const {
  const auto rows_of = [&](std::size_t k, std::size_t n) -> Eigen::MatrixXd {
    const BodyStep& body = (*bodies_)[at(island_bodies_[at(places_[k][n])])];
    return body.model->rigid() ? Eigen::MatrixXd(bolt(k).rows(n) * body.fields) : bolt(k).rows(n);
  };
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    for (std::size_t n = 0; n < places_[k].size(); ++n) {
      if (places_[k][n] < 0) continue;
      const Eigen::MatrixXd rows = rows_of(k, n);
      const Eigen::MatrixXd weighted = rows.transpose() * responses_[k].tangent;
      matrix.add_diagonal(places_[k][n], weighted * rows);
      for (std::size_t m = n + 1; m < places_[k].size(); ++m)
        if (places_[k][m] >= 0) matrix.add_pair(places_[k][n], places_[k][m], weighted * rows_of(k, m));
    }
  }
}

void IslandBolts::add_products(const std::vector<Eigen::VectorXd>& changes_of_bodies,
                               std::vector<Eigen::VectorXd>& forces) const {
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    const Eigen::VectorXd force = responses_[k].tangent * bolt(k).motion(changes(k, changes_of_bodies));
    for (std::size_t n = 0; n < places_[k].size(); ++n)
      if (places_[k][n] >= 0) forces[at(places_[k][n])] += bolt(k).rows(n).transpose() * force;
  }
}

}  // namespace ashlar
