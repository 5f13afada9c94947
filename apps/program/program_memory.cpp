#include "apps/program/program_memory.hpp"

#include <gmp.h>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "apps/program/command_line.hpp"
#include "apps/results/system/this_process.hpp"

// When loaded, OpenBLAS reads the number of threads from its environment; each allocates address space at once. It is
// used with one thread, and this replacement of its function prevents others. That of Windows is built for one.
#ifndef _WIN32
extern "C" int openblas_num_threads_env();
extern "C" int openblas_num_threads_env() {
  return 1;
}
#endif

namespace ashlar {
namespace {

std::terminate_handler other_end = nullptr;

/// @return true if the program ends for lack of memory: there is no exception if even that could not be allocated.
bool is_for_memory() {
  const std::exception_ptr error = std::current_exception();
  if (!error) return true;
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// Allocates nothing and runs no destructors: a result folder keeps the last saved state.
[[noreturn]] void end_of_program() {
  if (!is_for_memory()) {
    if (other_end != nullptr) other_end();
    std::abort();
  }
  constexpr std::string_view message =
      "ashlar: error: out of memory; a run keeps the last state that it saved\n";
  write_to_errors(message);
  end_at_once(exit_status::failed);
}

// GMP calls abort() without memory; an exception is the only alternative.
void* thrown_if_none(void* place) {
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

void* allocate(std::size_t bytes) {
  return thrown_if_none(std::malloc(bytes));
}

void* reallocate(void* old, std::size_t /*old_bytes*/, std::size_t bytes) {
  return thrown_if_none(std::realloc(old, bytes));
}

void release(void* place, std::size_t /*bytes*/) {
  std::free(place);
}

}  // namespace

void prepare_for_missing_memory() {
  if (std::get_terminate() == end_of_program) return;
  other_end = std::set_terminate(end_of_program);
  mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace ashlar
