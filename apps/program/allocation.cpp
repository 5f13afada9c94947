// operator new of the program: mimalloc's memory, and std::bad_alloc on failure. Debian builds mimalloc as C, whose
// operator new then calls abort(). Only the program may link this file: a process has one operator new.
#include <mimalloc.h>

#include <cstddef>
#include <new>
#include <string_view>

#include "apps/results/system/this_process.hpp"

namespace {

/// @param get allocates a number of bytes; null: failure. As the standard requires, the new-handler may free memory.
template <class Get>
void* allocated(std::size_t bytes, Get get) {
  while (true) {
    if (void* place = get(bytes)) return place;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

/// Without any memory, the initialisers of libraries end in a stack overflow; so this is checked before them.
void refuse_to_start_without_memory() {
  void* place = mi_malloc(1);
  if (place == nullptr) {
    constexpr std::string_view message = "ashlar: error: out of memory before the program has begun\n";
    ashlar::write_to_errors(message);
    ashlar::end_at_once(1);
  }
  mi_free(place);
}

/// Each iteration of a step allocates the memory freed by the one before. If it was returned to the system in
/// between, page faults took a quarter of the time of a wall of 1620 bricks.
void prepare() {
  refuse_to_start_without_memory();
  mi_option_disable(mi_option_allow_decommit);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = prepare;

}  // namespace

void* operator new(std::size_t bytes) {
  if (void* place = mi_malloc(bytes)) return place;
  return allocated(bytes, mi_malloc);
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes,
                   [&](std::size_t n) { return mi_malloc_aligned(n, static_cast<std::size_t>(alignment)); });
}

void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}

void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return operator new(bytes, alignment);
}

void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return mi_malloc(bytes);
}

void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return mi_malloc(bytes);
}

void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment));
}

void* operator new[](std::size_t bytes, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment));
}

// mimalloc knows the size and alignment of freed memory.
void operator delete(void* place) noexcept {
  mi_free(place);
}

void operator delete[](void* place) noexcept {
  mi_free(place);
}

void operator delete(void* place, std::size_t /*bytes*/) noexcept {
  mi_free(place);
}

void operator delete[](void* place, std::size_t /*bytes*/) noexcept {
  mi_free(place);
}

void operator delete(void* place, std::align_val_t /*alignment*/) noexcept {
  mi_free(place);
}

void operator delete[](void* place, std::align_val_t /*alignment*/) noexcept {
  mi_free(place);
}

void operator delete(void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  mi_free(place);
}

void operator delete[](void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  mi_free(place);
}

void operator delete(void* place, const std::nothrow_t& /*tag*/) noexcept {
  mi_free(place);
}

void operator delete[](void* place, const std::nothrow_t& /*tag*/) noexcept {
  mi_free(place);
}
