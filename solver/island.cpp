#include "solver/island.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Everything one open-close iteration looks at.
class IslandProblem {
 public:
  IslandProblem(const Island& island, std::vector<BodyStep>& bodies, const std::vector<ContactPair>& pairs,
                const TimeScheme& scheme, const SimulationSettings& settings)
      : island_(island), bodies_(bodies), pairs_(pairs), settings_(settings), scheme_(scheme) {
    for (const int body : island.bodies) place_[body] = static_cast<int>(place_.size());
  }

  [[nodiscard]] int place(int block) const {
    const auto found = place_.find(block);
    return found == place_.end() ? -1 : found->second;
  }

  void predict() {
    for (const int index : island_.bodies) {
      BodyStep& body = bodies_[at(index)];
      const double mass = scheme_.inertia * body.model->material().density;
      body.change = body.free_change;
      if (scheme_.from_rest) continue;
      body.change += scheme_.force_weight / mass * body.external_force;
    }
  }

  /// Where the elastic force of a body is taken.
  [[nodiscard]] Eigen::MatrixX3d taken_at(const BodyStep& body) const {
    return body.state->position + scheme_.end_share * body.model->space().expand(body.change);
  }

  /// Elastic and contact responses at the present changes.
  void respond() {
    for (const int index : island_.bodies) {
      BodyStep& body = bodies_[at(index)];
      body.elastic = body.model->elastic(taken_at(body));
    }
    responses_.clear();
    for (const int pair : island_.pairs) {
      const ContactPair& contact = pairs_[at(pair)];
      responses_.push_back(contact.respond(bodies_[at(contact.a())].change, bodies_[at(contact.b())].change,
                                           scheme_.mean_contacts));
    }
  }

  /// What is left of the equations of motion, by body; `settled` tells whether each is below its tolerance.
  Eigen::VectorXd residual(const BlockMatrix& matrix, bool& settled) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(matrix.matrix().size);
    std::vector<double> scale(island_.bodies.size(), 0.0);
    const auto add = [&](int body, const Eigen::VectorXd& force) {
      result.segment(matrix.offset(body), force.size()) += force;
      scale[at(body)] = std::max(scale[at(body)], force.norm());
    };
    for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
      const BodyStep& body = bodies_[at(island_.bodies[k])];
      const int place = static_cast<int>(k);
      const double density = body.model->material().density;
      add(place, scheme_.force_weight * body.external_force);
      add(place, -scheme_.force_weight * body.model->space().restrict(body.elastic.force));
      add(place, -density * scheme_.inertia * (body.change - body.free_change));
    }
    for (std::size_t k = 0; k < island_.pairs.size(); ++k) {
      const ContactPair& contact = pairs_[at(island_.pairs[k])];
      if (const int a = place(contact.a()); a >= 0) add(a, responses_[k].total_on_a());
      if (const int b = place(contact.b()); b >= 0) add(b, responses_[k].total_on_b());
    }
    settled = true;
    const double tolerance =
        scheme_.from_rest ? settings_.static_residual_tolerance : settings_.residual_tolerance;
    for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
      const BodyStep& body = bodies_[at(island_.bodies[k])];
      const double rounding = body.roundoff_force + 8.0 * std::numeric_limits<double>::epsilon() *
                                                        body.model->material().density * scheme_.inertia *
                                                        (body.change.norm() + body.free_change.norm());
      const auto size = static_cast<Eigen::Index>(body.change.size());
      const double left = result.segment(matrix.offset(static_cast<int>(k)), size).norm();
      bodies_[at(island_.bodies[k])].largest_force = scale[k];
      // Numbers that overflowed have settled nothing, and no comparison with them may say so.
      if (!(left <= tolerance * scale[k] + rounding) || !std::isfinite(scale[k])) settled = false;
    }
    return result;
  }

  /// @param positive leaves out what may make elastic tangents indefinite
  void assemble(BlockMatrix& matrix, bool positive) const {
    matrix.set_zero();
    for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
      const BodyStep& body = bodies_[at(island_.bodies[k])];
      matrix.add_diagonal(static_cast<int>(k),
                          scheme_.force_weight * scheme_.end_share *
                              body.model->tangent(taken_at(body), body.elastic, positive));
      matrix.add_to_diagonal(static_cast<int>(k), body.model->material().density * scheme_.inertia);
    }
    for (std::size_t k = 0; k < island_.pairs.size(); ++k) {
      const ContactPair& contact = pairs_[at(island_.pairs[k])];
      const ContactPair::Tangent tangent = contact.tangent(responses_[k]);
      const int a = place(contact.a());
      const int b = place(contact.b());
      if (a >= 0) matrix.add_diagonal(a, tangent.aa);
      if (b >= 0) matrix.add_diagonal(b, tangent.bb);
      if (a >= 0 && b >= 0) matrix.add_pair(a, b, tangent.ab);
    }
  }

  void apply(const BlockMatrix& matrix, const Eigen::VectorXd& change, double share) {
    for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
      BodyStep& body = bodies_[at(island_.bodies[k])];
      body.change += share * change.segment(matrix.offset(static_cast<int>(k)), body.change.size());
    }
  }

  [[nodiscard]] std::vector<PairResponse> take_responses() { return std::move(responses_); }

 private:
  const Island& island_;
  std::vector<BodyStep>& bodies_;
  const std::vector<ContactPair>& pairs_;
  const SimulationSettings& settings_;
  const TimeScheme& scheme_;
  std::map<int, int> place_;
  std::vector<PairResponse> responses_;
};

}  // namespace

IslandSolvers::Entry& IslandSolvers::find(const std::vector<int>& key, const std::vector<int>& sizes,
                                          const std::vector<std::array<int, 2>>& pairs) {
  auto found = entries_.find(key);
  if (found == entries_.end())
    found = entries_.emplace(key, Entry{BlockMatrix(sizes, pairs), SparseCholesky(), true}).first;
  found->second.used = true;
  return found->second;
}

void IslandSolvers::drop_unused() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.used) {
      entry->second.used = false;
      ++entry;
      continue;
    }
    dropped_ += entry->second.factor.counts();
    entry = entries_.erase(entry);
  }
}

FactorCounts IslandSolvers::counts() const {
  FactorCounts sum = dropped_;
  for (const auto& [key, entry] : entries_) sum += entry.factor.counts();
  return sum;
}

std::vector<Island> find_islands(const std::vector<bool>& moving, const std::vector<ContactPair>& pairs) {
  std::vector<int> parent(moving.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int k) {
    while (parent[at(k)] != k) k = parent[at(k)] = parent[at(parent[at(k)])];
    return k;
  };
  for (const ContactPair& pair : pairs) {
    if (!moving[at(pair.a())] || !moving[at(pair.b())]) continue;
    const int a = root(pair.a());
    const int b = root(pair.b());
    parent[at(std::max(a, b))] = std::min(a, b);
  }
  std::vector<Island> islands;
  std::map<int, std::size_t> island_of_root;
  for (int block = 0; block < static_cast<int>(moving.size()); ++block) {
    if (!moving[at(block)]) continue;
    const auto [place, added] = island_of_root.try_emplace(root(block), islands.size());
    if (added) islands.emplace_back();
    islands[place->second].bodies.push_back(block);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int block = moving[at(pairs[k].a())] ? pairs[k].a() : pairs[k].b();
    islands[island_of_root.at(root(block))].pairs.push_back(static_cast<int>(k));
  }
  return islands;
}

IslandResult solve_island(const Island& island, std::vector<BodyStep>& bodies,
                          const std::vector<ContactPair>& pairs, const TimeScheme& scheme,
                          const SimulationSettings& settings, IslandSolvers& solvers) {
  IslandProblem problem(island, bodies, pairs, scheme, settings);
  std::vector<int> sizes;
  std::vector<std::array<int, 2>> links;
  std::vector<int> key = island.bodies;
  for (const int body : island.bodies) sizes.push_back(bodies[at(body)].model->unknowns());
  for (const int pair : island.pairs) {
    const int a = problem.place(pairs[at(pair)].a());
    const int b = problem.place(pairs[at(pair)].b());
    if (a < 0 || b < 0) continue;
    links.push_back({a, b});
    key.insert(key.end(), {a, b});
  }
  IslandSolvers::Entry& solver = solvers.find(key, sizes, links);

  IslandResult result;
  problem.predict();
  problem.respond();
  for (result.iterations = 1; result.iterations <= settings.max_iterations; ++result.iterations) {
    bool settled = false;
    const Eigen::VectorXd right_side = problem.residual(solver.matrix, settled);
    // From rest, the first guess lacks no more than the last iteration's bound of rounding errors, which is
    // wide.
    if (settled && !(scheme.from_rest && result.iterations == 1)) {
      result.responses = problem.take_responses();
      return result;
    }
    problem.assemble(solver.matrix, false);
    FactorStatus factored = solver.factor.factorize(solver.matrix.matrix());
    if (factored == FactorStatus::not_positive_definite) {
      // Compressed St.-Venant-Kirchhoff blocks: a positive tangent still leads to where the forces balance.
      problem.assemble(solver.matrix, true);
      factored = solver.factor.factorize(solver.matrix.matrix());
    }
    if (factored != FactorStatus::success) {
      result.status = IslandStatus::not_positive_definite;
      return result;
    }
    const double share = result.iterations <= settings.undamped_iterations ? 1.0 : 0.5;
    problem.apply(solver.matrix, solver.factor.solve(right_side), share);
    problem.respond();
  }
  result.status = IslandStatus::not_settled;
  return result;
}

}  // namespace ashlar
