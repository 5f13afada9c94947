// The header of one layer alone, with nothing before it.
#include <ashlar/mechanics.hpp>

static_assert(sizeof(ashlar::BlockModel) > 0);
