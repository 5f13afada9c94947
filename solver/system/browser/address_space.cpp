#include "solver/system/address_space.hpp"

#include <emscripten/heap.h>

namespace ashlar {

// Memory that a page has been given is never given back: to try it would keep it.
bool has_room_for(std::size_t bytes) {
  return bytes <= emscripten_get_heap_max() - emscripten_get_heap_size();
}

}  // namespace ashlar
