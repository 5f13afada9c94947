// The header of one layer alone, with nothing before it.
#include <ashlar/results.hpp>

static_assert(sizeof(ashlar::ResultFolder) > 0);
