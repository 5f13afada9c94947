// How the program gets memory and what happens where there is none: an allocation that fails is std::bad_alloc, whatever
// asked for it, and the program ends with a message.
#pragma once

namespace ashlar {

/// To be called once, before anything else. GMP's numbers fail as all others do, and an exception that nobody can catch
/// (libraries declare functions noexcept that allocate) is told before the program ends with exit status 1.
void prepare_for_missing_memory();

}  // namespace ashlar
