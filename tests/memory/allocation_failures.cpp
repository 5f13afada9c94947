// The program with its n-th allocation failing, for many n: it must end with a message and exit status 1, or as without a
// failure where the allocation was not needed, and a run must keep a state that can be resumed to the same results.
//
//   allocation_failures [--first N] [--last N] [--step N] [--from-then-on] [--all] [--trace] [--bare] [--folder DIR] -- ARGUMENTS
//
// ARGUMENTS are those of `ashlar`. Counted is operator new, as the program's own replacement of it would fail, and with
// --all each allocation of the C library too. Each n has a process of its own. --from-then-on: all later ones fail as well.
// --folder: what a run writes, removed before each n. --trace: where the allocation was asked for.
// --bare: without the program's handler of std::terminate, so that what it is needed for aborts.
#include <execinfo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/program_memory.hpp"

// The functions of the C library, behind the names that this program redefines.
extern "C" void* __libc_malloc(std::size_t bytes);
extern "C" void* __libc_calloc(std::size_t count, std::size_t bytes);
extern "C" void* __libc_realloc(void* place, std::size_t bytes);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t bytes);
extern "C" void __libc_free(void* place);

namespace {

/// The failing allocation. Changed only while one thread runs.
struct Failure {
  bool armed = false;
  bool all = false;  ///< the C library's allocations count too
  bool from_then_on = false;
  bool bare = false;  ///< without the last resort
  bool trace = false;
  long number = 0;  ///< 1: the first one
};
Failure failure;
std::atomic<long> counted = 0;

/// Report of a process to the one that began it.
struct Told {
  std::atomic<bool> failed = false;  ///< there was an allocation of that number
};
Told* told = nullptr;

void trace() {
  std::array<void*, 40> calls{};
  backtrace_symbols_fd(calls.data(), backtrace(calls.data(), calls.size()), STDERR_FILENO);
}

bool fails(bool is_new) {
  if (!failure.armed || !(is_new || failure.all)) return false;
  const long number = ++counted;
  if (number != failure.number && !(failure.from_then_on && number > failure.number)) return false;
  told->failed = true;
  if (failure.trace && number == failure.number) {
    failure.armed = false;
    trace();
    failure.armed = true;
  }
  errno = ENOMEM;
  return true;
}

void* allocated(std::size_t bytes) {
  void* place = fails(true) ? nullptr : __libc_malloc(bytes == 0 ? 1 : bytes);
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

void* allocated(std::size_t bytes, std::align_val_t alignment) {
  void* place = fails(true) ? nullptr : __libc_memalign(static_cast<std::size_t>(alignment), bytes);
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

}  // namespace

extern "C" {
void* malloc(std::size_t bytes) {
  return fails(false) ? nullptr : __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t bytes) {
  return fails(false) ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* place, std::size_t bytes) {
  return fails(false) ? nullptr : __libc_realloc(place, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return fails(false) ? nullptr : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t bytes) {
  *place = fails(false) ? nullptr : __libc_memalign(alignment, bytes);
  return *place == nullptr ? ENOMEM : 0;
}
void free(void* place) {
  __libc_free(place);
}
}

void* operator new(std::size_t bytes) {
  return allocated(bytes);
}
void* operator new[](std::size_t bytes) {
  return allocated(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes, alignment);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes, alignment);
}
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return fails(true) ? nullptr : __libc_malloc(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return fails(true) ? nullptr : __libc_malloc(bytes);
}
void operator delete(void* place) noexcept {
  __libc_free(place);
}
void operator delete[](void* place) noexcept {
  __libc_free(place);
}
void operator delete(void* place, std::size_t /*bytes*/) noexcept {
  __libc_free(place);
}
void operator delete[](void* place, std::size_t /*bytes*/) noexcept {
  __libc_free(place);
}
void operator delete(void* place, std::align_val_t /*alignment*/) noexcept {
  __libc_free(place);
}
void operator delete[](void* place, std::align_val_t /*alignment*/) noexcept {
  __libc_free(place);
}
void operator delete(void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  __libc_free(place);
}
void operator delete[](void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  __libc_free(place);
}

namespace {

struct Options {
  long first = 1, last = 1000, step = 1;
  std::filesystem::path folder;  ///< of results; empty: the command writes none
  std::vector<std::string> arguments;
};

struct Ending {
  int status = 0;  ///< of exit; negative: the signal that ended it
  bool failed = false;
  std::string printed, said;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Message of the handler of std::terminate, called where libraries allocate in functions declared noexcept.
constexpr const char* last_resort = "a run keeps the last state that it saved";

/// One command in a process of its own. @param number of the allocation that fails; 0: none
Ending run_once(const std::vector<std::string>& arguments, long number,
                const std::filesystem::path& scratch) {
  constexpr unsigned int most_seconds = 60;
  told->failed = false;
  const std::filesystem::path out = scratch / "out", err = scratch / "err";
  const pid_t child = fork();
  if (child == 0) {
    alarm(most_seconds);
    for (const auto& [file, stream] : {std::pair(out, STDOUT_FILENO), std::pair(err, STDERR_FILENO)}) {
      const int descriptor = open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
      if (descriptor < 0 || dup2(descriptor, stream) < 0) _exit(99);
    }
    const std::terminate_handler aborts = std::get_terminate();
    ashlar::prepare_for_missing_memory();
    if (failure.bare) std::set_terminate(aborts);
    std::vector<std::string> own = arguments;
    failure.number = number;
    failure.armed = number > 0;
    const int status = ashlar::run_command_line(std::move(own), std::cout, std::cerr);
    failure.armed = false;
    std::cout.flush();
    _exit(status);
  }
  int how = 0;
  if (child < 0 || waitpid(child, &how, 0) != child) throw std::runtime_error("no process");
  return {WIFEXITED(how) ? WEXITSTATUS(how) : -WTERMSIG(how), told->failed, text_of(out), text_of(err)};
}

/// Fault of an ending; empty: none.
std::string fault_of(const Ending& ending, const Ending& reference) {
  if (ending.status == reference.status)
    return ending.printed == reference.printed ? "" : "the same status with other output";
  if (ending.status < 0) return fmt::format("ended by signal {}", -ending.status);
  if (ending.status != ashlar::exit_status::failed) return fmt::format("exit status {}", ending.status);
  return ending.said.find("out of memory") == std::string::npos ? "no word of memory" : "";
}

/// Resumes a run that ended out of memory. @return the fault, if any
std::string fault_of_resume(const Options& options, const std::string& history,
                            const std::filesystem::path& scratch) {
  std::vector<std::string> arguments = options.arguments;
  arguments.emplace_back("--resume");
  const Ending resumed = run_once(arguments, 0, scratch);
  if (resumed.status != 0) return "cannot be resumed: " + resumed.said;
  return text_of(options.folder / "history.csv") == history ? "" : "other results when it was resumed";
}

int tried(const Options& options) {
  std::string name = (std::filesystem::temp_directory_path() / "allocations-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const std::filesystem::path scratch = name;
  const auto begin = [&] {
    if (!options.folder.empty()) std::filesystem::remove_all(options.folder);
  };
  begin();
  const Ending reference = run_once(options.arguments, 0, scratch);
  const std::string history = options.folder.empty() ? "" : text_of(options.folder / "history.csv");
  long tries = 0, faults = 0, resumed = 0, resorts = 0;
  long number = options.first;
  for (; number <= options.last; number += options.step, ++tries) {
    begin();
    const Ending ending = run_once(options.arguments, number, scratch);
    if (!ending.failed) break;
    std::string fault = fault_of(ending, reference);
    if (ending.said.find(last_resort) != std::string::npos) ++resorts;
    if (fault.empty() && ending.status != reference.status && !options.folder.empty() &&
        std::filesystem::exists(options.folder / "checkpoint")) {
      fault = fault_of_resume(options, history, scratch);
      ++resumed;
    }
    if (fault.empty()) continue;
    ++faults;
    fmt::print("allocation {}: {}\n{}{}\n", number, fault, ending.printed, ending.said);
    std::fflush(stdout);  // or processes that follow would write it again
  }
  fmt::print(
      "{} allocations failed up to number {}: {} ended by the last resort, {} runs went on, {} faults, exit "
      "status {} "
      "without a failure\n",
      tries, number, resorts, resumed, faults, reference.status);
  std::filesystem::remove_all(scratch);
  return faults == 0 && tries > 0 && reference.status == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** texts) {
  void* shared = mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return 2;
  told = new (shared) Told;
  std::array<void*, 1> call{};
  (void)backtrace(call.data(), 1);  // loads a library when it is first called
  Options options;
  int k = 1;
  for (; k < count && std::strcmp(texts[k], "--") != 0; ++k) {
    const std::string option = texts[k];
    const auto value = [&] { return k + 1 < count ? texts[++k] : texts[k]; };
    if (option == "--first")
      options.first = std::atol(value());
    else if (option == "--last")
      options.last = std::atol(value());
    else if (option == "--step")
      options.step = std::atol(value());
    else if (option == "--folder")
      options.folder = value();
    else if (option == "--from-then-on")
      failure.from_then_on = true;
    else if (option == "--all")
      failure.all = true;
    else if (option == "--bare")
      failure.bare = true;
    else if (option == "--trace")
      failure.trace = true;
    else
      return 2;
  }
  options.arguments.assign(texts + std::min(k + 1, count), texts + count);
  return tried(options);
}
