#include "solver/shared/shared_island.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/shared/shared_island_sums.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/step/island/bolts_of_run.hpp"
#include "solver/step/island/island_links.hpp"

namespace ashlar {
namespace {

/// Rigid motions of a body in its equations, (freedom, 6).
Eigen::MatrixXd rigid_motions(const BodyStep& body) {
  if (body.model->rigid()) return Eigen::MatrixXd::Identity(rigid_freedom, rigid_freedom);
  const Eigen::MatrixXd fields = rigid_fields(body.state->position);
  Eigen::MatrixXd motions(body.model->unknowns(), fields.cols());
  for (Eigen::Index k = 0; k < fields.cols(); ++k)
    motions.col(k) =
        body.model->space().restrict(Eigen::MatrixX3d(fields.col(k).reshaped(fields.rows() / 3, 3)));
  return motions;
}

/// Solves the rows of own bodies with those of the other ranks, and gets the solution of ghosts.
class SharedIslandSolver final : public LinearSolver {
 public:
  SharedIslandSolver(RankSolver& solver, const Island& island, const std::vector<BodyStep>& bodies,
                     std::vector<int> starts, const IslandSums& sums)
      : solver_(solver), island_(island), bodies_(bodies), starts_(std::move(starts)), sums_(sums) {}

  [[nodiscard]] FactorStatus factorize(const SymmetricMatrix& matrix) override {
    return solver_.factorize(rows_of(matrix));
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined) override {
    Eigen::VectorXd own(own_size());
    Eigen::Index next = 0;
    const auto each_own = [&](const auto& visit) {
      next = 0;
      for (std::size_t k = 0; k < island_.bodies.size(); ++k) {
        if (!sums_.owns_body(k)) continue;
        const int size = starts_[k + 1] - starts_[k];
        visit(starts_[k], next, size);
        next += size;
      }
    };
    each_own([&](Eigen::Index start, Eigen::Index place, Eigen::Index size) {
      own.segment(place, size) = right_side.segment(start, size);
    });
    own = solver_.solve(own, refined);
    Eigen::VectorXd found = Eigen::VectorXd::Zero(right_side.size());
    each_own([&](Eigen::Index start, Eigen::Index place, Eigen::Index size) {
      found.segment(start, size) = own.segment(place, size);
    });
    sums_.update_neighbours(found);
    return found;
  }
  [[nodiscard]] const FactorCounts& counts() const override { return solver_.counts(); }
  void drop_counts() override {}
  [[nodiscard]] double cost_in_solves() const override { return solver_.cost_in_solves(); }
  /// None: the rows went to the solver.
  [[nodiscard]] const SymmetricMatrix& matrix() const override { return none_; }

 private:
  [[nodiscard]] Eigen::Index own_size() const {
    Eigen::Index size = 0;
    for (std::size_t k = 0; k < island_.bodies.size(); ++k)
      if (sums_.owns_body(k)) size += starts_[k + 1] - starts_[k];
    return size;
  }

  /// Blocks of the rows of own bodies, by body and column. @param matrix of dense blocks
  [[nodiscard]] std::vector<std::map<int, Eigen::MatrixXd>> own_blocks(const SymmetricMatrix& matrix) const {
    std::vector<std::map<int, Eigen::MatrixXd>> blocks(island_.bodies.size());
    const auto block = [&](int row, int column) -> Eigen::MatrixXd& {
      const auto [place, is_new] = blocks[at(row)].try_emplace(column);
      if (is_new)
        place->second.setZero(starts_[at(row) + 1] - starts_[at(row)],
                              starts_[at(column) + 1] - starts_[at(column)]);
      return place->second;
    };
    const auto body_of = [&](int equation) {
      return static_cast<int>(std::upper_bound(starts_.begin(), starts_.end(), equation) - starts_.begin()) -
             1;
    };
    for (int column = 0; column < matrix.size; ++column) {
      const int j = body_of(column);
      const int in_body = column - starts_[at(j)];
      for (int k = matrix.column_start[at(column)], size = 0; k < matrix.column_start[at(column) + 1];
           k += size) {
        // The rows of one body follow each other.
        const int i = body_of(matrix.rows[at(k)]);
        const int first = matrix.rows[at(k)] - starts_[at(i)];
        size = starts_[at(i) + 1] - starts_[at(i)] - first;
        const Eigen::Map<const Eigen::VectorXd> values(matrix.values.data() + k, size);
        if (sums_.owns_body(at(i))) block(i, j).col(in_body).segment(first, size) = values;
        if (sums_.owns_body(at(j))) block(j, i).row(in_body).segment(first, size) = values.transpose();
      }
    }
    return blocks;
  }

  [[nodiscard]] std::vector<BodyRows> rows_of(const SymmetricMatrix& matrix) const {
    std::vector<std::map<int, Eigen::MatrixXd>> blocks = own_blocks(matrix);
    std::vector<BodyRows> rows;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      // Moving supports may leave a body no unknowns.
      if (!sums_.owns_body(k) || starts_[k] == starts_[k + 1]) continue;
      BodyRows& of_body = rows.emplace_back();
      of_body.body = island_.bodies[k];
      for (auto& [column, values] : blocks[k]) {
        of_body.columns.push_back(island_.bodies[at(column)]);
        of_body.blocks.push_back(std::move(values));
      }
      of_body.rigid = rigid_motions(bodies_[at(of_body.body)]);
    }
    return rows;
  }

  RankSolver& solver_;
  const Island& island_;
  const std::vector<BodyStep>& bodies_;
  std::vector<int> starts_;
  const IslandSums& sums_;
  SymmetricMatrix none_;
};

}  // namespace

int join_shared_islands(const BlockSystem& system, std::vector<Island>& islands) {
  const BlockShare& share = share_of(system);
  Island joined;
  std::vector<Island> others;
  for (Island& island : islands) {
    const auto ghosts = std::count_if(island.bodies.begin(), island.bodies.end(),
                                      [&](int block) { return !share.owns(block); });
    if (ghosts == 0) {
      others.push_back(std::move(island));
    } else if (ghosts < static_cast<std::ptrdiff_t>(island.bodies.size())) {
      joined.bodies.insert(joined.bodies.end(), island.bodies.begin(), island.bodies.end());
      joined.pairs.insert(joined.pairs.end(), island.pairs.begin(), island.pairs.end());
      joined.bolts.insert(joined.bolts.end(), island.bolts.begin(), island.bolts.end());
    }
  }
  islands = std::move(others);
  if (!any_rank(share.ranks(), !joined.bodies.empty())) return -1;
  std::sort(joined.bodies.begin(), joined.bodies.end());
  std::sort(joined.pairs.begin(), joined.pairs.end());
  std::sort(joined.bolts.begin(), joined.bolts.end(),
            [](const StepBolt* x, const StepBolt* y) { return x->index() < y->index(); });
  islands.push_back(std::move(joined));
  return static_cast<int>(islands.size()) - 1;
}

std::map<int, int> first_blocks(const BlockSystem& system, const Island& island,
                                const std::vector<ContactPair>& pairs) {
  const BlockShare& share = share_of(system);
  UnionFind touching(at(system.count()));
  for (const int index : island.pairs) {
    const ContactPair& pair = pairs[at(index)];
    if (system.moving()[at(pair.a())] && system.moving()[at(pair.b())]) touching.unite(pair.a(), pair.b());
  }
  for (const StepBolt* bolt : island.bolts)
    for (const int block : bolt->blocks())
      if (system.moving()[at(block)]) touching.unite(moving_block(system, *bolt), block);
  std::map<int, Eigen::VectorXd> lowest;  // by root
  for (const int block : island.bodies)
    lowest.try_emplace(touching.find(block), Eigen::VectorXd::Constant(1, block));
  for (bool changed = true; changed;) {
    changed = false;
    share.to_ghosts(
        [&](int block) -> const Eigen::VectorXd* {
          const auto found = lowest.find(touching.find(block));
          return found == lowest.end() ? nullptr : &found->second;
        },
        [&](int block, const Eigen::VectorXd& of_owner) {
          const auto found = lowest.find(touching.find(block));
          if (found == lowest.end() || !(of_owner[0] < found->second[0])) return;
          found->second = of_owner;
          changed = true;
        });
    changed = any_rank(share.ranks(), changed);
  }
  std::map<int, int> first;
  for (const int block : island.bodies)
    first.emplace(block, static_cast<int>(lowest.at(touching.find(block))[0]));
  return first;
}

SharedIslandSystem::SharedIslandSystem(const BlockSystem& system, const Island& island,
                                       const std::vector<BodyStep>& bodies,
                                       const std::vector<ContactPair>& pairs, SharedFactor* kept)
    : kept_(kept) {
  const BlockShare& share = share_of(system);
  std::map<int, int> place;
  std::vector<int> sizes, starts = {0};
  SharedFactor own;
  for (const int body : island.bodies) {
    place.emplace(body, static_cast<int>(place.size()));
    sizes.push_back(bodies[at(body)].model->freedom());
    starts.push_back(starts.back() + sizes.back());
    if (!share.owns(body)) continue;
    own.bodies.push_back(body);
    own.sizes.push_back(sizes.back());
  }
  std::vector<bool> owns_pair;
  for (const int index : island.pairs)
    owns_pair.push_back(system.owns_pair(pairs[at(index)].a(), pairs[at(index)].b()));
  const std::vector<std::array<int, 2>> links = links_of(island, pairs, place);
  sums_ = std::make_unique<const SharedIslandSums>(share, island.bodies, starts, std::move(owns_pair));
  RankSolver& solver = kept_ == nullptr ? share.solver() : share.step_solver();
  solver_ = std::make_unique<IslandSolvers::Entry>(
      IslandSolvers::Entry{sizes, links, BlockMatrix(sizes, links),
                           std::make_unique<SharedIslandSolver>(solver, island, bodies, starts, *sums_)});
  if (kept_ == nullptr) return;
  const bool others = own.bodies != kept_->bodies || own.sizes != kept_->sizes;
  if (!any_rank(share.ranks(), others)) solver_->inertia = kept_->inertia;
  *kept_ = std::move(own);
}

SharedIslandSystem::~SharedIslandSystem() {
  if (kept_ != nullptr) kept_->inertia = solver_->inertia;
}

}  // namespace ashlar
