// Runs tests on the ranks of MPI: each rank runs all of them, and each must pass on each rank.
//
// A test must not leave before the others of its ranks do: it has EXPECT_..., no ASSERT_... An exception ends all ranks.
#include <gtest/gtest.h>

#include <iostream>

#include "solver/ranks/mpi/mpi_session.hpp"
#include "tests/mpi/test_ranks.hpp"

namespace ashlar {

Ranks*& session_ranks() {
  static Ranks* ranks = nullptr;
  return ranks;
}

Ranks& test_ranks() {
  return *session_ranks();
}

}  // namespace ashlar

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  GTEST_FLAG_SET(catch_exceptions, false);
  ashlar::MpiSession session;
  ashlar::session_ranks() = &session.ranks();
  if (session.ranks().own() > 0) GTEST_FLAG_SET(brief, true);
  const bool failed = RUN_ALL_TESTS() != 0;
  return ashlar::any_rank(session.ranks(), failed) ? 1 : 0;
}
