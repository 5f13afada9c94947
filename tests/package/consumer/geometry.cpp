// The header of one layer alone, with nothing before it.
#include <ashlar/geometry.hpp>

static_assert(sizeof(ashlar::Polyhedron) > 0);
