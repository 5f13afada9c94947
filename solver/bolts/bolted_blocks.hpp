// The blocks that a bolt or prop passes.
#pragma once

#include <vector>

#include "mechanics/bolt/bolt_chain.hpp"

namespace ashlar {

/// Blocks that are present along a bolt, each once, increasing.
[[nodiscard]] std::vector<int> present_blocks(const BoltChain& chain);

}  // namespace ashlar
