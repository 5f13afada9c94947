#include "apps/results/system/this_process.hpp"

#include <emscripten/heap.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace ashlar {

std::int64_t process_number() {
  return 1;
}

std::string host_name() {
  return "browser";
}

bool has_all_rights() {
  return false;
}

// Memory that a page has taken is never given back.
std::uint64_t peak_memory_bytes() {
  return emscripten_get_heap_size();
}

// A page does not learn its processor time: this is the time that passes.
double processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::filesystem::path program_file() {
  return {};
}

bool errors_go_to_a_terminal() {
  return false;
}

void write_to_errors(std::string_view text) noexcept {
  (void)!::write(STDERR_FILENO, text.data(), text.size());
}

void end_at_once(int exit_status) noexcept {
  ::_exit(exit_status);
}

std::vector<std::string> command_words(int count, char** arguments) {
  return {arguments + 1, arguments + count};
}

void prepare_streams() {}

std::filesystem::path new_private_folder(const std::filesystem::path& start) {
  std::string name = start.string() + "XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  return name;
}

}  // namespace ashlar
