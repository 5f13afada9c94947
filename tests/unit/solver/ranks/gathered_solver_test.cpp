#include <map>

#include "solver/ranks/rank_solver.hpp"
#include "solver/ranks/thread_ranks.hpp"

namespace ashlar::gathered_solver_test {
namespace {

/// A chain of springs of one unknown, fixed at its start: stiffness 2 on the diagonal, 1 at the end, -1 beside.
std::vector<BodyRows> rows_of_chain(int bodies, const std::vector<int>& own) {
  std::vector<BodyRows> rows;
  for (const int body : own) {
    BodyRows row;
    row.body = body;
    for (int other = std::max(0, body - 1); other <= std::min(bodies - 1, body + 1); ++other) {
      row.columns.push_back(other);
      const double value = other != body ? -1.0 : body + 1 < bodies ? 2.0 : 1.0;
      row.blocks.push_back(Eigen::MatrixXd::Constant(1, 1, value));
    }
    rows.push_back(row);
  }
  return rows;
}

/// Under a force of 1 at the end, body k moves by k + 1.
TEST(GatheredSolver, SolvesAChainOnAnyNumberOfRanks) {
  constexpr int bodies = 7;
  for (const int count : {1, 2, 4}) {
    run_on_threads(count, [count](Ranks& ranks) {
      std::vector<int> own;  // the last of four ranks has none
      for (int body = 0; body < bodies; ++body)
        if (body % std::min(count, 3) == ranks.own()) own.push_back(body);
      const auto solver = make_gathered_solver(ranks);
      EXPECT_THROW((void)solver->solve({}), std::logic_error);
      for (int time = 0; time < 2; ++time) {
        ASSERT_EQ(solver->factorize(rows_of_chain(bodies, own)), FactorStatus::success);
        Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(own.size()));
        for (std::size_t k = 0; k < own.size(); ++k)
          force[static_cast<Eigen::Index>(k)] = own[k] == bodies - 1 ? 1.0 : 0.0;
        const Eigen::VectorXd moved = solver->solve(force);
        for (std::size_t k = 0; k < own.size(); ++k)
          EXPECT_NEAR(moved[static_cast<Eigen::Index>(k)], own[k] + 1.0, 1e-13);
      }
      EXPECT_EQ(solver->counts().analyses, 1u);
    });
  }
}

TEST(GatheredSolver, AllRanksHearThatAMatrixIsNotPositiveDefinite) {
  run_on_threads(2, [](Ranks& ranks) {
    BodyRows row;
    row.body = ranks.own();
    row.columns = {ranks.own()};
    row.blocks = {Eigen::MatrixXd::Constant(1, 1, ranks.own() == 0 ? 1.0 : -1.0)};
    EXPECT_EQ(make_gathered_solver(ranks)->factorize({row}), FactorStatus::not_positive_definite);
  });
}

}  // namespace
}  // namespace ashlar::gathered_solver_test
