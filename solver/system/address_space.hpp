// Memory as the system gives it.
#pragma once

#include <cstddef>

namespace ashlar {

/// True if the system can provide so many more bytes to this process, in one piece. None are kept.
[[nodiscard]] bool has_room_for(std::size_t bytes);

}  // namespace ashlar
