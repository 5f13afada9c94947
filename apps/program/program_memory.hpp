// Memory allocation of the program: every failed allocation throws std::bad_alloc, and the program ends with a
// message.
#pragma once

namespace ashlar {

/// From now on GMP's allocations fail like all others, and an exception that cannot be caught (libraries declare
/// functions noexcept that allocate) is reported before the program ends with exit status 1. A second call has no
/// effect.
void prepare_for_missing_memory();

}  // namespace ashlar
