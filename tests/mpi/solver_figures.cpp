// Time and memory of a factor and of multigrid for systems of stacked cubes: the figures of solver/notes/rank_solver.md.
//   mpiexec -n 2 build/release/tests/mpi/solver_figures 10 20
// for stacks of 10 and 20 cubes to a side. Each line: cubes to a side, unknowns, then for each method its set-up (s), time
// of a solution (s), iterations, and the peak memory of a rank so far (MB).
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "solver/ranks/mpi/mpi_session.hpp"
#include "solver/ranks/mpi/petsc_solver.hpp"

namespace ashlar {
namespace {

/// Joint stiffness of a corner, and of inertia per unknown, relative to Young's modulus times the side of a cube.
constexpr double joint = 10.0, inertia = 1e-3;

Eigen::MatrixXd motion_at(const Eigen::Vector3d& place) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 12);
  for (int i = 0; i < 3; ++i) {
    rows(i, i) = 1.0;
    for (int j = 0; j < 3; ++j) rows(i, 3 + 3 * i + j) = place[j];
  }
  return rows;
}

Eigen::MatrixXd elastic_block() {
  Eigen::MatrixXd strains = Eigen::MatrixXd::Zero(6, 12);
  int row = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j, ++row) {
      strains(row, 3 + 3 * i + j) += 0.5;
      strains(row, 3 + 3 * j + i) += 0.5;
    }
  }
  return strains.transpose() * strains + inertia * Eigen::MatrixXd::Identity(12, 12);
}

Eigen::MatrixXd rigid_motions(const Eigen::Vector3d& centroid) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(12, 6);
  rigid.topLeftCorner(3, 3).setIdentity();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(axis);
    rigid.col(3 + axis).head(3) = turn.cross(centroid);
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d gradient = turn.cross(Eigen::Vector3d::Unit(j));
      for (int i = 0; i < 3; ++i) rigid(3 + 3 * i + j, 3 + axis) = gradient[i];
    }
  }
  return rigid;
}

/// Rows of one cube of a stack: springs at the four corners of each common face; the lowest cubes stand on the ground.
BodyRows rows_of_cube(int side, int cube) {
  const std::array<int, 3> place = {cube % side, cube / side % side, cube / side / side};
  const std::array<int, 3> stride = {1, side, side * side};
  std::map<int, Eigen::MatrixXd> blocks;
  Eigen::MatrixXd& own = blocks[cube] = elastic_block();
  for (int axis = 0; axis < 3; ++axis) {
    for (const int toward : {-1, 1}) {
      const auto a = static_cast<std::size_t>(axis);
      const int next = place[a] + toward;
      const bool grounded = axis == 2 && next < 0;
      if ((next < 0 || next >= side) && !grounded) continue;
      Eigen::MatrixXd beside = Eigen::MatrixXd::Zero(12, 12);
      for (const double u : {-0.5, 0.5}) {
        for (const double v : {-0.5, 0.5}) {
          Eigen::Vector3d corner, opposite;
          corner[axis] = 0.5 * toward;
          corner[(axis + 1) % 3] = u;
          corner[(axis + 2) % 3] = v;
          opposite = corner;
          opposite[axis] = -0.5 * toward;
          const Eigen::MatrixXd here = motion_at(corner);
          own += joint * here.transpose() * here;
          beside -= joint * here.transpose() * motion_at(opposite);
        }
      }
      if (!grounded) blocks[cube + toward * stride[a]] = beside;
    }
  }
  BodyRows rows;
  rows.body = cube;
  for (auto& [column, block] : blocks) {
    rows.columns.push_back(column);
    rows.blocks.push_back(block);
  }
  rows.rigid = rigid_motions(Eigen::Vector3d(place[0], place[1], place[2]));
  return rows;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Text of one method on the first rank.
std::string measured(Ranks& ranks, const std::vector<BodyRows>& rows, std::int64_t most_factored) {
  const auto solver = make_petsc_solver(ranks, {most_factored});
  const Eigen::VectorXd right =
      Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(12 * rows.size()), -1.0, 1.0);
  const double begun = now();
  const bool good = solver->factorize(rows) == FactorStatus::success;
  const double ready = now();
  if (!good) return "not positive definite";
  (void)solver->solve(right);
  const double done = now();
  const double memory = max_of_ranks(ranks, peak_megabytes());
  std::ostringstream text;
  text << std::setprecision(3) << ready - begun << " s, " << done - ready << " s, "
       << solver->counts().gradient_iterations << ", " << memory << " MB";
  return text.str();
}

void measure(Ranks& ranks, int side, const std::string& methods) {
  const int cubes = side * side * side;
  std::vector<BodyRows> rows;
  const auto first = [&](int rank) { return static_cast<int>(std::int64_t{cubes} * rank / ranks.count()); };
  for (int cube = first(ranks.own()); cube < first(ranks.own() + 1); ++cube)
    rows.push_back(rows_of_cube(side, cube));
  std::string line = std::to_string(side) + ", " + std::to_string(12 * cubes) + " unknowns";
  if (methods.find('g') != std::string::npos) line += "; multigrid " + measured(ranks, rows, 0);
  if (methods.find('f') != std::string::npos)
    line += "; factor " + measured(ranks, rows, std::numeric_limits<std::int64_t>::max());
  if (ranks.own() == 0) std::cout << line << std::endl;
}

}  // namespace
}  // namespace ashlar

int main(int count, char** arguments) {
  ashlar::MpiSession session;
  std::string methods = "gf";
  for (int k = 1; k < count; ++k) {
    const std::string word = arguments[k];
    if (word.find_first_not_of("0123456789") != std::string::npos)
      methods = word;
    else
      ashlar::measure(session.ranks(), std::stoi(word), methods);
  }
}
