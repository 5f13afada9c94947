#include "solver/linear/blas_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <string_view>
#include <thread>

#include "solver/linear/sparse_cholesky.hpp"

namespace ashlar::blas_memory_test {
namespace {

/// n on the diagonal, one elsewhere: positive definite and full, so that its factor is one supernode.
SymmetricMatrix full_matrix(int n) {
  SymmetricMatrix matrix;
  matrix.size = n;
  for (int column = 0; column < n; ++column) {
    matrix.column_start.push_back(static_cast<int>(matrix.rows.size()));
    for (int row = column; row < n; ++row) {
      matrix.rows.push_back(row);
      matrix.values.push_back(row == column ? n : 1.0);
    }
  }
  matrix.column_start.push_back(static_cast<int>(matrix.rows.size()));
  return matrix;
}

/// Bytes of address space that this process has.
std::size_t address_space() {
  std::ifstream status("/proc/self/statm");
  std::size_t pages = 0;
  status >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// @return 0: solved, 1: reported out of memory
int solve_with(std::size_t more_bytes) {
  alarm(60);  // OpenBLAS would try without end
  const SymmetricMatrix matrix = full_matrix(300);
  const rlimit limit = {address_space() + more_bytes, RLIM_INFINITY};
  if (setrlimit(RLIMIT_AS, &limit) != 0) return 2;
  try {
    SparseCholesky solver;
    if (solver.factorize(matrix) != FactorStatus::success) return 3;
    // Each row sums to n + (n - 1).
    const Eigen::VectorXd x = solver.solve(Eigen::VectorXd::Constant(300, 599.0));
    return (x - Eigen::VectorXd::Ones(300)).norm() < 1e-12 ? 0 : 4;
  } catch (const BlasMemoryError& error) {
    return std::string_view(error.what()).starts_with("out of memory: ") ? 1 : 5;
  }
}

// Each in a separate process, because OpenBLAS keeps its mapped memory.
TEST(BlasMemory, MissingAddressSpaceIsAnException) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need address space themselves";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(_exit(solve_with(std::size_t{64} << 20U)), ::testing::ExitedWithCode(1), "");
  EXPECT_EXIT(_exit(solve_with(std::size_t{512} << 20U)), ::testing::ExitedWithCode(0), "");
}

TEST(BlasMemory, ThreadsThatComeAndGoNeedNoMoreThanThereAreAtATime) {
  const auto use = [] { const BlasUse inside; };
  std::thread(use).join();
  const std::size_t before = address_space();
  for (int k = 0; k < 20; ++k) std::thread(use).join();
  EXPECT_LT(address_space(), before + (std::size_t{128} << 20U));
}

}  // namespace
}  // namespace ashlar::blas_memory_test
