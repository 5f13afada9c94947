// Uses something of each installed layer, so that every library they need must be found and linked.
#include <cstdlib>
#include <iostream>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "mechanics/basis/moments.hpp"
#include "solver/library_versions.hpp"
#include "solver/linear/sparse_cholesky.hpp"

namespace {

bool box_is_right() {
  const ashlar::Polyhedron box(ashlar::make_box({0, 0, 0}, {1, 2, 3}));
  return box.faces().size() == 6 && box.volume() == 6.0 && ashlar::moments(box.mesh(), 0).front() == 6.0;
}

// 4 x + 2 y = 8 and 2 x + 3 y = 7 are solved by x = 1.25, y = 1.5.
bool solution_is_right() {
  ashlar::SparseCholesky solver;
  if (solver.factorize({2, {0, 2, 3}, {0, 1, 1}, {4, 2, 3}}) != ashlar::FactorStatus::success) return false;
  return (solver.solve(Eigen::Vector2d(8, 7)) - Eigen::Vector2d(1.25, 1.5)).norm() < 1e-14;
}

}  // namespace

int main() {
  for (const auto& [name, version] : ashlar::solver_library_versions()) {
    std::cout << name << ' ' << version << '\n';
  }
  const bool right = box_is_right() && solution_is_right();
  std::cout << (right ? "right\n" : "wrong\n");
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
