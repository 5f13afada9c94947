#include "solver/system/address_space.hpp"

#include <windows.h>

namespace ashlar {

bool has_room_for(std::size_t bytes) {
  void* place = ::VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
  if (place == nullptr) return false;
  ::VirtualFree(place, 0, MEM_RELEASE);
  return true;
}

}  // namespace ashlar
