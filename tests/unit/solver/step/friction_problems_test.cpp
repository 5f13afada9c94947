// Contact problems that others posed (tests/friction_problems/README.md): any answer that obeys Coulomb's law is right.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "solver/step/impact/impact.hpp"

namespace ashlar::friction_problems_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct FrictionProblem {
  MatrixXd delassus;
  VectorXd velocity;
  VectorXd friction;
};

template <class Number>
Number next(std::istream& in) {
  Number number{};
  if (!(in >> number)) throw std::runtime_error("friction problem ends early");
  return number;
}
template <class Number>
std::vector<Number> next(std::istream& in, std::size_t count) {
  std::vector<Number> numbers(count);
  for (Number& number : numbers) number = next<Number>(in);
  return numbers;
}

FrictionProblem read_problem(const std::string& name) {
  std::ifstream in(std::filesystem::path(ASHLAR_FRICTION_PROBLEMS) / name);
  const int dimension = next<int>(in);
  const auto contacts = next<std::size_t>(in);
  const int storage = next<int>(in);
  const int size = next<int>(in);
  if (dimension != 3 || storage != 1 || next<int>(in) != size) throw std::runtime_error("not a 3-D problem");
  const auto blocks = next<std::size_t>(in);
  const auto rows = next<std::size_t>(in);
  const auto columns = next<std::size_t>(in);
  next<int>(in, rows + columns);  // ends of the rows and columns of blocks: 3, 6, ...
  const auto row_ends = next<std::size_t>(in);
  const auto entries = next<std::size_t>(in);
  const std::vector<int> ends = next<int>(in, row_ends);
  const std::vector<int> column_of = next<int>(in, entries);
  FrictionProblem problem{MatrixXd::Zero(size, size), {}, {}};
  int row = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    next<int>(in);  // its number
    while (ends[static_cast<std::size_t>(row) + 1] <= static_cast<int>(k)) ++row;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) problem.delassus(3 * row + i, 3 * column_of[k] + j) = next<double>(in);
  }
  const std::vector<double> q = next<double>(in, static_cast<std::size_t>(size));
  const std::vector<double> mu = next<double>(in, contacts);
  problem.velocity = Eigen::Map<const VectorXd>(q.data(), size);
  problem.friction = Eigen::Map<const VectorXd>(mu.data(), static_cast<Eigen::Index>(contacts));
  return problem;
}

/// Projection on |t| <= mu n, as the judge has it.
Vector3d on_cone(const Vector3d& r, double mu) {
  const double t = r.tail<2>().norm();
  if (t <= mu * r[0]) return r;
  if (mu * t <= -r[0]) return Vector3d::Zero();
  const double n = (r[0] + mu * t) / (1.0 + mu * mu);
  return {n, mu * n * r[1] / t, mu * n * r[2] / t};
}

double error_of(const FrictionProblem& problem, const VectorXd& r) {
  const VectorXd u = problem.delassus * r + problem.velocity;
  double squares = 0.0;
  for (Eigen::Index k = 0; k < problem.friction.size(); ++k) {
    const double mu = problem.friction[k];
    Vector3d velocity = u.segment<3>(3 * k);
    velocity[0] += mu * velocity.tail<2>().norm();
    const Vector3d force = r.segment<3>(3 * k);
    squares += (force - on_cone(force - velocity, mu)).squaredNorm();
  }
  return std::sqrt(squares) / problem.velocity.norm();
}

/// One body of unit inertia, whose velocities are those along the principal axes of W.
std::vector<ImpactPoint> points_of(const FrictionProblem& problem, int& freedom) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(0.5 * (problem.delassus + problem.delassus.transpose()));
  const VectorXd& values = axes.eigenvalues();
  freedom = 0;
  for (const double value : values) freedom += static_cast<int>(value > 1e-12 * values.maxCoeff());
  const VectorXd roots = values.tail(freedom).cwiseSqrt();
  const MatrixXd rows = axes.eigenvectors().rightCols(freedom) * roots.asDiagonal();
  std::vector<ImpactPoint> points;
  for (Eigen::Index k = 0; k < problem.friction.size(); ++k) {
    ImpactPoint point{0, -1, rows.middleRows<3>(3 * k), {}};
    point.velocity = problem.velocity.segment<3>(3 * k);
    point.friction = problem.friction[k];
    points.push_back(std::move(point));
  }
  return points;
}

struct Judge {
  const char* name;
  double error;  ///< allowed
};
std::ostream& operator<<(std::ostream& out, const Judge& judge) {
  return out << judge.name;
}

class FrictionProblems : public testing::TestWithParam<Judge> {};

TEST_P(FrictionProblems, ObeyCoulombsLaw) {
  FrictionProblem problem = read_problem(GetParam().name);
  int freedom = 0;
  const std::vector<ImpactPoint> points = points_of(problem, freedom);
  const ImpactResult result = solve_impact({1.0}, {freedom}, points);
  VectorXd r(problem.velocity.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    r.segment<3>(3 * static_cast<Eigen::Index>(k)) = result.impulses[k];
  problem.delassus = (0.5 * (problem.delassus + problem.delassus.transpose())).eval();
  EXPECT_LT(error_of(problem, r), GetParam().error) << result.residual;
  EXPECT_LE(result.work, 0.0);
}

// Where bodies roll, the iteration converges slowly.
INSTANTIATE_TEST_SUITE_P(OfSiconos, FrictionProblems,
                         testing::Values(Judge{"KaplasTower-i1061-4.hdf5.dat", 1e-8},
                                         Judge{"Capsules-i122-1617.dat", 1e-4},
                                         Judge{"Confeti-ex13-Fc3D-SBM.dat", 1e-8},
                                         Judge{"Confeti-ex13-4contact-Fc3D-SBM.dat", 1e-8},
                                         Judge{"BoxesStack1-i100000-32.hdf5.dat", 1e-8},
                                         Judge{"OneObject-i100000-499.hdf5.dat", 1e-8}));

}  // namespace
}  // namespace ashlar::friction_problems_test
