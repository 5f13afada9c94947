#include "solver/ranks/mpi/petsc_solver.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "solver/ranks/row_numbering.hpp"
#include "tests/mpi/test_ranks.hpp"

namespace ashlar::petsc_solver_test {
namespace {

/// A system that each rank knows as a whole, dense.
struct DenseSystem {
  std::vector<int> sizes;   ///< by body
  std::vector<int> starts;  ///< by body, and the end
  Eigen::MatrixXd matrix;
  std::vector<Eigen::MatrixXd> rigid;  ///< by body, or empty

  [[nodiscard]] Eigen::MatrixXd block(int i, int j) const {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    return matrix.block(starts[a], starts[b], sizes[a], sizes[b]);
  }
  [[nodiscard]] int bodies() const { return static_cast<int>(sizes.size()); }
};

DenseSystem empty_system(std::vector<int> sizes) {
  DenseSystem system;
  system.sizes = std::move(sizes);
  system.starts = {0};
  for (const int size : system.sizes) system.starts.push_back(system.starts.back() + size);
  system.matrix = Eigen::MatrixXd::Zero(system.starts.back(), system.starts.back());
  return system;
}

/// A sum of random positive definite blocks of pairs, on a diagonal of 1. The same on all ranks.
DenseSystem random_system(std::vector<int> sizes, unsigned seed) {
  DenseSystem system = empty_system(std::move(sizes));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> values(-1.0, 1.0);
  system.matrix.setIdentity();
  for (int i = 0; i < system.bodies(); ++i) {
    for (int j = i + 1; j < system.bodies(); ++j) {
      if (random() % 4 != 0 && j != i + 1) continue;
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      Eigen::MatrixXd rows(4, system.matrix.cols());
      rows.setZero();
      for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < system.sizes[a]; ++c) rows(r, system.starts[a] + c) = values(random);
        for (int c = 0; c < system.sizes[b]; ++c) rows(r, system.starts[b] + c) = values(random);
      }
      system.matrix += rows.transpose() * rows;
    }
  }
  return system;
}

/// Rows of the bodies of a rank: those whose owner it is.
std::vector<BodyRows> rows_of(const DenseSystem& system, const std::vector<int>& owners, int rank) {
  std::vector<BodyRows> rows;
  for (int i = 0; i < system.bodies(); ++i) {
    if (owners[static_cast<std::size_t>(i)] != rank) continue;
    BodyRows& row = rows.emplace_back();
    row.body = 10 * i + 3;  // numbers of blocks have gaps
    for (int j = 0; j < system.bodies(); ++j) {
      if (i != j && system.block(i, j).isZero(0.0)) continue;
      row.columns.push_back(10 * j + 3);
      row.blocks.push_back(system.block(i, j));
    }
    if (!system.rigid.empty()) row.rigid = system.rigid[static_cast<std::size_t>(i)];
  }
  return rows;
}

Eigen::VectorXd own_part(const DenseSystem& system, const std::vector<int>& owners, int rank,
                         const Eigen::VectorXd& all) {
  std::vector<double> part;
  for (int i = 0; i < system.bodies(); ++i) {
    const auto a = static_cast<std::size_t>(i);
    if (owners[a] != rank) continue;
    for (int k = 0; k < system.sizes[a]; ++k) part.push_back(all[system.starts[a] + k]);
  }
  return Eigen::Map<Eigen::VectorXd>(part.data(), static_cast<Eigen::Index>(part.size()));
}

/// Bodies in turn: each rank has bodies between those of others.
std::vector<int> in_turn(int bodies, int ranks) {
  std::vector<int> owners(static_cast<std::size_t>(bodies));
  for (std::size_t k = 0; k < owners.size(); ++k) owners[k] = static_cast<int>(k) % ranks;
  return owners;
}

/// @return largest error relative to the largest unknown, of this rank
double error_of(RankSolver& solver, const DenseSystem& system, const std::vector<int>& owners) {
  const int own = test_ranks().own();
  const Eigen::VectorXd solution = Eigen::VectorXd::LinSpaced(system.matrix.rows(), -1.0, 2.0);
  const Eigen::VectorXd found = solver.solve(own_part(system, owners, own, system.matrix * solution));
  const Eigen::VectorXd expected = own_part(system, owners, own, solution);
  EXPECT_EQ(found.size(), expected.size());
  return expected.size() == 0 ? 0.0 : (found - expected).lpNorm<Eigen::Infinity>();
}

/// Sets an option of PETSc for a test.
class WithOption {
 public:
  WithOption(const char* name, const char* value) : name_(name) {
    PetscOptionsSetValue(nullptr, name, value);
  }
  ~WithOption() { PetscOptionsClearValue(nullptr, name_); }
  WithOption(const WithOption&) = delete;
  WithOption& operator=(const WithOption&) = delete;

 private:
  const char* name_;
};

// A random matrix has a condition of some 1e3: a refined solution has an error of some 1e-12.
constexpr double refined_error = 1e-11;

TEST(PetscSolver, SolvesBodiesOfOneSize) {
  const auto solver = make_petsc_solver(test_ranks());
  const DenseSystem system = random_system(std::vector<int>(14, 12), 1);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), refined_error);
}

TEST(PetscSolver, SolvesBodiesOfManySizes) {
  const auto solver = make_petsc_solver(test_ranks());
  const DenseSystem system = random_system({12, 6, 30, 12, 3, 60, 6, 12, 30}, 2);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), refined_error);
}

TEST(PetscSolver, RanksMayHaveNoBody) {
  for (const int rank : {0, test_ranks().count() - 1}) {
    const auto solver = make_petsc_solver(test_ranks());
    const DenseSystem system = random_system({12, 12, 12}, 3);
    const std::vector<int> owners(3, rank);
    EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
    EXPECT_LT(error_of(*solver, system, owners), refined_error);
  }
}

TEST(PetscSolver, TellsTheCostOfAFactorToAllRanks) {
  // A dense matrix of n unknowns: n^3 / 3 multiplications and additions for a factor of n^2 / 2 entries, of which a solution
  // takes two of each.
  const int n = 10 * 12;
  const DenseSystem system = random_system(std::vector<int>(10, 12), 6);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  const auto solver = make_petsc_solver(test_ranks());
  EXPECT_EQ(solver->cost_in_solves(), 0.0);
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  const double cost = solver->cost_in_solves();
  EXPECT_GT(cost, 0.0);
  EXPECT_LT(cost, n / 6.0 * 1.1);
  EXPECT_EQ(max_of_ranks(test_ranks(), cost), -max_of_ranks(test_ranks(), -cost));
  const auto iteration = make_petsc_solver(test_ranks(), {.most_factored = 0});
  EXPECT_EQ(iteration->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_EQ(iteration->cost_in_solves(), 0.0);
}

TEST(PetscSolver, AnalysesOnceForAPattern) {
  const auto solver = make_petsc_solver(test_ranks());
  DenseSystem system = random_system(std::vector<int>(9, 6), 4);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  const int own = test_ranks().own();
  EXPECT_EQ(solver->factorize(rows_of(system, owners, own)), FactorStatus::success);
  EXPECT_EQ(solver->factorize(rows_of(system, owners, own)), FactorStatus::success);
  system.matrix.diagonal().array() += 0.5;
  EXPECT_EQ(solver->factorize(rows_of(system, owners, own)), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), refined_error);
  EXPECT_EQ(solver->counts().analyses, 1u);
  EXPECT_EQ(solver->counts().factorizations, 2u);
  EXPECT_EQ(solver->counts().factorizations_reused, 1u);
  // Another pattern: a rank that sees no change of its own rows takes part.
  const DenseSystem other = random_system(std::vector<int>(9, 6), 5);
  EXPECT_EQ(solver->factorize(rows_of(other, owners, own)), FactorStatus::success);
  EXPECT_LT(error_of(*solver, other, owners), refined_error);
  EXPECT_EQ(solver->counts().analyses, 2u);
}

TEST(PetscSolver, RefusesSystemsThatAreNotPositiveDefinite) {
  const auto solver = make_petsc_solver(test_ranks());
  DenseSystem system = random_system(std::vector<int>(8, 6), 6);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  const int own = test_ranks().own();
  // A body free of all stiffness, whose rows are zero but for a diagonal of zero.
  DenseSystem loose = system;
  loose.matrix.middleRows(loose.starts[5], 6).setZero();
  loose.matrix.middleCols(loose.starts[5], 6).setZero();
  EXPECT_EQ(solver->factorize(rows_of(loose, owners, own)), FactorStatus::not_positive_definite);
  EXPECT_THROW((void)solver->solve(Eigen::VectorXd::Zero(6)), std::logic_error);
  // One direction of negative stiffness.
  DenseSystem negative = system;
  negative.matrix(negative.starts[3], negative.starts[3]) = -1.0;
  EXPECT_EQ(solver->factorize(rows_of(negative, owners, own)), FactorStatus::not_positive_definite);
  // Diagonal blocks are positive definite, the matrix is not: two bodies whose coupling is stronger than each.
  DenseSystem coupled = empty_system({2, 2});
  coupled.matrix.setIdentity();
  coupled.matrix(0, 2) = coupled.matrix(2, 0) = 2.0;
  const std::vector<int> two = in_turn(2, test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(coupled, two, own)), FactorStatus::not_positive_definite);
  // The solver is as good as new.
  EXPECT_EQ(solver->factorize(rows_of(system, owners, own)), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), refined_error);
}

/// Unit cubes of order 1 (12 unknowns: translation, then the gradient of displacement about the centroid, by rows) in a
/// row along x, each joined to the next by springs at the corners of its face, the first one to the ground.
DenseSystem chain_of_cubes(int count) {
  DenseSystem system = empty_system(std::vector<int>(static_cast<std::size_t>(count), 12));
  const auto motion_at = [](const Eigen::Vector3d& place) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 12);
    for (int i = 0; i < 3; ++i) {
      rows(i, i) = 1.0;
      for (int j = 0; j < 3; ++j) rows(i, 3 + 3 * i + j) = place[j];
    }
    return rows;
  };
  const double spring = 100.0;
  for (int body = 0; body < count; ++body) {
    Eigen::MatrixXd strains = Eigen::MatrixXd::Zero(6, 12);
    int row = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j, ++row) {
        strains(row, 3 + 3 * i + j) += 0.5;
        strains(row, 3 + 3 * j + i) += 0.5;
      }
    }
    system.matrix.block(12 * body, 12 * body, 12, 12) += strains.transpose() * strains;
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) {
        Eigen::MatrixXd gap = Eigen::MatrixXd::Zero(3, system.matrix.cols());
        gap.middleCols(12 * body, 12) = motion_at({-0.5, y, z});
        if (body > 0) gap.middleCols(12 * (body - 1), 12) -= motion_at({0.5, y, z});
        system.matrix += spring * gap.transpose() * gap;
      }
    }
    Eigen::MatrixXd rigid(12, 6);
    rigid.setZero();
    rigid.topLeftCorner(3, 3).setIdentity();
    // Rotations about the centre of the chain.
    const Eigen::Vector3d centroid(body - 0.5 * (count - 1), 0.0, 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d turn = Eigen::Vector3d::Unit(axis);
      rigid.col(3 + axis).head(3) = turn.cross(centroid);
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector3d gradient = turn.cross(Eigen::Vector3d::Unit(j));
        for (int i = 0; i < 3; ++i) rigid(3 + 3 * i + j, 3 + axis) = gradient[i];
      }
    }
    system.rigid.push_back(rigid);
  }
  return system;
}

TEST(PetscSolver, MultigridSolvesAnElasticChain) {
  const auto solver = make_petsc_solver(test_ranks(), {.most_factored = 0});
  const DenseSystem system = chain_of_cubes(60);
  std::vector<int> owners(60);
  for (std::size_t k = 0; k < 60; ++k) owners[k] = static_cast<int>(k) * test_ranks().count() / 60;
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  // The condition of a cantilever of 60 cubes is some 1e8.
  EXPECT_LT(error_of(*solver, system, owners), 1e-3);
  EXPECT_GT(solver->counts().gradient_iterations, 0u);
  EXPECT_EQ(solver->counts().factorizations, 1u);
  // With the diagonal blocks alone, each iteration tells one cube what its neighbour knows.
  const WithOption plain("-pc_type", "pbjacobi");
  const auto blocks = make_petsc_solver(test_ranks(), {.most_factored = 0});
  EXPECT_EQ(blocks->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_LT(error_of(*blocks, system, owners), 1e-3);
  EXPECT_LT(5 * solver->counts().gradient_iterations, blocks->counts().gradient_iterations);
}

// A default for bodies of one size is none for those of many.
TEST(PetscSolver, MultigridLeavesOptionsToOthers) {
  const auto solver = make_petsc_solver(test_ranks(), {.most_factored = 0});
  const DenseSystem system = chain_of_cubes(12);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  for (const char* option : {"-mg_levels_pc_type", "-pc_gamg_aggressive_coarsening"}) {
    PetscBool given = PETSC_FALSE;
    PetscOptionsHasName(nullptr, nullptr, option, &given);
    EXPECT_EQ(given, PETSC_FALSE) << option;
  }
}

TEST(PetscSolver, OptionsChooseTheMethod) {
  const WithOption method("-ksp_type", "cg");
  const WithOption preconditioner("-pc_type", "bjacobi");
  const WithOption part("-sub_pc_type", "lu");
  const auto solver = make_petsc_solver(test_ranks());
  const DenseSystem system = random_system({12, 6, 30, 12, 3, 12}, 7);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), 1e-8);
  EXPECT_GT(solver->counts().gradient_iterations, 0u);
}

TEST(PetscSolver, FactorReplacesAnIterationThatDoesNotConverge) {
  const WithOption few("-ksp_max_it", "1");
  const auto solver = make_petsc_solver(test_ranks(), {.most_factored = 0});
  const DenseSystem system = random_system(std::vector<int>(14, 12), 8);
  const std::vector<int> owners = in_turn(system.bodies(), test_ranks().count());
  EXPECT_EQ(solver->factorize(rows_of(system, owners, test_ranks().own())), FactorStatus::success);
  EXPECT_LT(error_of(*solver, system, owners), refined_error);
  EXPECT_EQ(solver->counts().factorizations, 2u);
}

TEST(RowNumbering, RanksAskForPlacesOfBodiesOfOthers) {
  Ranks& ranks = test_ranks();
  // Rank r has the bodies r and r + count, with 3 and r + 1 unknowns.
  const int count = ranks.count(), own = ranks.own();
  std::vector<int> asked(static_cast<std::size_t>(2 * count));
  std::iota(asked.rbegin(), asked.rend(), 0);
  const RowNumbering numbering = number_rows(ranks, {own, own + count}, {3, own + 1}, asked);
  std::int64_t first = 0;
  for (int rank = 0; rank < count; ++rank) {
    const BodyPlace& lower = numbering.asked[static_cast<std::size_t>(2 * count - 1 - rank)];
    const BodyPlace& upper = numbering.asked[static_cast<std::size_t>(count - 1 - rank)];
    EXPECT_EQ(lower.first, first);
    EXPECT_EQ(lower.size, 3);
    EXPECT_EQ(upper.first, first + 3);
    EXPECT_EQ(upper.size, rank + 1);
    if (rank == own) {
      EXPECT_EQ(numbering.first_own, first);
    }
    first += 3 + rank + 1;
  }
  EXPECT_EQ(numbering.all, first);
  EXPECT_EQ(numbering.own, 3 + own + 1);
  EXPECT_EQ(numbering.common_size, 0);
}

}  // namespace
}  // namespace ashlar::petsc_solver_test
