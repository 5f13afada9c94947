// Files of a page are in its memory, of which none is set aside: it would count twice.
#include "apps/results/system/space_reserve.hpp"

#include <utility>

namespace ashlar {

SpaceReserve::SpaceReserve(std::filesystem::path folder) : folder_(std::move(folder)) {}

SpaceReserve::~SpaceReserve() = default;

void SpaceReserve::hold(std::uintmax_t /*bytes*/) {}

void SpaceReserve::release() noexcept {}

}  // namespace ashlar
