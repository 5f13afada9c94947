// The header of one layer alone, with nothing before it.
#include <ashlar/run.hpp>

static_assert(sizeof(ashlar::Run) > 0);
