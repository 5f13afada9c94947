// The header of one layer alone, with nothing before it.
#include <ashlar/solver.hpp>

static_assert(sizeof(ashlar::Simulation) > 0);
