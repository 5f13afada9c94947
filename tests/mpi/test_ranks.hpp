// The ranks that run a test.
#pragma once

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// All processes of the test program.
[[nodiscard]] Ranks& test_ranks();

}  // namespace ashlar
